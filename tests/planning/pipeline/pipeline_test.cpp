#include "planning/pipeline/pipeline.h"

#include "engine/geometry/ray_caster.h"
#include "engine/io/files/text_file.h"
#include "engine/io/settings/project_file.h"
#include "engine/io/settings/stored_plan.h"
#include "engine/jobs/parallel.h"
#include "engine/plan/plan_json.h"
#include "tests/planning/support/plan_support.h"
#include "tests/support/scene_builder.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

namespace dollytrack::planning::pipeline_test {
namespace {

using test_support::planOf;

/// Smallest distance from a densely sampled trajectory to any surface, computed independently of
/// the planner.
double smallestDistance(const Scene& scene, const Plan& plan) {
    const RayCaster rays(scene);
    double smallest = 1e9;
    for (const SmoothPath& path : plan.smooth_paths) {
        const int steps = static_cast<int>(path.length_m / 0.002) + 1;
        for (int i = 0; i <= steps; ++i) {
            smallest =
                std::min(smallest, rays.closest(path.at(path.length_m * i / steps)).distance);
        }
    }
    for (const TrajectoryFrame& frame : plan.trajectory.frames) {
        smallest = std::min(smallest, rays.closest(frame.pose.position).distance);
    }
    return smallest;
}

}  // namespace

TEST(Pipeline, CapturesEverythingInASimpleRoom) {
    const Scene scene = test::furnishedRoom();
    const auto plan = planOf(scene);
    EXPECT_EQ(plan->capture_metrics.objects, 5);
    EXPECT_EQ(plan->capture_metrics.captured, 5);
    EXPECT_EQ(plan->capture_metrics.well_captured, 5);
    EXPECT_TRUE(std::ranges::all_of(plan->ledger, &LedgerRow::captured));
}

TEST(Pipeline, NeverComesCloserThanTheCameraRadius) {
    for (const double radius : {0.07, 0.1, 0.2}) {
        PlanParams params;
        params.camera.camera_radius_m = radius;
        const Scene scene = test::twoRoomsWithDoor(0.7);
        const auto plan = planOf(scene, params);
        ASSERT_GT(plan->trajectory.frames.size(), 2U);
        EXPECT_GE(smallestDistance(scene, *plan), radius - 1e-4) << radius;
        EXPECT_EQ(plan->trajectory_metrics.corner_collision_rate, 0.0);
        EXPECT_EQ(plan->trajectory_metrics.frame_collision_rate, 0.0);
    }
}

TEST(Pipeline, GoesThroughAnOpenDoorAndPlansEachSideOfAClosedOne) {
    const auto open = planOf(test::twoRoomsWithDoor(0.7));
    EXPECT_EQ(open->smooth_paths.size(), 1U);
    EXPECT_EQ(open->capture_metrics.captured, 2);

    const auto closed = planOf(test::twoRoomsWithDoor(0.0));
    EXPECT_EQ(closed->smooth_paths.size(), 2U);
    EXPECT_EQ(closed->capture_metrics.captured, 2);
    std::set<int> components;
    for (const TrajectoryFrame& frame : closed->trajectory.frames) {
        components.insert(frame.component);
    }
    EXPECT_EQ(components.size(), 2U);
}

TEST(Pipeline, KeepsTheLimitsOfSpeedAndTurning) {
    PlanParams params;
    params.timing.max_speed_mps = 0.4;
    params.timing.max_turn_dps = 30.0;
    const auto plan = planOf(test::furnishedRoom(), params);
    const auto& frames = plan->trajectory.frames;
    ASSERT_GT(frames.size(), 10U);
    const double interval = plan->trajectory.frame_interval_s;
    EXPECT_DOUBLE_EQ(interval, 0.1);
    for (std::size_t i = 1; i < frames.size(); ++i) {
        EXPECT_NEAR(frames[i].time_s - frames[i - 1].time_s, interval, 1e-9);
        if (frames[i].path != frames[i - 1].path) continue;
        const double step = (frames[i].pose.position - frames[i - 1].pose.position).norm();
        EXPECT_LE(step, 0.4 * interval * 1.001);
        const double turn = angleBetween(frames[i].pose.rotation, frames[i - 1].pose.rotation);
        EXPECT_LE(turn, 30.0 * std::numbers::pi / 180.0 * interval * 1.02);
        // Roll 0: the camera's x axis stays level.
        EXPECT_NEAR((frames[i].pose.rotation * Eigen::Vector3d::UnitX()).z(), 0.0, 1e-6);
    }
}

TEST(Pipeline, AFrameBudgetKeepsEveryKeyFrame) {
    const Scene scene = test::furnishedRoom();
    const auto free = planOf(scene);
    PlanParams params;
    params.timing.max_frames = 12;
    const auto tight = planOf(scene, params);
    EXPECT_LE(tight->trajectory.frames.size(), 12U);
    EXPECT_LT(tight->trajectory.frames.size(), free->trajectory.frames.size());
    EXPECT_EQ(tight->capture_metrics.well_captured, free->capture_metrics.well_captured);
    std::set<int> keys;
    for (const TrajectoryFrame& frame : tight->trajectory.frames) {
        if (frame.position_point >= 0) keys.insert(frame.position_point);
    }
    EXPECT_EQ(keys.size(), tight->key_frames.size());

    params.timing.max_frames = 2;
    const auto two = planOf(scene, params);
    EXPECT_LE(two->trajectory.frames.size(), 2U);
    EXPECT_FALSE(std::ranges::all_of(two->ledger, &LedgerRow::captured));
}

TEST(Pipeline, SameSeedSamePlanWhateverTheThreads) {
    const Scene scene = test::twoRoomsWithDoor(0.8);
    const auto text = [&](int threads, int seed) {
        setThreadCount(threads);
        PlanParams params;
        params.seed = seed;
        const std::string dump = trajectoryJson(planOf(scene, params)->trajectory).dump();
        setThreadCount(0);
        return dump;
    };
    const std::string one = text(1, 3);
    EXPECT_EQ(one, text(2, 3));
    EXPECT_EQ(one, text(4, 3));
}

TEST(Pipeline, RepeatsOnlyWhatDependsOnAChange) {
    Pipeline pipeline(std::make_shared<const Scene>(test::furnishedRoom()));
    PlanParams params;
    params.gaze.view_mix = 0.0;  // room views depend on the path's mode
    ASSERT_TRUE(pipeline.run(params, JobContext{}));
    const auto rerun = [&] {
        std::set<std::string> names;
        const auto plan = pipeline.run(params, JobContext{});
        for (const StageTime& stage : (*plan)->stages) {
            if (!stage.reused) names.insert(stage.name);
        }
        return names;
    };
    EXPECT_TRUE(rerun().empty());
    params.timing.max_speed_mps = 1.0;
    EXPECT_EQ(rerun(), (std::set<std::string>{"timing", "repair", "metrics"}));
    params.smoothing.corner_distance_m = 0.2;
    EXPECT_EQ(rerun(), (std::set<std::string>{"smoothing", "gaze", "timing", "repair", "metrics"}));
    params.path.path_mode = PathMode::LongestBranch;
    EXPECT_EQ(rerun(),
              (std::set<std::string>{"path", "smoothing", "gaze", "timing", "repair", "metrics"}));
    params.viewpoints.fill = 0.4;
    EXPECT_FALSE(rerun().contains("free_space"));
    params.free_space.octree_resolution_m = 0.1;
    EXPECT_TRUE(rerun().contains("viewpoints"));
    // The result equals that of planning from scratch.
    const auto reused = pipeline.run(params, JobContext{});
    const auto fresh = planOf(test::furnishedRoom(), params);
    EXPECT_EQ(trajectoryJson((*reused)->trajectory).dump(),
              trajectoryJson(fresh->trajectory).dump());
}

TEST(Pipeline, RefusesACameraWhoseNearPlaneLeavesItsSphere) {
    PlanParams params;
    params.camera.near_m = 0.5;
    Pipeline pipeline(std::make_shared<const Scene>(test::furnishedRoom()));
    const auto result = pipeline.run(params, JobContext{});
    ASSERT_FALSE(result.has_value());
    EXPECT_EQ(result.error().code, ErrorCode::Usage);
    EXPECT_EQ(result.error().where, "near_m, hfov_deg");
}

TEST(Pipeline, RefusesMoreFramesThanAnyoneWants) {
    PlanParams params;
    params.timing.frame_rate = 1000.0;
    params.timing.max_turn_dps = 0.1;
    Pipeline pipeline(std::make_shared<const Scene>(test::furnishedRoom()));
    const auto result = pipeline.run(params, JobContext{});
    ASSERT_FALSE(result.has_value());
    EXPECT_EQ(result.error().where, "frame_rate");
}

TEST(Pipeline, CancelsAtOnceAndSaysSo) {
    auto flag = std::make_shared<std::atomic<bool>>(true);
    Pipeline pipeline(std::make_shared<const Scene>(test::furnishedRoom()));
    const auto result = pipeline.run({}, JobContext(flag, {}));
    ASSERT_FALSE(result.has_value());
    EXPECT_EQ(result.error().code, ErrorCode::Cancelled);
    *flag = false;
    EXPECT_TRUE(pipeline.run({}, JobContext(flag, {})).has_value());
}

TEST(Pipeline, ARoomWithoutTargetsGivesAnEmptyTrajectory) {
    test::SceneBuilder builder;
    builder.room({0, 0, 0}, {4, 3, 2.6});
    const auto plan = planOf(builder.build());
    EXPECT_TRUE(plan->trajectory.frames.empty());
    EXPECT_EQ(plan->capture_metrics.objects, 0);
}

/// A plan with a value in every field that is stored.
nlohmann::json resultWithEveryField() {
    const Scene scene = test::twoRoomsWithDoor(0.9);
    PlanParams params;
    params.constraints.rooms = RoomTours::Each;
    Plan plan = *planOf(scene, params);
    plan.must_see = {{"altar", 10, 8, 7}};
    plan.anchors = {{"doorways", 2, 1}};
    plan.refused_pins = {{0, "view", Verdict::InObstacle, 1, "it is in a wall"}};
    plan.position_points.at(0).pin = 0;
    for (const bool captured : {true, false}) {
        LedgerRow row = plan.ledger.at(0);
        row.captured = captured;
        row.well_captured = false;
        row.loss = Loss::Occluded;
        row.reason = "something hides it";
        row.occluder = row.object_id;
        row.remedy =
            Remedy{{"hfov_deg=38"}, Pose{}, "box", {{row.object_id}}, "view", 0, true, "do"};
        plan.ledger.push_back(row);
    }
    nlohmann::json result = resultJson(scene, plan);
    addBound(result["metrics"], {1.0, 1.0, {}, {}}, 1.0);
    result["metrics"] = withoutTimes(result["metrics"]);
    return result;
}

// This test finds a field that was added to stored plans but not to their schema, where nothing
// would check it.
TEST(StoredPlan, EveryFieldIsCheckedAndNamed) {
    const nlohmann::json result = resultWithEveryField();
    const Status sound = checkStoredPlan(result, "result");
    ASSERT_TRUE(sound) << describe(sound.error());
    const nlohmann::json flat = result.flatten();
    int fields = 0;
    std::set<std::string> seen;
    for (const auto& [path, value] : flat.items()) {
        // One entry stands for all entries of a list. The values below operations are skipped,
        // since each kind of operation has its own.
        std::string kind;
        for (std::size_t at = 0; at < path.size();) {
            const std::size_t end = std::min(path.find('/', at + 1), path.size());
            const std::string part = path.substr(at, end - at);
            kind += part.find_first_not_of("/0123456789") == std::string::npos ? "/0" : part;
            at = end;
        }
        if (!seen.insert(kind).second || kind.find("/operations/") != std::string::npos) continue;
        ++fields;
        for (const nlohmann::json& wrong :
             {nlohmann::json::array({nlohmann::json::object()}), nlohmann::json("wrong"),
              nlohmann::json({{"a", 1}}), nlohmann::json(true)}) {
            if (wrong.type() == value.type()) continue;
            nlohmann::json damaged = result;
            damaged[nlohmann::json::json_pointer(path)] = wrong;
            const Status status = checkStoredPlan(damaged, "result");
            ASSERT_FALSE(status) << path << " = " << wrong;
            EXPECT_EQ(status.error().code, ErrorCode::BadInput);
            EXPECT_TRUE(status.error().where.starts_with("result.")) << status.error().where;
        }
    }
    EXPECT_GT(fields, 100);
}

TEST(StoredPlan, ListsAndObjectsCannotStandForEachOther) {
    const nlohmann::json result = resultWithEveryField();
    ASSERT_TRUE(checkStoredPlan(result, "result"));
    for (const char* path : {"/metrics", "/metrics/ledger", "/metrics/ledger/0", "/metrics/rooms/0",
                             "/metrics/repair/after", "/metrics/min_clearance_at", "/trajectory",
                             "/trajectory/frames", "/trajectory/frames/0/position", "/rooms",
                             "/rooms/0/low", "/position_points/0", "/key_frames", "/paths/0"}) {
        for (const nlohmann::json& wrong :
             {nlohmann::json(), nlohmann::json(1), nlohmann::json("a"), nlohmann::json::array({1}),
              nlohmann::json({{"a", 1}})}) {
            nlohmann::json damaged = result;
            nlohmann::json& at = damaged[nlohmann::json::json_pointer(path)];
            const bool key_frames = std::string(path) == "/key_frames" && wrong.is_array();
            const bool metrics = std::string(path) == "/metrics" && wrong.is_object();
            if (key_frames || metrics) continue;  // these match the schema
            at = wrong;
            EXPECT_FALSE(checkStoredPlan(damaged, "result")) << path << " = " << wrong;
        }
    }
}

TEST(StoredPlan, AProjectIsNotReplacedByOneThatCannotBeRead) {
    const test::TempFolder folder;
    ProjectFile project;
    project.scene = folder.write("room.obj", "");
    project.result = resultWithEveryField();
    const auto path = folder.path() / "room.dolly";
    ASSERT_TRUE(saveProject(project, path));
    const std::string before = readText(path).value();
    project.result["observation_points"][0]["position"][2] = -7.6e8;
    const Status saved = saveProject(project, path);
    ASSERT_FALSE(saved);
    EXPECT_EQ(saved.error().code, ErrorCode::CannotWrite);
    EXPECT_EQ(saved.error().where, "result.observation_points[0].position[2]");
    EXPECT_EQ(readText(path).value(), before);
    EXPECT_TRUE(loadProject(path));
}

TEST(StoredPlan, RatesLieBetweenZeroAndOne) {
    nlohmann::json result = resultWithEveryField();
    for (const char* name : {"capture_rate", "repeat_rate", "trackable_rate"}) {
        for (const double wrong : {-5.0, 1.01, 1e308}) {
            nlohmann::json damaged = result;
            damaged["metrics"][name] = wrong;
            const Status status = checkStoredPlan(damaged, "result");
            ASSERT_FALSE(status) << name << " = " << wrong;
            EXPECT_EQ(status.error().where, std::string("result.metrics.") + name);
        }
    }
}

}  // namespace dollytrack::planning::pipeline_test
