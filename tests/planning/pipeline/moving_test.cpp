#include "engine/core/random.h"
#include "engine/document/apply_scene_edits.h"
#include "engine/geometry/ray_caster.h"
#include "engine/jobs/parallel.h"
#include "engine/plan/plan_json.h"
#include "engine/scene/move_object.h"
#include "planning/collision/swept_sphere.h"
#include "planning/free_space/free_space.h"
#include "planning/pipeline/pipeline.h"
#include "planning/targets/observation_points.h"
#include "planning/viewpoints/viewpoint_search.h"
#include "planning/visibility/view_estimator.h"
#include "tests/planning/support/moving_support.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <atomic>
#include <functional>

namespace dollytrack::planning::moving_test {
namespace {

using namespace test_support;

/// The whole content of a plan except for the times it took, every number with all its digits.
std::string wordsOf(const Plan& plan) {
    nlohmann::json all = {{"trajectory", trajectoryJson(plan.trajectory)}};
    const auto point = [](const Eigen::Vector3d& p) { return nlohmann::json{p.x(), p.y(), p.z()}; };
    for (const ViewpointSearch& search : plan.searches) {
        nlohmann::json tried = nlohmann::json::array();
        for (const Candidate& c : search.candidates) {
            tried.push_back({point(c.position), c.fill, c.visible_fraction,
                             static_cast<int>(c.verdict), c.occluder});
        }
        all["searches"].push_back(std::move(tried));
    }
    for (const PositionPoint& p : plan.position_points) {
        all["points"].push_back({point(p.pose.position), p.component, p.well_captured, p.captured});
    }
    for (const auto& views : plan.frame_views) {
        for (const ObjectView& view : views) {
            all["views"].push_back({view.object_id, view.frame, view.visible_fraction,
                                    view.visible_px, view.box_share, view.mask_share});
        }
    }
    all["keys"] = plan.key_frames;
    for (const LedgerRow& row : plan.ledger) {
        all["ledger"].push_back({row.object_id, row.captured, row.well_captured, row.reason});
    }
    return all.dump();
}

std::string planOf(Pipeline& pipeline, const PlanParams& params = {}) {
    auto plan = pipeline.run(params, JobContext{});
    return plan ? wordsOf(**plan) : describe(plan.error());
}

std::string planFromScratch(const std::shared_ptr<const Scene>& scene) {
    Pipeline pipeline(scene);
    return planOf(pipeline);
}

}  // namespace

TEST(Moving, PlansAsFromScratchAfterAnyMoves) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        Random random(seed, 7);
        const Scene imported = anyFlat(random, 1 + static_cast<int>(seed));
        SceneEdits edits;
        setThreadCount(4);
        Pipeline kept(std::make_shared<const Scene>(imported));
        planOf(kept);
        for (int step = 0; step < 10; ++step) {
            const std::vector<ObjectChange> changes = anyMoves(imported, random);
            for (const ObjectChange& change : changes) setMove(edits, change);
            const auto scene = std::make_shared<const Scene>(*applySceneEdits(imported, edits));
            setThreadCount(step % 2 == 0 ? 4 : 1);
            kept.setScene(scene, false);
            // Moves come faster than plans: some are replaced by the next before they were planned.
            if (random.below(4) == 0) continue;
            const std::string local = planOf(kept);
            setThreadCount(step % 2 == 0 ? 1 : 4);
            ASSERT_EQ(local, planFromScratch(scene))
                << "seed " << seed << ", step " << step << ": " << changes.front().object.name;
        }
    }
    setThreadCount(0);
}

// The door leaf cuts the flat into rooms of their own, and opens it again.
TEST(Moving, FollowsADoorThatIsShutAndOpened) {
    Random random(5, 7);
    const Scene imported = anyFlat(random, 2);
    const auto open = std::make_shared<const Scene>(imported);
    SceneEdits edits;
    setMove(edits, moveOf(imported, "leaf", {{0.2, -0.9, 0.0}, 0.0}));
    const auto shut = std::make_shared<const Scene>(*applySceneEdits(imported, edits));
    Pipeline pipeline(open);
    const auto before = *pipeline.run({}, JobContext{});
    EXPECT_EQ(before->rooms.size(), 1U);
    pipeline.setScene(shut, false);
    const auto apart = *pipeline.run({}, JobContext{});
    EXPECT_EQ(apart->rooms.size(), 2U);
    EXPECT_EQ(wordsOf(*apart), planFromScratch(shut));
    pipeline.setScene(open, false);
    EXPECT_EQ(planOf(pipeline), wordsOf(*before));
}

