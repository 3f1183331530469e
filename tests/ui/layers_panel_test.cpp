#include "ui/panels/scene/layers_panel.h"

#include "tests/ui/screen.h"

#include <gtest/gtest.h>

namespace dollytrack::ui::layers_panel_test {
namespace {

struct Layers {
    Layers() {
        view.room = {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(4, 3, 2.5)};
        view.has_map = true;
        view.has_plan = view.has_surface = true;
    }
    void draw() {
        const LayersActions actions = drawLayersPanel(view, settings, clip);
        changes += actions.changed;
        finished += actions.finished;
    }
    LayersView view;
    LayerSettings settings;
    ClipSettings clip;
    int changes = 0;
    int finished = 0;
};

TEST(LayersPanel, EverySwitchChangesOneSetting) {
    Layers layers;
    layers.settings.free_space = true;
    layers.settings.roadmap = true;
    test::Screen screen([&] { layers.draw(); }, 360, 1200);
    for (const char* name : {"cells.free",      "cells.occupied",     "cells.unknown",
                             "sliced",          "points.observation", "points.position",
                             "points.frustums", "roadmap.accepted",   "roadmap.refused",
                             "roadmap.links",   "roadmap.samples",    "roadmap.dropped",
                             "roadmap.path",    "trajectory.arrows",  "cone",
                             "no_go_boxes",     "ceiling_cut",        "grid",
                             "candidates",      "trajectory",         "points",
                             "roadmap",         "free_space",         "surface.unseen",
                             "surface.seen",    "surface.covered",    "surface"}) {
        const LayerSettings before = layers.settings;
        const int changes = layers.changes;
        ASSERT_TRUE(screen.click(std::string("layers.") + name)) << name << ": " << screen.names();
        EXPECT_FALSE(layers.settings == before) << name;
        EXPECT_EQ(layers.changes, changes + 1) << name;
    }
    EXPECT_EQ(layers.finished, layers.changes);
    EXPECT_FALSE(screen.shows("layers.cells.free")) << "a layer that is off has no details";
}

TEST(LayersPanel, LeavesOutWhatIsAboveAHeightOrOutsideABox) {
    Layers layers;
    test::Screen screen([&] { layers.draw(); }, 360, 1200);
    EXPECT_FALSE(layers.clip.shown().has_value());
    ASSERT_TRUE(screen.click("layers.hide_above")) << screen.names();
    ASSERT_TRUE(layers.clip.shown().has_value());
    EXPECT_EQ(layers.clip.shown()->max().z(), 1.25) << "half the height of the scene";
    EXPECT_LT(layers.clip.shown()->min().minCoeff(), -1e6);
    ASSERT_TRUE(screen.typeInto("layers.hide_above.height", "1.5"));
    EXPECT_EQ(layers.clip.shown()->max().z(), 1.5);
    ASSERT_TRUE(screen.click("layers.clip_box"));
    ASSERT_TRUE(screen.typeInto("layers.clip.y.low", "1"));
    ASSERT_TRUE(screen.typeInto("layers.clip.y.high", "0.2"));
    const Eigen::AlignedBox3d shown = *layers.clip.shown();
    EXPECT_EQ(shown.min().y(), 1.0);
    EXPECT_EQ(shown.max().y(), 1.0) << "the upper limit stays above the lower one";
    EXPECT_EQ(shown.max().z(), 1.5) << "both hold";
    EXPECT_NEAR(shown.max().x(), 4.01, 1e-9) << "the whole scene where nothing is said";
}

TEST(LayersPanel, OffersSurfaceOnlyWhereThePlanAimsAtIt) {
    Layers layers;
    layers.view.has_surface = false;
    test::Screen screen([&] { layers.draw(); }, 360, 1200);
    EXPECT_FALSE(screen.enabled("layers.surface"));
    EXPECT_FALSE(screen.shows("layers.surface.unseen"));
}

TEST(LayersPanel, ChoosesWhichWeakFramesAreShown) {
    Layers layers;
    layers.settings.quality = true;
    layers.view.has_kept_plan = true;
    test::Screen screen([&] { layers.draw(); }, 360, 1200);
    for (const char* name : {"quality.untrackable", "quality.wide_gaps", "quality.unusable",
                             "quality.unseen_surface", "kept_plan", "quality"}) {
        const LayerSettings before = layers.settings;
        ASSERT_TRUE(screen.click(std::string("layers.") + name)) << name << ": " << screen.names();
        EXPECT_FALSE(layers.settings == before) << name;
    }
    EXPECT_EQ(layers.changes, 6);
    EXPECT_FALSE(screen.shows("layers.quality.wide_gaps"));
}

TEST(LayersPanel, StopsTheMeasurementOfWeakFramesOrOnlyItsImages) {
    Layers layers;
    layers.settings.quality = true;
    test::Screen screen([&] { layers.draw(); }, 360, 1200);
    EXPECT_FALSE(screen.shows("layers.quality.stop"));
    layers.view.judging_images = true;
    screen.frame(2);
    ASSERT_TRUE(screen.click("layers.quality.stop")) << screen.names();
    EXPECT_FALSE(layers.settings.quality_options.unusable);
    EXPECT_TRUE(layers.settings.quality);
    layers.view.judging_images = false;
    layers.view.measuring_quality = true;
    screen.frame(2);
    ASSERT_TRUE(screen.click("layers.quality.stop")) << screen.names();
    EXPECT_FALSE(layers.settings.quality);
    EXPECT_EQ(layers.changes, 2);
}

TEST(LayersPanel, ChoosesColours) {
    Layers layers;
    test::Screen screen([&] { layers.draw(); }, 360, 900);
    screen.click("layers.trajectory.color");
    ASSERT_TRUE(screen.click("layers.trajectory.color.turn rate")) << screen.names();
    EXPECT_EQ(layers.settings.trajectory_options.color, TrajectoryColor::TurnRate);
}

TEST(LayersPanel, ChoosesAStoreyWhereThereAreSeveral) {
    Layers layers;
    {
        test::Screen screen([&] { layers.draw(); }, 360, 900);
        EXPECT_FALSE(screen.shows("layers.storey")) << "one storey is no choice";
    }
    layers.view.storeys = 3;
    {
        test::Screen screen([&] { layers.draw(); }, 360, 900);
        ASSERT_TRUE(screen.click("layers.storey")) << screen.names();
        ASSERT_TRUE(screen.click("layers.storey.2")) << screen.names();
        EXPECT_EQ(layers.settings.storey, 2);
    }
    layers.settings.ceiling_cut = false;
    test::Screen screen([&] { layers.draw(); }, 360, 900);
    EXPECT_FALSE(screen.shows("layers.storey")) << "nothing is cut";
}

TEST(LayersPanel, KeepsTheSliceInTheRoom) {
    Layers layers;
    layers.settings.free_space = true;
    layers.settings.slice.position_m = 40.0;
    test::Screen screen([&] { layers.draw(); }, 360, 900);
    EXPECT_EQ(layers.settings.slice.position_m, 2.5);
    screen.click("layers.slice.axis");
    ASSERT_TRUE(screen.click("layers.slice.axis.x")) << screen.names();
    EXPECT_EQ(layers.settings.slice.axis, 0);
    ASSERT_TRUE(screen.typeInto("layers.slice.position", "3.25"));
    EXPECT_NEAR(layers.settings.slice.position_m, 3.25, 1e-6);
}

TEST(LayersPanel, SaysWhatCannotBeShownYet) {
    Layers layers;
    layers.view.has_map = false;
    layers.view.has_plan = false;
    test::Screen screen([&] { layers.draw(); }, 360, 900);
    for (const char* name : {"free_space", "points", "roadmap", "trajectory", "candidates"}) {
        EXPECT_FALSE(screen.enabled(std::string("layers.") + name)) << name;
    }
    EXPECT_TRUE(screen.enabled("layers.grid"));
}

}  // namespace
}  // namespace dollytrack::ui::layers_panel_test
