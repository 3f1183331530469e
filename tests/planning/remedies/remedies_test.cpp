#include "planning/remedies/remedies.h"

#include "engine/document/operation.h"
#include "engine/plan/remedy_operations.h"

#include "planning/pipeline/pipeline.h"
#include "tests/planning/support/rising_progress.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace dollytrack::planning::remedies_test {
namespace {

const test::SceneBuilder::Look kWallLook = {kNyuWall, Role::Structure, {0.8F, 0.8F, 0.8F}};

/// Plans, searches for remedies, and carries them out.
struct Treated {
    explicit Treated(Scene made, PlanParams with = {}, PlanEdits by_hand = {})
        : scene(std::make_shared<const Scene>(std::move(made))),
          params(std::move(with)),
          edits(std::move(by_hand)) {
        const auto plan = planOf(*scene, params, edits);
        test_support::RisingProgress progress;
        rows = *findRemedies(scene, params, edits, *plan, plan->ledger, progress.job());
        if (progress.reports() > 0) {
            EXPECT_NEAR(progress.last(), 1.0, 1e-9);
        }
    }

    static std::shared_ptr<const Plan> planOf(const Scene& scene, const PlanParams& params,
                                              const PlanEdits& edits) {
        Pipeline pipeline(std::make_shared<const Scene>(scene));
        test_support::RisingProgress progress;
        auto plan = pipeline.run(params, edits, progress.job());
        EXPECT_TRUE(plan.has_value()) << describe(plan.error());
        return *plan;
    }

    const LedgerRow& row(const std::string& name) const {
        return *std::ranges::find_if(
            rows, [&](const LedgerRow& r) { return scene->object(r.object_id).name == name; });
    }

    /// The object's capture when its remedy is applied and everything is planned from scratch.
    ObjectCapture cured(const LedgerRow& row) const {
        Scene changed = *scene;
        PlanParams now = params;
        PlanEdits with = edits;
        const Remedy& remedy = *row.remedy;
        ProjectState state{.parameters = toJson(listFields(now)), .edits = {{}, with}};
        const auto done = applyOperations(state, changed, setParameter,
                                          remedyOperations(changed, row.object_id, remedy));
        EXPECT_TRUE(done) << describe(done.error());
        EXPECT_TRUE(setFromJson(listFields(now), state.parameters));
        with = state.edits.plan;
        if (remedy.move_object != 0) {  // out of the building
            const Object& object = changed.object(remedy.move_object);
            for (std::uint32_t v = 0; v < object.vertex_count; ++v) {
                changed.positions[object.first_vertex + v].y() += 4.0F;
            }
        }
        const auto plan = planOf(changed, now, with);
        return *std::ranges::find(plan->captures, row.object_id, &ObjectCapture::object_id);
    }

    std::shared_ptr<const Scene> scene;
    PlanParams params;
    PlanEdits edits;
    std::vector<LedgerRow> rows;
};

/// A coin at the end of a square shaft into a thick wall.
Scene coinInAShaft(double width, double depth) {
    test::SceneBuilder builder;
    const double far = 3.0 + depth;
    builder.room({0, 0, 0}, {far, 3, 2.6});
    const double y = 1.5 - 0.5 * width;
    const double z = 1.3 - 0.5 * width;
    builder.object("block", kWallLook)
        .box({3.0 + 0.5 * depth, 0.5 * y, 1.3}, {depth, y, 2.6})
        .box({3.0 + 0.5 * depth, 3.0 - 0.5 * y, 1.3}, {depth, y, 2.6})
        .box({3.0 + 0.5 * depth, 1.5, 0.5 * z}, {depth, width, z})
        .box({3.0 + 0.5 * depth, 1.5, 2.6 - 0.5 * z}, {depth, width, z});
    builder.object("coin").box({far - 0.03, 1.5, 1.3}, {0.05, 0.06, 0.06});
    return builder.build();
}

}  // namespace

TEST(Remedies, NothingIsProposedForWhatIsWell) {
    const Treated room(test::furnishedRoom());
    for (const LedgerRow& row : room.rows) {
        EXPECT_FALSE(row.loss);
        EXPECT_FALSE(row.remedy);
    }
}

TEST(Remedies, ANoGoBoxIsToldByName) {
    test::SceneBuilder builder;
    builder.room({0, 0, 0}, {8, 3, 2.6});
    builder.object("coin").box({1, 1.5, 1.0}, {0.05, 0.05, 0.05});
    builder.object("chest").box({7, 1.5, 0.3}, {0.5, 0.5, 0.5});
    PlanEdits edits;
    edits.no_go.resize(2);
    edits.no_go[0].name = "stage";
    edits.no_go[0].box = {{1.5, 1.5, 1.3}, {2.5, 2, 2}, 0.0};
    edits.no_go[1].name = "corner";
    edits.no_go[1].box = {{7.8, 0.2, 0.2}, {0.2, 0.2, 0.2}, 0.0};
    const Treated stage(builder.build(), {}, edits);
    const LedgerRow& coin = stage.row("coin");
    EXPECT_EQ(coin.loss, Loss::NoFreePose);
    ASSERT_TRUE(coin.remedy) << coin.reason;
    EXPECT_EQ(coin.remedy->remove_no_go, "stage");
    EXPECT_TRUE(stage.cured(coin).captured);
}

