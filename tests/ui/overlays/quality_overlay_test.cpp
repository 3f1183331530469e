#include "ui/overlays/quality_overlay.h"

#include "ui/overlays/palette.h"
#include "ui/overlays/pick_tag.h"
#include "ui/overlays/trajectory_overlay.h"

#include <gtest/gtest.h>

#include <set>

namespace dollytrack::ui::quality_overlay_test {
namespace {

using Mark = render::OverlayMark;

/// Frames 1 m apart along x, on two paths of three frames.
Plan sixFrames() {
    Plan plan;
    for (int i = 0; i < 6; ++i) {
        TrajectoryFrame& frame = plan.trajectory.frames.emplace_back();
        frame.pose.position = {static_cast<double>(i), 0.0, 1.0};
        frame.path = i / 3;
    }
    return plan;
}

FrameQuality weakQuality() {
    FrameQuality quality;
    quality.image_corners = {100.0, 149.0, 150.0, 20.0, 500.0, 500.0};
    quality.overlap = {1.0, 0.6, 0.59, 1.0, 0.8, 0.1};
    return quality;
}

std::set<int> framesOf(const render::Overlay& overlay, const Eigen::Vector4f& rgba,
                       Mark::Shape shape) {
    std::set<int> frames;
    for (const Mark& mark : overlay.marks) {
        if (mark.rgba == rgba && mark.shape == shape) frames.insert(fromTag(mark.tag).index);
    }
    return frames;
}

}  // namespace

TEST(QualityLayer, MarksFramesOfFewCornersAndWideGaps) {
    const Plan plan = sixFrames();
    const PlanLayer layer = qualityLayer(plan, weakQuality(), {}, {});
    // A dot where each stretch begins: frames 0 and 1 are one, frame 3 begins a path.
    EXPECT_EQ(framesOf(layer.overlay, kWarningColor, Mark::Shape::Dot), (std::set<int>{0, 3}));
    EXPECT_EQ(framesOf(layer.overlay, kGapColor, Mark::Shape::Cross), (std::set<int>{2, 5}));
    // Lines lead to frames 1 (few corners), 2 and 5 (gaps); frames 0 and 3 begin paths.
    ASSERT_EQ(layer.overlay.lines.size(), 3U);
    for (const render::OverlayLine& line : layer.overlay.lines) {
        const int frame = fromTag(line.tag).index;
        EXPECT_EQ(line.b.x(), frame);
        EXPECT_EQ(line.a.x(), frame - 1);
        EXPECT_EQ(line.dash_px > 0.0, frame != 1);
    }
    ASSERT_EQ(layer.legend.entries.size(), 2U);
    EXPECT_EQ(layer.legend.entries[0].name, "Fewer than 150 image corners");
    EXPECT_EQ(layer.legend.entries[0].count, 3);
    EXPECT_EQ(layer.legend.entries[1].name, "Overlap below 60 %");
    EXPECT_EQ(layer.legend.entries[1].count, 2);

    const PlanLayer gaps = qualityLayer(plan, weakQuality(), {}, {.untrackable = false});
    EXPECT_EQ(gaps.overlay.lines.size(), 2U);
    EXPECT_EQ(gaps.legend.entries.size(), 1U);
}

TEST(QualityLayer, IsEmptyForAnotherTrajectory) {
    FrameQuality quality = weakQuality();
    quality.overlap.pop_back();
    const PlanLayer layer = qualityLayer(sixFrames(), quality, {}, {});
    EXPECT_TRUE(layer.overlay.marks.empty());
    EXPECT_TRUE(layer.legend.entries.empty());
    EXPECT_EQ(qualityText(sixFrames(), quality, {}, 2), "");
}

TEST(QualityLayer, TextHasTheNumbersAndThoseNeeded) {
    const Plan plan = sixFrames();
    EXPECT_EQ(qualityText(plan, weakQuality(), {}, 0), "100 image corners, 150 needed");
    EXPECT_EQ(qualityText(plan, weakQuality(), {}, 2),
              "150 image corners\n59 % shared with the frame before, 60 % needed");
    EXPECT_EQ(qualityText(plan, weakQuality(), {}, 4),
              "500 image corners\n80 % shared with the frame before");
}

TEST(QualityLayer, MarksImagesWithoutContent) {
    using render::PictureQuality;
    std::vector<PictureQuality> classes(6, PictureQuality::Usable);
    classes[1] = PictureQuality::Dark;
    classes[4] = PictureQuality::Flat;
    const auto pictures = std::make_shared<const std::vector<PictureQuality>>(classes);
    const Plan plan = sixFrames();
    const PlanLayer layer = qualityLayer(plan, weakQuality(), pictures, {});
    EXPECT_EQ(framesOf(layer.overlay, kUnusableColor, Mark::Shape::Square), (std::set<int>{1, 4}));
    ASSERT_EQ(layer.legend.entries.size(), 3U);
    EXPECT_EQ(layer.legend.entries[2].name, "Dark, white or flat image");
    EXPECT_EQ(layer.legend.entries[2].count, 2);
    EXPECT_EQ(qualityText(plan, weakQuality(), pictures, 4),
              "500 image corners\nflat image\n80 % shared with the frame before");
    const PlanLayer without = qualityLayer(plan, weakQuality(), pictures, {.unusable = false});
    EXPECT_EQ(without.legend.entries.size(), 2U);
}

TEST(KeptPlanLayer, DrawsTheOtherTrajectoryWithinItsPaths) {
    const PlanLayer layer = keptPlanLayer(sixFrames().trajectory, "room.dolly");
    EXPECT_EQ(layer.overlay.lines.size(), 4U);
    EXPECT_TRUE(layer.overlay.marks.empty());
    for (const render::OverlayLine& line : layer.overlay.lines) {
        EXPECT_EQ(line.b.x() - line.a.x(), 1.0);
        EXPECT_NE(line.a.x(), 2.0);
        EXPECT_EQ(fromTag(line.tag).kind, Picked::Nothing);
    }
    ASSERT_EQ(layer.legend.entries.size(), 1U);
    EXPECT_EQ(layer.legend.entries[0].name, "B: room.dolly");
    EXPECT_EQ(layer.legend.entries[0].count, 6);
}

}  // namespace dollytrack::ui::quality_overlay_test
