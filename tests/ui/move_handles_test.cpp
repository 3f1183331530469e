#include "ui/viewport/move_handles.h"

#include "ui/viewport/viewer_camera.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dollytrack::ui::move_handles_test {
namespace {

using Eigen::Vector3d;
using planning::MoveOptions;

const Vector3d kCenter(2.0, 1.0, 1.1);
constexpr double kFloor = 0.25;

/// An arc counter-clockwise about kCenter, from a heading of 0.
MovePreview arcOf(double degrees, double radius_m) {
    MovePreview preview;
    for (int i = 0; i <= 40; ++i) {
        const double angle = degrees * std::numbers::pi / 180.0 * i / 40;
        preview.path.push_back(
            kCenter + Vector3d(radius_m * std::cos(angle), radius_m * std::sin(angle), 0.4));
    }
    preview.look_at = kCenter;
    preview.floor_z = kFloor;
    return preview;
}

render::View viewFrom(double azimuth, double elevation) {
    ViewerCamera camera;
    camera.azimuth = azimuth;
    camera.elevation = elevation;
    camera.pivot = kCenter;
    camera.distance = 8.0;
    return camera.view(800, 600);
}

/// The options after the handle was dragged to a point, seen in this view.
MoveOptions dragged(const planning::MoveRequest& move, const MovePreview& preview,
                    const std::string& setting, const Vector3d& to, const render::View& view) {
    const std::vector<MoveHandle> handles = moveHandles(move, preview);
    const auto handle = std::ranges::find(handles, setting, &MoveHandle::setting);
    if (handle == handles.end()) return {{"no handle", setting}};
    const auto ray = [&](const Vector3d& point) {
        const Eigen::Vector2d at = view.project(view.pose.toCamera(point));
        return view.rayThrough(at.x(), at.y());
    };
    return draggedOptions({*handle, move, preview, ray(handle->at)}, ray(to));
}

Vector3d place(const MovePreview& preview, const planning::MoveRequest& move,
               const std::string& setting) {
    const std::vector<MoveHandle> handles = moveHandles(move, preview);
    return std::ranges::find(handles, setting, &MoveHandle::setting)->at;
}

TEST(MoveHandles, SetTheRadiusHeightAndArcOfAnOrbit) {
    const planning::MoveRequest move = {"arc", {}, 7};
    const MovePreview preview = arcOf(90.0, 1.5);
    for (const double azimuth : {0.3, 2.0, 4.0}) {
        const render::View view = viewFrom(azimuth, 0.7);
        const Vector3d middle = place(preview, move, "radius");
        const Vector3d out = (middle - kCenter - Vector3d(0, 0, 0.4)).normalized();
        EXPECT_EQ(dragged(move, preview, "radius", middle + 0.5 * out, view),
                  (MoveOptions{{"radius", "2"}}));
        EXPECT_EQ(dragged(move, preview, "radius", middle - 4.0 * out, view),
                  (MoveOptions{{"radius", "0.1"}}))
            << "within the limits";
        const Vector3d quarter = place(preview, move, "height");
        EXPECT_EQ(dragged(move, preview, "height", quarter + Vector3d(0, 0, 0.3), view),
                  (MoveOptions{{"height", "1.55"}}))
            << "above the floor";
        const double angle = 110.0 * std::numbers::pi / 180.0;
        const Vector3d end = kCenter + Vector3d(std::cos(angle), std::sin(angle), 0.4);
        EXPECT_EQ(dragged(move, preview, "arc", end, view), (MoveOptions{{"arc", "130"}}));
    }
}

TEST(MoveHandles, OnlyAMoveWithoutAnObjectHasAHandleForItsCentre) {
    planning::MoveRequest move = {"orbit", {{"radius", "1.5"}}};
    MovePreview preview = arcOf(300.0, 1.5);
    EXPECT_EQ(
        dragged(move, preview, "center", kCenter + Vector3d(0.5, -0.25, 0.0), viewFrom(1.0, 0.9)),
        (MoveOptions{{"center", "2.5;0.75;1.1"}, {"radius", "1.5"}}));
    preview.has_subject = true;
    EXPECT_TRUE(std::ranges::none_of(moveHandles(move, preview), [](const MoveHandle& handle) {
        return handle.setting == "center";
    }));
}

TEST(MoveHandles, BothEndsOfADollyAreSetAndItLooksAtTheSamePoint) {
    MovePreview preview;
    preview.path = {{0, 0, 1}, {0.5, 0, 1}, {1, 0, 1}};
    preview.look_at = kCenter;
    preview.has_subject = true;
    planning::MoveRequest move = {"dolly", {}, 7};
    move.options = dragged(move, preview, "from", {-1, 0.5, 1}, viewFrom(1.0, 0.6));
    EXPECT_EQ(move.options,
              (MoveOptions{{"from", "-1;0.5;1"}, {"to", "1;0;1"}, {"center", "2;1;1.1"}}));
    preview.path.front() = {-1, 0.5, 1};
    EXPECT_EQ(dragged(move, preview, "to", {1, 1, 1}, viewFrom(1.0, 0.6)),
              (MoveOptions{{"from", "-1;0.5;1"}, {"to", "1;1;1"}, {"center", "2;1;1.1"}}));
}

TEST(MoveHandles, ACraneMovesBetweenTwoHeights) {
    MovePreview preview;
    preview.path = {{0, 0, 0.75}, {0, 0, 1.5}, {0, 0, 2.25}};
    preview.look_at = kCenter;
    preview.floor_z = kFloor;
    const planning::MoveRequest move = {"crane", {}, 7};
    EXPECT_EQ(dragged(move, preview, "from_height", {0, 0, 1.0}, viewFrom(1.0, 0.2)),
              (MoveOptions{{"from_height", "0.75"}}));
    EXPECT_EQ(dragged(move, preview, "to_height", {0, 0, 1.75}, viewFrom(1.0, 0.2)),
              (MoveOptions{{"to_height", "1.5"}}));
}

TEST(MoveHandles, AnUnknownMoveOrAnEmptyPathHasNone) {
    EXPECT_TRUE(moveHandles({"walk", {}}, {}).empty());
    const MovePreview preview = arcOf(90.0, 1.0);
    EXPECT_EQ(draggedOptions({{"radius", {}}, {"", {}}, preview, {}}, {}), MoveOptions());
}

}  // namespace
}  // namespace dollytrack::ui::move_handles_test