// Parameters, edits and moves may change together, and a cancelled run may come in between.
TEST(Moving, KeepsNothingThatOtherChangesTouch) {
    Random random(9, 7);
    const Scene imported = anyFlat(random, 2);
    SceneEdits edits;
    Pipeline pipeline(std::make_shared<const Scene>(imported));
    planOf(pipeline);
    const std::vector<std::function<void(PlanParams&)>> changes = {
        [](PlanParams& p) { p.camera.camera_radius_m = 0.15; },
        [](PlanParams& p) { p.free_space.octree_resolution_m = 0.06; },
        [](PlanParams& p) { p.free_space.max_height_m = 1.6; },
        [](PlanParams& p) { p.camera.hfov_deg = 70; },
        [](PlanParams& p) { p.viewpoints.fill = 0.5; },
        [](PlanParams& p) { p.seed = 3; }};
    PlanParams params;
    for (const auto& change : changes) {
        setMove(edits, anyMove(imported, random));
        pipeline.setScene(std::make_shared<const Scene>(*applySceneEdits(imported, edits)), false);
        const auto flag = std::make_shared<std::atomic<bool>>(false);
        const double until = random.uniform();
        const JobContext impatient(flag, [&](double fraction, std::string_view) {
            if (fraction >= until) *flag = true;
        });
        (void)pipeline.run(params, impatient);
        setMove(edits, anyMove(imported, random));
        const auto scene = std::make_shared<const Scene>(*applySceneEdits(imported, edits));
        pipeline.setScene(scene, false);
        change(params);
        Pipeline fresh(scene);
        ASSERT_EQ(planOf(pipeline, params), planOf(fresh, params));
    }
}

// cross() must be true whenever a ray from the point to the box meets a moved object's box: brute
// force over many rays finds none for which it is false.
TEST(Moving, NeverDeniesARayThatMeetsSomething) {
    Random random(3, 7);
    const auto any = [&] { return random.uniform(-1.5, 1.5); };
    int met = 0;
    int denied = 0;
    for (int i = 0; i < 6000; ++i) {
        const Eigen::Vector3d from(any(), any(), any());
        const Eigen::Vector3d middle(any(), any(), any());
        const Eigen::Vector3d half(0.3 * random.uniform(), 0.3 * random.uniform(), 0.3);
        const Eigen::AlignedBox3d target(middle - half, middle + half);
        const Eigen::Vector3d at(any(), any(), any());
        const Eigen::AlignedBox3d thing(at, at + Eigen::Vector3d(0.4, 0.3, 0.2));
        MovedObjects moved;
        moved.add({1}, {thing});
        bool meets = false;
        for (int ray = 0; ray < 60 && !meets; ++ray) {
            const Eigen::Vector3d to =
                target.min() + Eigen::Vector3d(random.uniform(), random.uniform(), random.uniform())
                                   .cwiseProduct(target.sizes());
            for (int s = 0; s <= 50 && !meets; ++s) {
                meets = thing.contains(Eigen::Vector3d(from + (to - from) * s / 50.0));
            }
        }
        met += meets ? 1 : 0;
        denied += moved.cross(from, target) ? 0 : 1;
        EXPECT_TRUE(!meets || moved.cross(from, target));
    }
    EXPECT_GT(met, 100);
    EXPECT_GT(denied, 3000);  // otherwise no result would be reused
}

TEST(Moving, WhatStandsFarAwayIsNotSearchedAgain) {
    Random random(2, 7);
    const Scene before = anyFlat(random, 3);
    SceneEdits edits;
    const ObjectChange change = moveOf(before, "crate_0", {{0.05, 0.0, 0.0}, 0.0});
    setMove(edits, change);
    const Scene after = *applySceneEdits(before, edits);
    const PlanParams params;
    const RayCaster rays(before);
    const RayCaster rays_after(after);
    const auto map = FreeSpace::build(before, rays, params.camera, params.free_space);
    const auto map_after = FreeSpace::build(after, rays_after, params.camera, params.free_space);
    ASSERT_TRUE(map && map_after);
    const ViewEstimator views(before, rays, params.camera);
    const SweptSphere sphere(rays, *map, params.camera.camera_radius_m);
    const auto points = setObservationPoints(views, params.targets, params.viewpoints);
    SearchCache memo;
    const auto found = searchViewpoints({views, *map, sphere, {}}, points, params.viewpoints,
                                        params.seed, JobContext{}, &memo);
    ASSERT_TRUE(found);
    MovedObjects moved;
    moved.add({change.object.id},
              {cornerBox(before, change.object.id), cornerBox(after, change.object.id)});
    const std::size_t kept = memo.forget(moved, MapChange(*map, nullptr, *map_after, nullptr),
                                         params.camera.camera_radius_m);
    EXPECT_GE(2 * kept, found->searches.size()) << "of " << found->searches.size();
    for (const ObservationPoint& point : found->observation_points) {
        const bool own = std::ranges::count(point.objects, change.object.id) > 0;
        EXPECT_TRUE(!own || memo.find(point) == nullptr);
    }
}

}  // namespace dollytrack::planning::moving_test