// An object on a high shelf under the ceiling is visible only from above the shelf's board.
TEST(Remedies, TheHeightBandIsWidenedAsFarAsNeeded) {
    test::SceneBuilder builder;
    builder.room({0, 0, 0}, {4, 3, 2.6});
    builder.object("shelf", kWallLook).box({3.7, 1.5, 1.2}, {0.6, 3.0, 2.4 - 1.0});
    builder.object("plate").box({3.7, 1.5, 1.91}, {0.3, 0.3, 0.02});
    PlanParams params;
    params.free_space.max_height_m = 1.5;
    const Treated room(builder.build(), params);
    const LedgerRow& plate = room.row("plate");
    ASSERT_FALSE(plate.well_captured);
    ASSERT_TRUE(plate.remedy) << plate.reason;
    ASSERT_EQ(plate.remedy->settings.size(), 1U);
    EXPECT_EQ(plate.remedy->settings[0].rfind("max_height_m=", 0), 0U);
    EXPECT_GT(std::stod(plate.remedy->settings[0].substr(13)), 1.7);
    EXPECT_LT(std::stod(plate.remedy->settings[0].substr(13)), 2.6);
    EXPECT_TRUE(room.cured(plate).captured);
}

// A tray on the floor, and a camera that looks up: its image ends above the horizon.
TEST(Remedies, ThePitchBandIsLoosenedAsFarAsNeeded) {
    test::SceneBuilder builder;
    builder.room({0, 0, 0}, {4, 3, 2.6});
    builder.object("tray").box({2.0, 1.5, 0.02}, {0.5, 0.5, 0.04});
    builder.object("chest").box({0.5, 0.5, 0.7}, {0.5, 0.5, 1.4});
    PlanParams params;
    params.constraints.min_pitch_deg = 30.0;
    const Treated room(builder.build(), params);
    const LedgerRow& tray = room.row("tray");
    ASSERT_FALSE(tray.captured);
    EXPECT_EQ(tray.loss, Loss::PitchBand);
    EXPECT_NE(tray.reason.find("30 .. 90"), std::string::npos) << tray.reason;
    ASSERT_TRUE(tray.remedy) << tray.reason;
    ASSERT_EQ(tray.remedy->settings.size(), 1U);
    ASSERT_EQ(tray.remedy->settings[0].rfind("min_pitch_deg=", 0), 0U) << tray.remedy->text;
    const double lowest = std::stod(tray.remedy->settings[0].substr(14));
    EXPECT_TRUE(room.cured(tray).well_captured);
    // Half of the change is not enough.
    params.constraints.min_pitch_deg = 0.5 * (30.0 + lowest);
    const auto half = Treated::planOf(*room.scene, params, {});
    EXPECT_FALSE(std::ranges::find(half->captures, tray.object_id, &ObjectCapture::object_id)
                     ->well_captured);
}

// Where every position may look at the object, the band is not the cause.
TEST(Remedies, APitchBandThatKeepsNothingOutIsLeftAlone) {
    PlanParams params = {};
    params.constraints.min_pitch_deg = -60.0;
    params.camera.camera_radius_m = 0.3;
    const Treated wall(coinInAShaft(0.5, 2.5), params);
    const LedgerRow& coin = wall.row("coin");
    ASSERT_TRUE(coin.remedy) << coin.reason;
    EXPECT_EQ(coin.reason.find("pitch"), std::string::npos) << coin.reason;
    for (const std::string& setting : coin.remedy->settings) {
        EXPECT_EQ(setting.find("pitch"), std::string::npos) << setting;
    }
}

// From 1.1 m away 60 degrees span 1.3 m, and the poster is 3 m wide; a slanted view needs less.
TEST(Remedies, AWideLensShowsWhatDoesNotFit) {
    test::SceneBuilder builder;
    builder.room({0, 0, 0}, {4, 1.2, 2.6});
    builder.object("poster").box({2, 1.19, 1.3}, {3.0, 0.02, 2.0});
    const Treated corridor(builder.build());
    const LedgerRow& poster = corridor.row("poster");
    EXPECT_FALSE(poster.captured);
    EXPECT_EQ(poster.loss, Loss::DoesNotFit) << poster.reason;
    ASSERT_TRUE(poster.remedy) << poster.reason;
    ASSERT_EQ(poster.remedy->settings[0].rfind("hfov_deg=", 0), 0U) << poster.remedy->text;
    const double hfov = std::stod(poster.remedy->settings[0].substr(9));
    EXPECT_GT(hfov, 60.0);
    EXPECT_TRUE(corridor.cured(poster).captured);
    // The lens is no wider than necessary.
    PlanParams narrower;
    narrower.camera.hfov_deg = hfov - 5.0;
    const auto plan = Treated::planOf(*corridor.scene, narrower, {});
    EXPECT_FALSE(
        std::ranges::find(plan->captures, poster.object_id, &ObjectCapture::object_id)->captured);
}

