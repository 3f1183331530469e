#include "ui/viewport/viewer_camera.h"

#include "ui/viewport/false_color.h"
#include "ui/viewport/gizmo.h"
#include "ui/viewport/viewport_pane.h"

#include <gtest/gtest.h>

#include <numbers>
#include <set>
#include <string>
#include <utility>

namespace dollytrack::ui::viewer_camera_test {
namespace {

constexpr int kWidth = 800;
constexpr int kHeight = 600;

Eigen::Vector2d pixelOf(const ViewerCamera& camera, const Eigen::Vector3d& point) {
    const render::View view = camera.view(kWidth, kHeight);
    return view.project(view.pose.toCamera(point));
}

TEST(ViewerCamera, LooksAtItsPivotFromItsDistance) {
    ViewerCamera camera;
    camera.pivot = {1, 2, 3};
    const render::View view = camera.view(kWidth, kHeight);
    EXPECT_NEAR((view.pose.position - camera.pivot).norm(), camera.distance, 1e-9);
    EXPECT_NEAR((pixelOf(camera, camera.pivot) - Eigen::Vector2d(400, 300)).norm(), 0.0, 1e-6);
    // A point above the pivot appears straight above it in the image.
    const Eigen::Vector2d above = pixelOf(camera, camera.pivot + Eigen::Vector3d(0, 0, 0.5));
    EXPECT_LT(above.y(), 300.0);
    EXPECT_NEAR(above.x(), 400.0, 1e-6);
}

TEST(ViewerCamera, SixStepsLeadFromOneAxisToTheNext) {
    const auto after = [](ViewerCamera::Axis begin, int right, int up) -> std::string {
        ViewerCamera camera;
        camera.lookFrom(begin);
        for (int i = 0; i < 6; ++i) camera.orbitBySteps(right, up);
        return camera.axisName();
    };
    EXPECT_EQ(after(ViewerCamera::Axis::Front, 1, 0), "Right");
    EXPECT_EQ(after(ViewerCamera::Axis::Front, -1, 0), "Left");
    EXPECT_EQ(after(ViewerCamera::Axis::Front, 0, 1), "Top");
    EXPECT_EQ(after(ViewerCamera::Axis::Front, 0, -1), "Bottom");
    EXPECT_EQ(after(ViewerCamera::Axis::Top, 0, 1), "Top") << "it does not tip over";
}

TEST(ViewerCamera, LooksFromTheOppositeSide) {
    using Axis = ViewerCamera::Axis;
    ViewerCamera camera;
    for (const auto& [from, to] : {std::pair(Axis::Front, "Back"), std::pair(Axis::Left, "Right"),
                                   std::pair(Axis::Top, "Bottom")}) {
        camera.lookFrom(from);
        camera.lookFromOpposite();
        EXPECT_STREQ(camera.axisName(), to);
    }
    camera = {};
    const Eigen::Vector3d before = camera.pose().position;
    camera.lookFromOpposite();
    const Eigen::Vector3d moved = camera.pose().position - camera.pivot;
    EXPECT_NEAR((moved - Eigen::Vector3d(-before.x(), -before.y(), before.z())).norm(), 0.0, 1e-9);
}

TEST(ViewerCamera, ZoomKeepsThePointUnderTheCursor) {
    for (const bool orthographic : {false, true}) {
        ViewerCamera camera;
        camera.orthographic = orthographic;
        const Eigen::Vector3d at(0.7, -0.4, 0.3);
        const Eigen::Vector2d before = pixelOf(camera, at);
        camera.zoom(0.5, at);
        EXPECT_NEAR(camera.distance, 4.0, 1e-9);
        EXPECT_NEAR((pixelOf(camera, at) - before).norm(), 0.0, 1e-6) << orthographic;
    }
}

/// A uniform image of a surface 5 m in front of the camera.
ViewImage imageOf(const ViewerCamera& camera) {
    ViewImage image;
    image.view = camera.view(kWidth, kHeight);
    image.width = 1;
    image.height = 1;
    image.depth_m = {5.0F};
    image.ids = {1};
    image.serial = 1;
    return image;
}

TEST(ViewerCamera, ZoomsTowardsTheSurfaceOnlyWhileTheImageShowsTheCurrentView) {
    ViewerCamera camera;  // 8 m from its pivot
    const ViewImage image = imageOf(camera);
    const Eigen::Vector2d cursor(500, 200);
    const auto depthOfCentre = [&](const ViewImage* shown) {
        const render::View now = camera.view(kWidth, kHeight);
        const Eigen::Vector3d at = zoomCentre(shown, now, camera.pivot, cursor);
        EXPECT_NEAR((now.project(now.pose.toCamera(at)) - cursor).norm(), 0.0, 1e-6);
        return now.pose.toCamera(at).z();
    };
    EXPECT_NEAR(depthOfCentre(&image), 5.0, 1e-6);
    EXPECT_NEAR(depthOfCentre(nullptr), 8.0, 1e-6);
    camera.zoom(0.5, zoomCentre(&image, image.view, camera.pivot, cursor));
    // A step of the wheel later the image lags behind, but its surface is still under the cursor.
    EXPECT_NEAR(depthOfCentre(&image), 2.5, 1e-6);
    camera.pivot += Eigen::Vector3d(3, 1, 0);  // as framing another object does
    EXPECT_NEAR(depthOfCentre(&image), 4.0, 1e-6);
}

TEST(ViewerCamera, FramesABoxWithAllItsCornersInThePicture) {
    ViewerCamera camera;
    const Eigen::AlignedBox3d box(Eigen::Vector3d(-2, 3, 0), Eigen::Vector3d(4, 5, 2.5));
    camera.frame(box, static_cast<double>(kWidth) / kHeight);
    for (int i = 0; i < 8; ++i) {
        const Eigen::Vector2d at =
            pixelOf(camera, box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i)));
        EXPECT_GE(at.x(), 0.0);
        EXPECT_LE(at.x(), kWidth);
        EXPECT_GE(at.y(), 0.0);
        EXPECT_LE(at.y(), kHeight);
    }
}

