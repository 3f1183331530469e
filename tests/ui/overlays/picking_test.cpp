#include "ui/overlays/picking.h"

#include "engine/camera/intrinsics.h"

#include <gtest/gtest.h>

#include <random>

namespace dollytrack::ui::picking_test {
namespace {

using render::OverlayMark;

/// Looks along x from the origin; the principal point is (320, 240), the focal length 554 px.
render::View viewAlongX() {
    render::View view;
    view.intrinsics = makeIntrinsics({});
    view.pose = lookAt({0, 0, 0}, {1, 0, 0});
    return view;
}

OverlayMark dot(const Eigen::Vector3d& at, int index) {
    return {at,           OverlayMark::Shape::Dot,
            {1, 1, 1, 1}, 10.0,
            {0, 0, 0},    toTag(Picked::PositionPoint, index)};
}

TEST(PickTag, KeepsKindAndIndex) {
    for (const int index : {0, 1, 70'000, (1 << 24) - 1}) {
        EXPECT_EQ(fromTag(toTag(Picked::Candidate, index)), (PickTag{Picked::Candidate, index}));
    }
    EXPECT_EQ(fromTag(render::kNoTag).kind, Picked::Nothing);
}

TEST(PartInBox, IsWhereThePointsOfTheLineAreInside) {
    const Eigen::AlignedBox3d box(Eigen::Vector3d(-1, 0, 2), Eigen::Vector3d(1, 3, 4));
    std::mt19937 random(3);
    std::uniform_real_distribution<double> place(-5.0, 5.0);
    std::uniform_int_distribution<int> zero(0, 3);
    int hits = 0;
    for (int i = 0; i < 2000; ++i) {
        const Eigen::Vector3d origin(place(random), place(random), place(random));
        Eigen::Vector3d direction(place(random), place(random), place(random));
        if (zero(random) == 0) direction[i % 3] = 0.0;
        const LineRange part = partInBox(box, origin, direction, {-0.5, 2.0});
        if (part.first <= part.last) ++hits;
        for (double t = -1.0; t < 2.5; t += 0.0137) {
            const bool inside = t >= -0.5 && t <= 2.0 && box.contains(origin + t * direction);
            ASSERT_EQ(inside, t >= part.first && t <= part.last) << "line " << i << " at " << t;
        }
    }
    EXPECT_GT(hits, 100);
    const LineRange none = partInBox(Eigen::AlignedBox3d(), {0, 0, 0}, {1, 0, 0}, {0.0, 9.0});
    EXPECT_GT(none.first, none.last);
}

TEST(PickElement, TakesTheNearestWithinReach) {
    const render::View view = viewAlongX();
    render::Overlay overlay;
    overlay.marks = {dot({2, 0, 0}, 1), dot({2, -0.04, 0}, 2)};  // at x = 320 and 331
    const auto at = [&](double x, double y) { return pickElement(overlay, view, {x, y}, 0.0); };
    ASSERT_TRUE(at(320, 247));
    EXPECT_EQ(at(320, 247)->tag.index, 1);
    EXPECT_NEAR(at(320, 247)->distance_px, 2.0, 1e-6);
    EXPECT_EQ(at(329, 240)->tag.index, 2);
    EXPECT_NEAR(at(329, 240)->depth_m, 2.0, 1e-9);
    EXPECT_FALSE(at(320, 252));
}

TEST(PickElement, PutsWhatIsSeenBeforeWhatIsHidden) {
    const render::View view = viewAlongX();
    render::Overlay overlay;
    overlay.marks = {dot({4, 0, 0}, 1), dot({2, -0.02, 0}, 2)};
    // Exactly on the far mark, but a wall at 3 m hides it.
    EXPECT_EQ(pickElement(overlay, view, {320, 240}, 0.0)->tag.index, 1);
    const auto picked = pickElement(overlay, view, {320, 240}, 3.0);
    EXPECT_EQ(picked->tag.index, 2);
    EXPECT_TRUE(picked->visible);
    overlay.marks.pop_back();
    EXPECT_FALSE(pickElement(overlay, view, {320, 240}, 3.0)->visible);
}

TEST(PickElement, MarksLieOnLinesAndLinesOnBoxes) {
    const render::View view = viewAlongX();
    render::Overlay overlay;
    overlay.boxes.push_back(
        {{1.5, 0, 0}, {0.1, 1, 1}, {1, 1, 1, 1}, 0.3, toTag(Picked::ObservationPoint, 9)});
    overlay.lines.push_back(
        {{2, -1, 0}, {2, 1, 0}, {1, 1, 1, 1}, 3.0, 0.0, toTag(Picked::Edge, 5)});
    overlay.marks = {dot({3, 0, 0}, 1)};
    EXPECT_EQ(pickElement(overlay, view, {321, 241}, 0.0)->tag.kind, Picked::PositionPoint);
    EXPECT_EQ(pickElement(overlay, view, {400, 243}, 0.0)->tag.kind, Picked::Edge);
    EXPECT_EQ(pickElement(overlay, view, {400, 300}, 0.0)->tag.kind, Picked::ObservationPoint);
    overlay.boxes[0].tag = render::kNoTag;
    EXPECT_FALSE(pickElement(overlay, view, {400, 300}, 0.0));
}

TEST(PickElement, ListsEachElementOnceAndTheOneUnderThePointerFirst) {
    const render::View view = viewAlongX();
    render::Overlay overlay;
    // A point is drawn as several marks of one tag.
    overlay.marks = {dot({2, -0.04, 0}, 1), dot({2, -0.04, 0}, 1), dot({4, 0, 0}, 3)};
    overlay.lines.push_back(
        {{2, -1, 0}, {2, 1, 0}, {1, 1, 1, 1}, 3.0, 0.0, toTag(Picked::Edge, 5)});
    const auto found = pickElements(overlay, view, {321, 240}, 3.0);
    ASSERT_EQ(found.size(), 3U);
    EXPECT_EQ(found[0].tag.kind, Picked::Edge);
    EXPECT_TRUE(found[0].on);
    EXPECT_EQ(found[1].tag.index, 1) << "5 px beside its outline";
    EXPECT_FALSE(found[1].on);
    EXPECT_EQ(found[2].tag.index, 3) << "behind a wall at 3 m";
    EXPECT_FALSE(found[2].visible);
}

TEST(PickElement, NothingOutsideTheClippingBoxIsPicked) {
    render::View view = viewAlongX();
    view.clip_box = Eigen::AlignedBox3d(Eigen::Vector3d(1, -0.2, -1), Eigen::Vector3d(3, 0.2, 1));
    render::Overlay overlay;
    overlay.marks = {dot({2, 0, 0}, 1), dot({0.9, 0, 0.2}, 2)};
    overlay.lines.push_back(
        {{2, -1, 0.5}, {2, 1, 0.5}, {1, 1, 1, 1}, 3.0, 0.0, toTag(Picked::Edge, 5)});
    overlay.boxes.push_back(
        {{2, 0, -0.5}, {1.5, 1, 0.1}, {1, 1, 1, 1}, 0.0, toTag(Picked::ObservationPoint, 9)});
    const auto at = [&](const Eigen::Vector3d& place) {
        return pickElement(overlay, view, view.project(view.pose.toCamera(place)), 0.0);
    };
    ASSERT_TRUE(at({2, 0, 0}));
    EXPECT_EQ(at({2, 0, 0})->tag.index, 1);
    EXPECT_FALSE(at({0.9, 0, 0.2})) << "nearer than the box";
    ASSERT_TRUE(at({2, 0.15, 0.5}));
    EXPECT_EQ(at({2, 0.15, 0.5})->tag.index, 5);
    EXPECT_FALSE(at({2, 0.5, 0.5})) << "the line's part beside the box";
    ASSERT_TRUE(at({2, 0, -0.5}));
    EXPECT_NEAR(at({2, 0, -0.5})->depth_m, 1.6, 1e-9) << "where the ray enters its top";
    EXPECT_FALSE(at({2, 0.5, -0.5})) << "the box's part beside it";
}

TEST(PickElement, FollowsALineThatEndsBehindTheCamera) {
    render::View view = viewAlongX();
    render::Overlay overlay;
    overlay.lines.push_back(
        {{-5, 0, -0.5}, {5, 0, -0.5}, {1, 1, 1, 1}, 2.0, 0.0, toTag(Picked::Frame, 3)});
    const Eigen::Vector2d at = view.project(view.pose.toCamera({1.25, 0, -0.5}));
    const auto picked = pickElement(overlay, view, at, 0.0);
    ASSERT_TRUE(picked);
    EXPECT_NEAR(picked->depth_m, 1.25, 1e-9);
    view.orthographic = render::Orthographic{100.0, 50.0};
    const auto parallel = pickElement(overlay, view, {320, 290}, 0.0);
    ASSERT_TRUE(parallel);
    EXPECT_EQ(parallel->tag.index, 3);
}

}  // namespace
}  // namespace dollytrack::ui::picking_test