// A shaft 0.5 m wide holds a camera of radius 0.2 m, not one of 0.3 m.
TEST(Remedies, ASmallerCameraGoesIn) {
    PlanParams params;
    params.camera.camera_radius_m = 0.3;
    const Treated wall(coinInAShaft(0.5, 2.5), params);
    const LedgerRow& coin = wall.row("coin");
    EXPECT_FALSE(coin.well_captured);
    ASSERT_TRUE(coin.remedy) << coin.reason;
    ASSERT_EQ(coin.remedy->settings[0].rfind("camera_radius_m=", 0), 0U) << coin.remedy->text;
    const double radius = std::stod(coin.remedy->settings[0].substr(16));
    EXPECT_LE(radius, 0.24);
    EXPECT_GE(radius, 0.15);
    EXPECT_TRUE(wall.cured(coin).well_captured);
}

// A vase in an alcove closed by a screen.
TEST(Remedies, AScreenIsToBeMoved) {
    test::SceneBuilder builder;
    builder.room({0, 0, 0}, {4, 3, 2.6});
    builder.object("alcove", kWallLook)
        .box({3.5, 1.1, 1.3}, {1.0, 0.1, 2.6})
        .box({3.5, 1.9, 1.3}, {1.0, 0.1, 2.6})
        .box({3.5, 1.5, 2.0}, {1.0, 0.7, 1.2})
        .box({3.5, 1.5, 0.4}, {1.0, 0.7, 0.8});
    builder.object("screen").box({2.98, 1.5, 1.1}, {0.02, 0.8, 0.8});
    builder.object("vase").box({3.3, 1.5, 0.95}, {0.2, 0.2, 0.3});
    const Treated room(builder.build());
    const LedgerRow& vase = room.row("vase");
    EXPECT_FALSE(vase.captured);
    ASSERT_TRUE(vase.remedy) << vase.reason;
    ASSERT_NE(vase.remedy->move_object, 0) << vase.remedy->text;
    EXPECT_EQ(room.scene->object(vase.remedy->move_object).name, "screen");
    EXPECT_TRUE(room.cured(vase).captured);
}

TEST(Remedies, WhatIsWalledInHasNoneAndSaysBehindWhat) {
    test::SceneBuilder builder;
    builder.room({0, 0, 0}, {4, 3, 2.6});
    builder.object("vault", kWallLook).box({2, 1.5, 0.4}, {0.8, 0.8, 0.8});
    builder.object("coin").box({2, 1.5, 0.4}, {0.1, 0.1, 0.1});
    builder.object("chest").box({0.5, 0.5, 0.25}, {0.5, 0.5, 0.5});
    const Treated room(builder.build());
    const LedgerRow& coin = room.row("coin");
    EXPECT_EQ(coin.loss, Loss::Occluded) << coin.reason;
    EXPECT_FALSE(coin.remedy);
    EXPECT_NE(coin.reason.find("vault"), std::string::npos) << coin.reason;
}

TEST(Remedies, ABudgetIsRaisedByAsMuchAsItTakes) {
    PlanParams params;
    params.timing.max_frames = 1;
    const Treated room(test::furnishedRoom(), params);
    int over = 0;
    for (const LedgerRow& row : room.rows) {
        if (row.loss != Loss::OverBudget) continue;
        ++over;
        ASSERT_TRUE(row.remedy) << row.reason;
        EXPECT_TRUE(room.cured(row).captured) << row.remedy->text;
    }
    EXPECT_GE(over, 1);
}

TEST(Remedies, ARemovedPointIsToBeRestored) {
    test::SceneBuilder builder;
    builder.room({0, 0, 0}, {4, 3, 2.6});
    builder.object("crate").box({0.6, 0.6, 0.3}, {0.6, 0.6, 0.6});
    builder.object("trunk").box({3.4, 2.4, 0.3}, {0.6, 0.6, 0.6});
    PlanEdits edits;
    edits.removed = {{{{7, "crate"}}}};
    const Treated room(builder.build(), {}, edits);
    const LedgerRow& crate = room.row("crate");
    EXPECT_EQ(crate.loss, Loss::ByHand);
    ASSERT_TRUE(crate.remedy);
    EXPECT_EQ(crate.remedy->restore_points.size(), 1U);
    EXPECT_TRUE(room.cured(crate).captured);
}

}  // namespace dollytrack::planning::remedies_test