TEST(ViewerCamera, AxisViewsLookAlongTheirAxis) {
    using Axis = ViewerCamera::Axis;
    ViewerCamera camera;
    camera.lookFrom(Axis::Top);
    EXPECT_NEAR((camera.pose().forward() - Eigen::Vector3d(0, 0, -1)).norm(), 0.0, 1e-9);
    // Seen from above, +x is right and +y is up in the image.
    EXPECT_GT(pixelOf(camera, {1, 0, 0}).x(), 400.0);
    EXPECT_LT(pixelOf(camera, {0, 1, 0}).y(), 300.0);
    camera.lookFrom(Axis::Front);
    EXPECT_NEAR((camera.pose().forward() - Eigen::Vector3d(0, 1, 0)).norm(), 0.0, 1e-9);
    camera.lookFrom(Axis::Right);
    EXPECT_NEAR((camera.pose().forward() - Eigen::Vector3d(-1, 0, 0)).norm(), 0.0, 1e-9);
}

TEST(ViewerCamera, TakesThePlaceOfAnotherCamera) {
    const Pose pose = lookAt({1, 2, 1.5}, {3, 1, 0.5});
    ViewerCamera camera;
    camera.standAt(pose, 2.0);
    EXPECT_NEAR((camera.pose().position - pose.position).norm(), 0.0, 1e-9);
    EXPECT_NEAR(angleBetween(camera.pose().rotation, pose.rotation), 0.0, 1e-6);
}

TEST(Gizmo, NearestPointOnAnAxis) {
    const render::ViewRay ray{{2, -5, 1}, {0, 1, 0}};
    const auto along = nearestAlong(ray, {0, 0, 0}, {1, 0, 0});
    ASSERT_TRUE(along.has_value());
    EXPECT_NEAR(*along, 2.0, 1e-9);
    EXPECT_FALSE(nearestAlong({{0, 0, 1}, {1, 0, 0}}, {0, 0, 0}, {1, 0, 0}).has_value());
}

TEST(FalseColor, IdsThatFollowEachOtherDifferClearly) {
    EXPECT_TRUE(colorOfId(0).isZero());
    for (int id = 1; id < 300; ++id) {
        EXPECT_GT((colorOfId(id) - colorOfId(id + 1)).norm(), 0.2F) << id;
    }
}

TEST(FalseColor, NormalsOfAWallStraightAheadFaceTheCamera) {
    render::FrameRecord record;
    record.width = 8;
    record.height = 6;
    record.depth_m.assign(48, 2.0F);
    record.instance.assign(48, 1);
    record.semantic.assign(48, 1);
    record.rgb.assign(144, 9);
    render::View view;
    view.intrinsics = {8, 6, 8, 8, 4, 3};
    const std::vector<std::uint8_t> rgba = falseColor(record, view, Modality::Normal);
    const std::size_t middle = 4UL * (3 * 8 + 4);
    EXPECT_NEAR(rgba[middle], 128, 1);
    EXPECT_NEAR(rgba[middle + 1], 128, 1);
    EXPECT_NEAR(rgba[middle + 2], 0, 1);  // towards the camera: -z
}

TEST(ViewerCamera, NamesTheAxisItLooksAlong) {
    ViewerCamera camera;
    using Axis = ViewerCamera::Axis;
    for (const auto& [axis, name] :
         {std::pair(Axis::Front, "Front"), std::pair(Axis::Back, "Back"),
          std::pair(Axis::Left, "Left"), std::pair(Axis::Right, "Right"),
          std::pair(Axis::Top, "Top"), std::pair(Axis::Bottom, "Bottom")}) {
        camera.lookFrom(axis);
        EXPECT_STREQ(camera.axisName(), name);
    }
    camera.orbit(10, 5);
    EXPECT_STREQ(camera.axisName(), "User");
}

TEST(ViewImage, ObjectsInABoxAreThoseWithAPixelInIt) {
    ViewImage image;
    image.serial = 1;
    image.width = 4;  // half the size of the pane
    image.height = 2;
    image.view.intrinsics.width = 8;
    image.view.intrinsics.height = 4;
    image.ids = {0, 7, 7, 3,  //
                 0, 0, 5, 3};
    const auto in = [&](double x0, double y0, double x1, double y1) {
        return objectsIn(image, {Eigen::Vector2d(x0, y0), Eigen::Vector2d(x1, y1)});
    };
    EXPECT_EQ(in(0, 0, 1.5, 3.5), std::vector<int>());
    EXPECT_EQ(in(2.1, 0, 3.9, 1.9), std::vector<int>({7}));
    EXPECT_EQ(in(3, 1, 5, 3), std::vector<int>({5, 7}));
    EXPECT_EQ(in(-9, -9, 99, 99), std::vector<int>({3, 5, 7}));
    image.serial = 0;
    EXPECT_EQ(in(0, 0, 8, 4), std::vector<int>()) << "there is no image yet";
}

}  // namespace
}  // namespace dollytrack::ui::viewer_camera_test
