#include "engine/jobs/parallel.h"
#include "planning/pipeline/pipeline.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace dollytrack::planning::algorithm_steps_test {
namespace {

using Kind = AlgorithmStep::Kind;

/// Two rooms with a door, so that straight moves are refused and links are needed.
std::shared_ptr<const Plan> planRooms(PathMode mode = PathMode::Tour) {
    Pipeline pipeline(std::make_shared<const Scene>(test::twoRoomsWithDoor(0.7)));
    PlanParams params;
    params.path.path_mode = mode;
    return *pipeline.run(params, JobContext{});
}

std::pair<int, int> ends(int a, int b) {
    return std::minmax(a, b);
}

TEST(AlgorithmSteps, LeadToTheRoadmap) {
    for (const Scene& scene : {test::furnishedRoom(), test::twoRoomsWithDoor(0.7)}) {
        Pipeline pipeline(std::make_shared<const Scene>(scene));
        const auto plan = *pipeline.run(PlanParams{}, JobContext{});
        const Roadmap& roadmap = plan->roadmap;
        std::vector<std::pair<int, int>> edges;
        std::vector<std::pair<int, int>> refused;
        std::vector<int> sampled;
        std::set<int> pruned;
        std::size_t samples = 0;
        for (const AlgorithmStep& step : roadmap.steps.steps) {
            if (step.kind == Kind::Sample) sampled.push_back(step.a);
            if (step.kind == Kind::Accepted || step.kind == Kind::LinkFound) {
                EXPECT_EQ(step.index, static_cast<int>(edges.size()));
                edges.push_back(ends(step.a, step.b));
            }
            if (step.kind == Kind::Refused) {
                EXPECT_EQ(step.index, static_cast<int>(refused.size()));
                refused.push_back(ends(step.a, step.b));
            }
            if (step.kind == Kind::LinkSample) {
                EXPECT_EQ(step.index, static_cast<int>(samples++));
                EXPECT_LT(step.parent, step.index);
            }
            if (step.kind == Kind::Prune) {
                EXPECT_TRUE(pruned.insert(step.index).second);
            }
        }
        std::sort(sampled.begin(), sampled.end());
        std::vector<int> keys = plan->key_frames;
        std::sort(keys.begin(), keys.end());
        EXPECT_EQ(sampled, keys);
        ASSERT_EQ(edges.size(), roadmap.edges.size());
        for (std::size_t i = 0; i < edges.size(); ++i) {
            EXPECT_EQ(edges[i], ends(roadmap.edges[i].a, roadmap.edges[i].b));
            EXPECT_EQ(pruned.contains(static_cast<int>(i)), !roadmap.edges[i].in_tree);
        }
        ASSERT_EQ(refused.size(), roadmap.refused.size());
        EXPECT_EQ(samples, roadmap.samples.size());
        EXPECT_EQ(roadmap.sample_parents.size(), roadmap.samples.size());
        EXPECT_EQ(roadmap.steps.left_out, 0U);
    }
}

TEST(AlgorithmSteps, NearTakesTheLeastCostAndItsTermsAreThePapers) {
    const auto plan = planRooms();
    const RoadmapParams weights;
    float last_cost = 0.0F;
    int nears = 0;
    for (const AlgorithmStep& step : plan->roadmap.steps.steps) {
        if (step.kind == Kind::Sample) last_cost = 0.0F;
        if (step.kind != Kind::Near) continue;
        ++nears;
        const Pose& a = plan->position_points[step.a].pose;
        const Pose& b = plan->position_points[step.b].pose;
        EXPECT_NEAR(step.distance_cost, weights.distance_weight * (a.position - b.position).norm(),
                    1e-5);
        EXPECT_NEAR(step.turn_cost, angleBetween(a.forward(), b.forward()), 1e-5);
        // Room views are not of an object, so that they have no size.
        EXPECT_EQ(step.size_cost == 0.0F, plan->position_points[step.b].room_view);
        // Within one sample each vertex costs at least as much as the one before it.
        EXPECT_GE(step.cost(), last_cost - 1e-5F);
        last_cost = step.cost();
    }
    EXPECT_GT(nears, 0);
}

TEST(AlgorithmSteps, VisitsFollowThePaths) {
    for (const PathMode mode : {PathMode::Tour, PathMode::LongestBranch}) {
        const auto plan = planRooms(mode);
        std::vector<int> visited;
        for (const AlgorithmStep& step : plan->roadmap.steps.steps) {
            if (step.kind == Kind::Visit) visited.push_back(step.a);
        }
        std::vector<int> expected;
        for (const CameraPath& path : plan->paths) {
            for (const PathVertex& vertex : path.vertices) {
                if (vertex.position_point >= 0) expected.push_back(vertex.position_point);
            }
        }
        EXPECT_EQ(visited, expected);
    }
}

TEST(AlgorithmSteps, AreTheSameWithAnyNumberOfThreads) {
    const auto key = [](const AlgorithmStep& s) {
        return std::tuple(s.kind, s.a, s.b, s.index, s.parent, s.point.x(), s.point.y(),
                          s.distance_cost, s.size_cost, s.turn_cost);
    };
    setThreadCount(1);
    const auto one = planRooms();
    setThreadCount(0);
    const auto many = planRooms();
    ASSERT_EQ(one->roadmap.steps.steps.size(), many->roadmap.steps.steps.size());
    for (std::size_t i = 0; i < one->roadmap.steps.steps.size(); ++i) {
        EXPECT_EQ(key(one->roadmap.steps.steps[i]), key(many->roadmap.steps.steps[i])) << i;
    }
}

TEST(AlgorithmSteps, AreCountedBeyondTheirLimit) {
    AlgorithmSteps steps;
    for (std::size_t i = 0; i < AlgorithmSteps::kLimit + 7; ++i) steps.add({});
    EXPECT_EQ(steps.steps.size(), AlgorithmSteps::kLimit);
    EXPECT_EQ(steps.left_out, 7U);
}

TEST(Pipeline, FrameViewsAndSeriesAgreeWithTheCaptures) {
    Pipeline pipeline(std::make_shared<const Scene>(test::furnishedRoom()));
    const auto plan = *pipeline.run(PlanParams{}, JobContext{});
    const std::size_t frames = plan->trajectory.frames.size();
    ASSERT_EQ(plan->frame_views.size(), frames);
    ASSERT_EQ(plan->series.size(), frames);
    EXPECT_EQ(plan->series.captured_so_far.back(), plan->capture_metrics.captured);
    for (const ObjectCapture& capture : plan->captures) {
        if (capture.best.frame < 0) continue;
        const auto& views = plan->frame_views[capture.best.frame];
        const auto found = std::find_if(views.begin(), views.end(), [&](const ObjectView& view) {
            return view.object_id == capture.object_id;
        });
        ASSERT_NE(found, views.end());
        EXPECT_EQ(found->visible_fraction, capture.best.visible_fraction);
    }
    const double least =
        *std::min_element(plan->series.clearance_m.begin(), plan->series.clearance_m.end());
    EXPECT_GE(least, PlanParams{}.camera.camera_radius_m - 1e-4);
    EXPECT_GE(least, plan->trajectory_metrics.minimum_clearance.clearance_m - 1e-4);
}

}  // namespace
}  // namespace dollytrack::planning::algorithm_steps_test
