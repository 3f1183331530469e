#include "planning/pipeline/pipeline.h"

#include "engine/core/random.h"
#include "engine/document/apply_scene_edits.h"
#include "engine/geometry/ray_caster.h"
#include "engine/jobs/parallel.h"
#include "engine/plan/plan_json.h"
#include "planning/collision/allowed_region.h"
#include "planning/collision/swept_sphere.h"
#include "planning/free_space/free_space.h"
#include "tests/planning/support/plan_support.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <set>

namespace dollytrack::planning::edits_test {
namespace {

using test_support::planOf;

std::string pathOf(const Plan& plan) {
    return trajectoryJson(plan.trajectory).dump();
}

/// All positions that the camera passes, a few millimetres apart, from the curves and the frames.
void visitPlaces(const Plan& plan, const std::function<void(const Eigen::Vector3d&)>& visit) {
    for (const SmoothPath& path : plan.smooth_paths) {
        const int steps = static_cast<int>(path.length_m / 0.003) + 1;
        for (int i = 0; i <= steps; ++i) visit(path.at(path.length_m * i / steps));
    }
    for (const TrajectoryFrame& frame : plan.trajectory.frames) visit(frame.pose.position);
}

/// Distance to an upright box, computed independently: the box as the product of three intervals
/// along its own axes.
double distanceToBox(const OrientedBox& box, const Eigen::Vector3d& point) {
    const double dx = point.x() - box.center.x();
    const double dy = point.y() - box.center.y();
    const double u = std::cos(box.yaw) * dx + std::sin(box.yaw) * dy;
    const double v = -std::sin(box.yaw) * dx + std::cos(box.yaw) * dy;
    const double w = point.z() - box.center.z();
    const auto outside = [](double at, double half) { return std::max(0.0, std::abs(at) - half); };
    return std::hypot(outside(u, box.half_size.x()), outside(v, box.half_size.y()),
                      outside(w, box.half_size.z()));
}

NoGoBox boxAt(const Eigen::Vector3d& center, const Eigen::Vector3d& size, double yaw = 0.0) {
    return {"box", {center, 0.5 * size, yaw}};
}

const PositionPoint* pointFor(const Plan& plan, const std::vector<int>& objects) {
    for (const PositionPoint& point : plan.position_points) {
        const std::size_t o = point.observation_point;
        if (plan.observation_points[o].objects == objects) return &point;
    }
    return nullptr;
}

int idOf(const Scene& scene, const std::string& name) {
    for (const Object& object : scene.objects) {
        if (object.name == name) return object.id;
    }
    return 0;
}

bool has(const std::vector<int>& ids, int id) {
    return std::find(ids.begin(), ids.end(), id) != ids.end();
}

PinnedPoint pinFor(const Scene& scene, const std::string& object, const Eigen::Vector3d& from) {
    const int id = idOf(scene, object);
    return {object, lookAt(from, scene.object(id).box.center), {{id, object}}};
}

bool framesHold(const Plan& plan, const Pose& pose) {
    return std::any_of(plan.trajectory.frames.begin(), plan.trajectory.frames.end(),
                       [&](const TrajectoryFrame& frame) {
                           return frame.pose == pose && frame.position_point >= 0;
                       });
}

}  // namespace

TEST(Edits, NoPartOfTheCameraEntersANoGoBox) {
    const Scene scene = test::furnishedRoom();
    const auto without = planOf(scene);
    PlanEdits edits;
    // One box across the room that can be passed at one end, and a turned one in a corner.
    edits.no_go = {boxAt({2.0, 1.0, 1.3}, {0.4, 2.0, 2.6}),
                   boxAt({3.5, 2.7, 1.8}, {0.8, 0.6, 0.7}, 0.5)};
    const auto nearest = [&](const Plan& plan) {
        double least = 1e9;
        visitPlaces(plan, [&](const Eigen::Vector3d& place) {
            for (const NoGoBox& box : edits.no_go) {
                least = std::min(least, distanceToBox(box.box, place));
            }
        });
        return least;
    };
    EXPECT_LT(nearest(*without), 0.1) << "the boxes are in nobody's way: the test tests nothing";
    for (const PathMode mode : {PathMode::Tour, PathMode::LongestBranch}) {
        PlanParams params;
        params.path.path_mode = mode;
        const auto plan = planOf(scene, edits, params);
        ASSERT_GT(plan->trajectory.frames.size(), 10U);
        EXPECT_GE(nearest(*plan), params.camera.camera_radius_m - 1e-4);
        EXPECT_EQ(plan->smooth_paths.size(), 1U);
        EXPECT_EQ(plan->capture_metrics.captured, 5);
    }
    // The refused edges and candidates state the reason.
    const auto plan = planOf(scene, edits);
    bool said = false;
    for (const ViewpointSearch& search : plan->searches) {
        for (const Candidate& candidate : search.candidates) {
            said |= candidate.verdict == Verdict::NoGo;
            if (candidate.verdict != Verdict::Legal) continue;
            for (const NoGoBox& box : edits.no_go) {
                EXPECT_GE(distanceToBox(box.box, candidate.position), 0.1);
            }
        }
    }
    EXPECT_TRUE(said);
}

TEST(Edits, ANoGoBoxFromWallToWallPartsTheRoom) {
    PlanEdits edits;
    edits.no_go = {boxAt({2.0, 1.5, 1.3}, {0.2, 4.0, 4.0})};
    const auto plan = planOf(test::furnishedRoom(), edits);
    EXPECT_EQ(plan->smooth_paths.size(), 2U);
    visitPlaces(*plan, [&](const Eigen::Vector3d& place) {
        ASSERT_GE(distanceToBox(edits.no_go[0].box, place), 0.1 - 1e-4);
    });
}

// The same result, to the last bit, as testing every box; of several equally near ones, the first.
TEST(Edits, TheNearestOfManyNoGoBoxesIsFoundInTheIndex) {
    Random random(11);
    const auto within = [&](double most) { return random.uniform(-most, most); };
    for (const std::size_t count : {0U, 1U, 5U, 300U}) {
        std::vector<NoGoBox> boxes;
        while (boxes.size() < count) {
            boxes.push_back(boxAt({within(3), within(3), within(2)},
                                  {0.1 + 0.1 * random.uniform(0, 1), 0.3, 0.2}, within(3)));
            if (boxes.size() % 10 == 0) boxes.push_back(boxes.back());
        }
        const NoGoIndex index(boxes);
        for (int i = 0; i < 2000; ++i) {
            const Eigen::Vector3d point(within(4), within(4), within(3));
            const double limit = i % 2 == 0 ? std::numeric_limits<double>::infinity() : 0.3;
            NoGoIndex::Nearest expected{NoGoIndex::kNone, limit};
            for (std::size_t box = 0; box < boxes.size(); ++box) {
                const double distance = boxes[box].box.distance(point);
                if (distance < expected.distance_m) expected = {box, distance};
            }
            const NoGoIndex::Nearest found = index.nearest(point, limit);
            ASSERT_EQ(found.box, expected.box);
            if (found.box == NoGoIndex::kNone) continue;
            ASSERT_EQ(found.distance_m, expected.distance_m);
        }
    }
}

TEST(Edits, ProofsAgainstNoGoBoxesHoldOnEveryCurve) {
    const Scene scene = test::furnishedRoom();
    const RayCaster rays(scene);
    const PlanParams params;
    const auto map = FreeSpace::build(scene, rays, params.camera, params.free_space);
    ASSERT_TRUE(map);
    const std::vector<NoGoBox> boxes = {boxAt({2.0, 1.5, 1.3}, {0.01, 0.5, 0.5}, 0.3),
                                        boxAt({2.6, 0.6, 1.6}, {0.6, 0.3, 0.2}, -0.4)};
    const AllowedRegion region(scene, rays, *map, boxes, params.free_space, params.body, 0.1);
    const SweptSphere with(rays, *map, 0.1, &region);
    const SweptSphere without(rays, *map, 0.1);
    Random random(7);
    const auto& cells = map->cells(0);
    const auto place = [&]() -> Eigen::Vector3d {
        return cells[random.below(static_cast<std::uint32_t>(cells.size()))].cast<double>();
    };
    int refused = 0;
    int accepted = 0;
    for (int i = 0; i < 3000; ++i) {
        const Eigen::Vector3d a = place();
        const Eigen::Vector3d b = place();
        const Eigen::Vector3d c = place();
        double least = 1e9;
        for (int k = 0; k <= 2000; ++k) {
            const double t = k / 2000.0;
            const Eigen::Vector3d p = (1 - t) * (1 - t) * a + 2 * t * (1 - t) * b + t * t * c;
            for (const NoGoBox& box : boxes) least = std::min(least, distanceToBox(box.box, p));
        }
        if (with.bezier(a, b, c).free) {
            ++accepted;
            EXPECT_GE(least, 0.1 - 1e-6);
        } else if (without.bezier(a, b, c).free) {
            // Refused because of the boxes only: then the move comes within the contact distance.
            ++refused;
            EXPECT_LT(least, 0.1 + 0.0015);
            EXPECT_EQ(with.bezier(a, b, c).reason, Verdict::NoGo);
        }
    }
    EXPECT_GT(refused, 100);
    EXPECT_GT(accepted, 100);
}

// One half of the floor lies 0.3 m higher: the band follows.
TEST(Edits, KeepsToTheHeightBandAboveTheFloorBelow) {
    test::SceneBuilder builder;
    builder.room({0, 0, 0}, {6, 3, 2.8});
    builder.object("platform", {kNyuFloor, Role::Structure, {0.6F, 0.6F, 0.6F}})
        .box({4.5, 1.5, 0.15}, {3.0, 3.0, 0.3});
    builder.object("sill", {kNyuWindow, Role::Structure, {0.6F, 0.6F, 0.6F}})
        .box({1.5, 2.8, 0.6}, {2.0, 0.4, 0.05});
    builder.object("crate").box({1.0, 0.6, 0.25}, {0.5, 0.5, 0.5});
    builder.object("trunk").box({5.2, 2.4, 0.55}, {0.5, 0.5, 0.5});
    const Scene scene = builder.build();
    PlanParams params;
    params.free_space.min_height_m = 1.25;
    params.free_space.max_height_m = 1.75;
    const auto plan = planOf(scene, {}, params);
    EXPECT_EQ(plan->capture_metrics.captured, 2);
    EXPECT_EQ(plan->smooth_paths.size(), 1U);  // the path goes from one level to the other
    double least = 1e9;
    double most = 0.0;
    visitPlaces(*plan, [&](const Eigen::Vector3d& place) {
        // Within one cell of the step either floor may count.
        const bool low = place.x() < 3.05;
        const bool high = place.x() > 2.95;
        const double above_low = place.z();
        const double above_high = place.z() - 0.3;
        least = std::min(least, high && !low ? above_high : above_low);
        most = std::max(most, low && !high ? above_low : above_high);
    });
    EXPECT_GE(least, 1.25 - 1e-6);
    EXPECT_LE(most, 1.75 + 1e-6);

    params.free_space.min_height_m = 2.0;
    Pipeline pipeline(std::make_shared<const Scene>(scene));
    const auto empty = pipeline.run(params, JobContext{});
    ASSERT_FALSE(empty);
    EXPECT_EQ(empty.error().code, ErrorCode::Usage);
}

TEST(Edits, ATableIsNoFloor) {
    PlanParams params;
    params.free_space.min_height_m = 1.2;
    params.free_space.max_height_m = 1.4;
    const auto plan = planOf(test::furnishedRoom(), {}, params);
    EXPECT_GT(plan->trajectory.frames.size(), 10U);
    visitPlaces(*plan, [](const Eigen::Vector3d& place) {
        ASSERT_GE(place.z(), 1.2 - 1e-6);
        ASSERT_LE(place.z(), 1.4 + 1e-6);
    });
}

TEST(Edits, APinnedPoseIsKeptToTheLastBitWhateverElseChanges) {
    const Scene scene = test::furnishedRoom();
    PlanEdits edits;
    edits.pinned = {pinFor(scene, "sofa", {2.1, 1.0, 1.3})};
    edits.pinned.push_back({"view", lookAt({1.9, 0.8, 1.1}, {1.7, 2.99, 1.4}), {}});
    for (const PathMode mode : {PathMode::Tour, PathMode::LongestBranch}) {
        for (const double fill : {0.4, 0.6, 0.8}) {
            PlanParams params;
            params.viewpoints.fill = fill;
            params.path.path_mode = mode;
            const auto plan = planOf(scene, edits, params);
            EXPECT_TRUE(plan->refused_pins.empty());
            for (const PinnedPoint& pin : edits.pinned) {
                EXPECT_TRUE(framesHold(*plan, pin.pose)) << pin.name << " at " << fill;
            }
            const PositionPoint* sofa = pointFor(*plan, {idOf(scene, "sofa")});
            ASSERT_NE(sofa, nullptr);
            EXPECT_EQ(sofa->pin, 0);
            EXPECT_EQ(sofa->pose, edits.pinned[0].pose);
            EXPECT_EQ(plan->trajectory_metrics.frame_collision_rate, 0.0);
        }
    }
}

TEST(Edits, AViewAddedByHandStandsForWhatItCaptures) {
    const Scene scene = test::furnishedRoom();
    PlanEdits edits;
    edits.pinned = {{"view", lookAt({1.9, 0.8, 1.4}, {1.8, 2.98, 1.5}), {}},
                    {"wall", lookAt({2.0, 0.5, 2.0}, {2.0, 0.0, 2.0}), {}}};
    const auto plan = planOf(scene, edits);
    ASSERT_TRUE(plan->refused_pins.empty());
    const auto added = [&](int pin) {
        return *std::find_if(plan->position_points.begin(), plan->position_points.end(),
                             [&](const PositionPoint& point) { return point.pin == pin; });
    };
    const auto objects = [&](int pin) {
        return plan->observation_points[added(pin).observation_point].objects;
    };
    EXPECT_EQ(objects(0), std::vector<int>{idOf(scene, "picture")});
    EXPECT_TRUE(objects(1).empty());
    EXPECT_TRUE(framesHold(*plan, edits.pinned[1].pose));
    EXPECT_EQ(plan->capture_metrics.captured, 5);
}

TEST(Edits, UnpinningGoesBackToTheSearchedPlanExactly) {
    const Scene scene = test::furnishedRoom();
    Pipeline pipeline(std::make_shared<const Scene>(scene));
    const auto run = [&](const PlanEdits& edits) { return *pipeline.run({}, edits, JobContext{}); };
    const std::string searched = pathOf(*run({}));
    PlanEdits edits;
    edits.pinned = {pinFor(scene, "sofa", {2.1, 1.0, 1.3})};
    EXPECT_NE(pathOf(*run(edits)), searched);
    EXPECT_EQ(pathOf(*run({})), searched);
    // Locking a point at its position may change the corner there, but never its pose.
    const auto unpinned = run({});
    edits.pinned[0].pose = pointFor(*unpinned, {idOf(scene, "sofa")})->pose;
    const auto locked = run(edits);
    EXPECT_EQ(pointFor(*locked, {idOf(scene, "sofa")})->pose, edits.pinned[0].pose);
    EXPECT_TRUE(framesHold(*locked, edits.pinned[0].pose));
}

TEST(Edits, APinThatIsNotLegalIsRefusedWithItsReason) {
    const Scene scene = test::furnishedRoom();
    PlanEdits edits;
    edits.pinned = {pinFor(scene, "picture", {0.5, 1.5, 0.35}),
                    pinFor(scene, "book", {3.3, 1.7, 6.0}), pinFor(scene, "mug", {1.5, 0.5, 1.0})};
    edits.no_go = {boxAt({1.5, 0.5, 1.0}, {0.5, 0.5, 0.5})};
    edits.no_go[0].name = "plant";
    const auto plan = planOf(scene, edits);
    ASSERT_EQ(plan->refused_pins.size(), 3U);
    EXPECT_EQ(plan->refused_pins[0].verdict, Verdict::InObstacle);
    EXPECT_EQ(plan->refused_pins[0].reason, "inside sofa");
    EXPECT_EQ(plan->refused_pins[0].object_id, idOf(scene, "sofa"));
    EXPECT_EQ(plan->refused_pins[1].verdict, Verdict::OutsideRoom);
    EXPECT_EQ(plan->refused_pins[2].verdict, Verdict::NoGo);
    EXPECT_NE(plan->refused_pins[2].reason.find("plant"), std::string::npos);
    // The view that the search found takes its place, so no capture is lost.
    EXPECT_EQ(plan->capture_metrics.captured, 5);
    EXPECT_EQ(pointFor(*plan, {idOf(scene, "picture")})->pin, -1);

    PlanParams params;
    params.free_space.max_height_m = 1.0;
    edits = {};
    edits.pinned = {pinFor(scene, "picture", {2.0, 1.0, 1.5})};
    const auto low = planOf(scene, edits, params);
    ASSERT_EQ(low->refused_pins.size(), 1U);
    EXPECT_EQ(low->refused_pins[0].verdict, Verdict::HeightBand);
    EXPECT_NE(low->refused_pins[0].reason.find("1.50 m"), std::string::npos)
        << low->refused_pins[0].reason;
}

TEST(Edits, PinsComeFirstInATightBudget) {
    const Scene scene = test::furnishedRoom();
    PlanEdits edits;
    edits.pinned = {pinFor(scene, "sofa", {2.1, 1.0, 1.3}), pinFor(scene, "mug", {2.4, 1.3, 1.2})};
    PlanParams params;
    params.timing.max_frames = 1;
    const auto plan = planOf(scene, edits, params);
    ASSERT_EQ(plan->trajectory.frames.size(), 1U);
    const Pose& visited = plan->trajectory.frames[0].pose;
    EXPECT_TRUE(visited == edits.pinned[0].pose || visited == edits.pinned[1].pose);
    ASSERT_EQ(plan->refused_pins.size(), 1U);
    EXPECT_NE(plan->refused_pins[0].reason.find("max_frames"), std::string::npos);
}

TEST(Edits, ARemovedPointIsNotVisitedAndSaysSo) {
    test::SceneBuilder builder;
    builder.room({0, 0, 0}, {4, 3, 2.6});
    builder.object("crate").box({0.6, 0.6, 0.3}, {0.6, 0.6, 0.6});
    builder.object("trunk").box({3.4, 2.4, 0.3}, {0.6, 0.6, 0.6});
    const Scene scene = builder.build();
    PlanEdits edits;
    edits.removed = {{{{7, "crate"}}}};
    const auto plan = planOf(scene, edits);
    EXPECT_EQ(pointFor(*plan, {7}), nullptr);
    EXPECT_NE(pointFor(*plan, {8}), nullptr);
    ASSERT_EQ(plan->ledger.size(), 2U);
    EXPECT_EQ(plan->ledger[0].loss, Loss::ByHand) << plan->ledger[0].reason;
    EXPECT_TRUE(plan->ledger[1].captured);
}

TEST(Edits, AnExcludedObjectIsNoTargetAndMovesNoOtherPlace) {
    const Scene scene = test::furnishedRoom();
    const int sofa = idOf(scene, "sofa");
    const auto shared = std::make_shared<const Scene>(scene);
    SceneEdits edits;
    ObjectChange change;
    change.object = {sofa, "sofa"};
    change.role = Role::Excluded;
    edits.changes = {change};
    const auto edited = std::make_shared<const Scene>(*applySceneEdits(scene, edits));
    ASSERT_TRUE(sameGeometry({}, edits));

    Pipeline pipeline(shared);
    const auto before = *pipeline.run({}, JobContext{});
    pipeline.setScene(edited, true);
    const auto after = *pipeline.run({}, JobContext{});
    EXPECT_EQ(after->capture_metrics.objects, 4);
    for (const ObservationPoint& point : after->observation_points) {
        EXPECT_FALSE(has(point.objects, sofa));
    }
    for (const PositionPoint& point : after->position_points) {
        if (point.room_view) continue;  // chosen for all objects together
        const std::size_t o = point.observation_point;
        const PositionPoint* same = pointFor(*before, after->observation_points[o].objects);
        ASSERT_NE(same, nullptr);
        EXPECT_EQ(same->pose, point.pose);
    }
    for (const StageTime& stage : after->stages) {
        if (stage.name == "rays" || stage.name == "free_space" || stage.name == "region") {
            EXPECT_TRUE(stage.reused) << stage.name;
        }
    }
    // Reusing the results that still hold gives the same plan as starting from scratch.
    EXPECT_EQ(pathOf(*after), pathOf(*planOf(*edited)));
    pipeline.setScene(shared, true);
    EXPECT_EQ(pathOf(**pipeline.run({}, JobContext{})), pathOf(*before));
}

TEST(Edits, LargeAndSmallDecideHowAnObjectIsSeen) {
    const Scene scene = test::furnishedRoom();
    const auto kindOf = [&](const Scene& of, const std::string& name) {
        const auto plan = planOf(of);
        for (const ObservationPoint& point : plan->observation_points) {
            if (has(point.objects, idOf(of, name))) return point.kind;
        }
        return TargetKind::Shelf;
    };
    ASSERT_EQ(kindOf(scene, "mug"), TargetKind::Support);
    SceneEdits edits;
    ObjectChange change;
    change.object = {idOf(scene, "mug"), "mug"};
    change.large = true;
    edits.changes = {change};
    EXPECT_EQ(kindOf(*applySceneEdits(scene, edits), "mug"), TargetKind::Single);
}

TEST(Edits, AMovedPinRepeatsNoSearchAndNoMap) {
    const Scene scene = test::furnishedRoom();
    Pipeline pipeline(std::make_shared<const Scene>(scene));
    PlanEdits edits;
    edits.pinned = {pinFor(scene, "sofa", {2.1, 1.0, 1.3})};
    ASSERT_TRUE(pipeline.run({}, edits, JobContext{}));
    const auto rerun = [&] {
        std::set<std::string> names;
        const auto plan = pipeline.run({}, edits, JobContext{});
        for (const StageTime& stage : (*plan)->stages) {
            if (!stage.reused) names.insert(stage.name);
        }
        return names;
    };
    EXPECT_TRUE(rerun().empty());
    edits.pinned[0].pose.position.x() += 0.05;
    const auto moved = rerun();
    EXPECT_TRUE(moved.contains("by_hand"));
    for (const char* kept : {"rays", "free_space", "region", "views", "targets", "viewpoints"}) {
        EXPECT_FALSE(moved.contains(kept)) << kept;
    }
    edits.no_go = {boxAt({1.5, 0.5, 1.0}, {0.5, 0.5, 0.5})};
    const auto boxed = rerun();
    EXPECT_TRUE(boxed.contains("region"));
    EXPECT_TRUE(boxed.contains("viewpoints"));
    EXPECT_FALSE(boxed.contains("free_space"));
}

TEST(Edits, SamePlanWhateverTheThreads) {
    const Scene scene = test::twoRoomsWithDoor(0.8);
    PlanEdits edits;
    edits.no_go = {boxAt({1.8, 1.5, 1.2}, {0.3, 1.2, 2.4}, 0.2)};
    edits.pinned = {{"view", lookAt({4.0, 1.0, 1.2}, {5.2, 2.4, 0.3}), {}}};
    PlanParams params;
    params.free_space.min_height_m = 0.5;
    params.free_space.max_height_m = 1.6;
    const auto text = [&](int threads) {
        setThreadCount(threads);
        std::string dump = pathOf(*planOf(scene, edits, params));
        setThreadCount(0);
        return dump;
    };
    EXPECT_EQ(text(1), text(3));
}

}  // namespace dollytrack::planning::edits_test
