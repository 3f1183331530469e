#include "tests/ui/overlays/planned_room.h"
#include "ui/overlays/candidates_overlay.h"
#include "ui/overlays/grid_overlay.h"
#include "ui/overlays/palette.h"
#include "ui/overlays/pick_tag.h"
#include "ui/overlays/points_overlay.h"
#include "ui/overlays/roadmap_overlay.h"
#include "ui/overlays/surface_overlay.h"
#include "ui/overlays/trajectory_overlay.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace dollytrack::ui::plan_layers_test {
namespace {

const fixture::PlannedRoom& furnished() {
    static const fixture::PlannedRoom room = fixture::planRoom(dollytrack::test::furnishedRoom());
    return room;
}

int countOf(const Legend& legend, const std::string& name) {
    for (const LegendEntry& entry : legend.entries) {
        if (entry.name == name) return entry.count;
    }
    return -1;
}

/// The different indices that elements of one kind carry.
std::set<int> tagged(const render::Overlay& overlay, Picked kind) {
    std::set<int> indices;
    const auto take = [&](std::int32_t tag) {
        if (fromTag(tag).kind == kind) indices.insert(fromTag(tag).index);
    };
    for (const auto& line : overlay.lines) take(line.tag);
    for (const auto& mark : overlay.marks) take(mark.tag);
    return indices;
}

/// One observation point at the origin that faces along x, with a candidate 2 m in front of it.
Plan oneSearch() {
    Plan plan;
    plan.observation_points.resize(1);
    plan.observation_points[0].direction = {1, 0, 0};
    plan.searches.resize(1);
    plan.searches[0].candidates.resize(1);
    plan.searches[0].candidates[0].position = {2, 0, 0};
    return plan;
}

TEST(PlanLayers, CollidingSegmentsOfAGivenMotionAreRed) {
    Plan plan;
    plan.smooth_paths.resize(1);
    for (int i = 0; i < 3; ++i) {
        const Eigen::Vector3d from(i, 0, 0);
        const Eigen::Vector3d to(i + 1, 0, 0);
        plan.smooth_paths[0].append(from, 0.5 * (from + to), to, false);
    }
    const auto red = [&] {
        return std::ranges::count(trajectoryLayer(plan, {}).overlay.lines, kRefusedColor,
                                  &render::OverlayLine::rgba);
    };
    EXPECT_EQ(red(), 0);
    EXPECT_EQ(countOf(trajectoryLayer(plan, {}).legend, "Colliding segment"), -1);
    plan.smooth_paths[0].pieces[1].collides = true;
    EXPECT_EQ(red(), 1);
    const PlanLayer layer = trajectoryLayer(plan, {});
    EXPECT_EQ(countOf(layer.legend, "Colliding segment"), 1);
    const auto line =
        std::ranges::find(layer.overlay.lines, kRefusedColor, &render::OverlayLine::rgba);
    ASSERT_NE(line, layer.overlay.lines.end());
    EXPECT_EQ(line->a.x(), 1.0);
    EXPECT_EQ(line->b.x(), 2.0);
}

TEST(PlanLayers, OnlyThePointsOfSomeObjectsAreShown) {
    const fixture::PlannedRoom& room = furnished();
    const Plan& plan = *room.plan;
    PointsOverlayOptions options;
    options.objects = {plan.observation_points[0].objects.front()};
    const PlanLayer layer = pointsLayer(*room.scene, plan, room.params.camera, options);
    EXPECT_EQ(tagged(layer.overlay, Picked::ObservationPoint), std::set<int>{0});
    std::set<int> positions;
    for (std::size_t i = 0; i < plan.position_points.size(); ++i) {
        if (plan.position_points[i].observation_point == 0) positions.insert(static_cast<int>(i));
    }
    EXPECT_FALSE(positions.empty());
    EXPECT_EQ(tagged(layer.overlay, Picked::PositionPoint), positions);
}

TEST(PlanLayers, TheConeIsNotFilledForAnEyeInIt) {
    const Plan plan = oneSearch();
    CandidatesOverlayOptions options;
    options.observation_point = 0;
    options.cone_half_angle_deg = 40.0;
    EXPECT_TRUE(isInCone(plan, options, {1, 0, 0}));
    EXPECT_TRUE(isInCone(plan, options, {1, 0.8, 0})) << "atan(0.8) is 38.7 degrees";
    EXPECT_TRUE(isInCone(plan, options, {3, 0, 0})) << "before its mouth";
    EXPECT_FALSE(isInCone(plan, options, {1, 1.2, 0})) << "beside it";
    EXPECT_FALSE(isInCone(plan, options, {-1, 0, 0})) << "behind it";
    EXPECT_FALSE(isInCone(plan, options, {9, 0, 0})) << "far away";
    options.observation_point = -1;
    EXPECT_FALSE(isInCone(plan, options, {1, 0, 0}));
    options.observation_point = 0;
    const PlanLayer filled = candidatesLayer(plan, options);
    EXPECT_FALSE(filled.overlay.triangles.empty());
    options.cone_filled = false;
    const PlanLayer edges = candidatesLayer(plan, options);
    EXPECT_TRUE(edges.overlay.triangles.empty());
    EXPECT_EQ(edges.overlay.lines.size(), filled.overlay.lines.size());
}

TEST(PlanLayers, TheGridReachesBesideTheRoomOnWholeMetres) {
    const Eigen::AlignedBox3d room(Eigen::Vector3d(-1.3, 0.2, 0.1), Eigen::Vector3d(3.7, 2.9, 2.6));
    const PlanLayer layer = gridLayer(room, 0.15);
    Eigen::AlignedBox3d reach;
    for (const render::OverlayLine& line : layer.overlay.lines) {
        reach.extend(line.a);
        reach.extend(line.b);
        const Eigen::Vector3d way = line.b - line.a;
        ASSERT_TRUE((way.x() == 0.0) != (way.y() == 0.0));
        const double at = way.x() == 0.0 ? line.a.x() : line.a.y();
        EXPECT_EQ(at, std::round(at));
    }
    EXPECT_EQ(reach.min(), Eigen::Vector3d(-4, -2, 0.15));
    EXPECT_EQ(reach.max(), Eigen::Vector3d(6, 5, 0.15));
    EXPECT_EQ(layer.overlay.lines.size(), 11U + 8U);
    EXPECT_EQ(countOf(layer.legend, "squares of 1 m"), 70);
}

TEST(PlanLayers, TheGridOfAHugeSceneHasLargerSquares) {
    const Eigen::AlignedBox3d town(Eigen::Vector3d(-900, 0, 0), Eigen::Vector3d(900, 50, 30));
    const PlanLayer layer = gridLayer(town, 0.0);
    EXPECT_LT(layer.overlay.lines.size(), 300U);
    EXPECT_GT(countOf(layer.legend, "squares of 10 m"), 0);
    EXPECT_TRUE(gridLayer({}, 0.0).overlay.lines.empty());
}

/// A plan made by hand: four key frames in a row, 1 m apart, and one of each kind of edge.
Plan smallPlan() {
    Plan plan;
    plan.observation_points.resize(1);
    plan.observation_points[0].objects = {1};
    for (int i = 0; i < 5; ++i) {
        PositionPoint point;
        point.pose = lookAt({double(i), 0, 1}, {double(i), 1, 1});
        point.component = i < 3 ? 0 : 1;
        plan.position_points.push_back(point);
        plan.key_frames.push_back(i);
    }
    plan.roadmap.edges = {{0, 1, {}, 1.0, true, false},
                          {1, 2, {}, 1.0, false, false},
                          {2, 3, {{2.5, 1, 1}, {2.7, 1, 1}}, 2.0, true, true},
                          {3, 4, {}, 1.0, true, false}};
    plan.roadmap.refused = {{0, 4, {1.5, 0, 1}, 7}, {1, 3, {2.0, 0, 1}, 0}};
    plan.roadmap.samples = {{2.4, 1, 1}, {2.5, 1, 1}, {2.7, 1, 1}};
    plan.paths = {{0, 0, {{{0, 0, 1}, 0}, {{1, 0, 1}, 1}, {{2, 0, 1}, 2}}}};
    return plan;
}

TEST(PointsLayer, HasEveryPointOnceInTheLegend) {
    const auto& room = furnished();
    const PlanLayer layer = pointsLayer(*room.scene, *room.plan, room.params.camera, {});
    const auto observation = tagged(layer.overlay, Picked::ObservationPoint);
    EXPECT_EQ(observation.size(), room.plan->observation_points.size());
    EXPECT_EQ(countOf(layer.legend, "Observation point, large") +
                  countOf(layer.legend, "Observation point, small"),
              static_cast<int>(observation.size()));
    EXPECT_EQ(countOf(layer.legend, "Key frame"), static_cast<int>(room.plan->key_frames.size()));
    EXPECT_EQ(tagged(layer.overlay, Picked::PositionPoint).size(),
              room.plan->position_points.size());
}

TEST(PointsLayer, ArrowsPointWhereTheCameraLooks) {
    const auto& room = furnished();
    const PlanLayer layer = pointsLayer(*room.scene, *room.plan, room.params.camera, {});
    int arrows = 0;
    for (const render::OverlayMark& mark : layer.overlay.marks) {
        if (mark.shape != render::OverlayMark::Shape::Arrow) continue;
        ++arrows;
        const auto& point = room.plan->position_points[fromTag(mark.tag).index];
        const auto& target = room.plan->observation_points[point.observation_point];
        EXPECT_NEAR(angleBetween(mark.direction, target.position - point.pose.position), 0.0, 0.35);
        EXPECT_NEAR(angleBetween(mark.direction, mark.at - point.pose.position), 0.0, 1e-6);
    }
    EXPECT_EQ(arrows, static_cast<int>(room.plan->position_points.size()));
}

TEST(PointsLayer, RingsWhatHasNoViewAndWhatIsSelected) {
    const auto& room = furnished();
    Plan plan = *room.plan;
    plan.searches[0].position_point = -1;
    PointsOverlayOptions options;
    options.selected_position_point = 1;
    const PlanLayer layer = pointsLayer(*room.scene, plan, room.params.camera, options);
    EXPECT_EQ(countOf(layer.legend, "without a position point"), 1);
    EXPECT_EQ(countOf(layer.legend, "Selected"), 1);
    std::multiset<std::pair<Picked, int>> rings;
    for (const render::OverlayMark& mark : layer.overlay.marks) {
        if (mark.shape != render::OverlayMark::Shape::Ring) continue;
        rings.emplace(fromTag(mark.tag).kind, fromTag(mark.tag).index);
    }
    const std::multiset<std::pair<Picked, int>> expected = {{Picked::ObservationPoint, 0},
                                                            {Picked::PositionPoint, 1}};
    EXPECT_EQ(rings, expected);
}

TEST(RoadmapLayer, DrawsEachKindOfEdgeAsItIs) {
    const Plan plan = smallPlan();
    const PlanLayer layer = roadmapLayer(plan, {});
    // Before linking 0-1-2 were one part (the dropped edge joined them, too) and 3-4 another.
    EXPECT_EQ(countOf(layer.legend, "Accepted, part 1"), 1);
    EXPECT_EQ(countOf(layer.legend, "Accepted, part 2"), 1);
    EXPECT_EQ(countOf(layer.legend, "Link by RRT*"), 1);
    EXPECT_EQ(countOf(layer.legend, "Dropped: closes a cycle"), 1);
    EXPECT_EQ(countOf(layer.legend, "Colliding edge, with the point of collision"), 2);
    EXPECT_EQ(countOf(layer.legend, "RRT* sample"), 3);
    std::map<int, int> lines_of_edge;
    for (const render::OverlayLine& line : layer.overlay.lines) {
        if (fromTag(line.tag).kind != Picked::Edge) continue;
        ++lines_of_edge[fromTag(line.tag).index];
        EXPECT_EQ(line.dash_px > 0.0, fromTag(line.tag).index == 1);
    }
    EXPECT_EQ(lines_of_edge, (std::map<int, int>{{0, 1}, {1, 1}, {2, 3}, {3, 1}}));
    int crosses = 0;
    for (const render::OverlayMark& mark : layer.overlay.marks) {
        if (fromTag(mark.tag).kind != Picked::RefusedEdge) continue;
        ++crosses;
        const auto& edge = plan.roadmap.refused[fromTag(mark.tag).index];
        EXPECT_EQ(mark.at, edge.collision);
    }
    EXPECT_EQ(crosses, 2);
    // The path is drawn on top, so its lines come last.
    EXPECT_EQ(layer.overlay.lines.back().rgba, kPathColor);
    EXPECT_EQ(layer.overlay.lines.back().b, plan.paths[0].vertices.back().position);
}

TEST(RoadmapLayer, SwitchesLeaveNothingBehind) {
    RoadmapOverlayOptions none;
    none.accepted = none.links = none.samples = none.refused = none.dropped = none.path = false;
    const PlanLayer layer = roadmapLayer(smallPlan(), none);
    EXPECT_TRUE(layer.overlay.lines.empty());
    EXPECT_TRUE(layer.overlay.marks.empty());
    EXPECT_TRUE(layer.legend.entries.empty());
}

TEST(RoadmapLayer, ColoursByRoomWhenAsked) {
    RoadmapOverlayOptions options;
    options.color = EdgeColor::Room;
    const PlanLayer layer = roadmapLayer(smallPlan(), options);
    EXPECT_EQ(countOf(layer.legend, "Accepted, room 1"), 1);
    EXPECT_EQ(countOf(layer.legend, "Accepted, room 2"), 1);
}

TEST(TrajectoryLayer, ColoursFramesByTheirValues) {
    const auto& room = furnished();
    const FrameSeries& series = room.plan->series;
    const std::map<TrajectoryColor, const std::vector<double>*> cases = {
        {TrajectoryColor::Clearance, &series.clearance_m},
        {TrajectoryColor::Speed, &series.speed_mps},
        {TrajectoryColor::TurnRate, &series.turn_dps},
        {TrajectoryColor::Score, &series.score},
    };
    for (const auto& [color, values] : cases) {
        TrajectoryOverlayOptions options;
        options.color = color;
        const PlanLayer layer = trajectoryLayer(*room.plan, options);
        ASSERT_TRUE(layer.legend.scale);
        EXPECT_DOUBLE_EQ(layer.legend.scale->max,
                         *std::max_element(values->begin(), values->end()));
        std::size_t lines = 0;
        for (const render::OverlayLine& line : layer.overlay.lines) {
            const std::size_t frame = fromTag(line.tag).index;
            ASSERT_EQ(fromTag(line.tag).kind, Picked::Frame);
            ++lines;
            EXPECT_EQ(line.b, room.plan->trajectory.frames[frame].pose.position);
            const LegendScale& scale = *layer.legend.scale;
            const double share = ((*values)[frame] - scale.min) / (scale.max - scale.min);
            EXPECT_LT((line.rgba - scaleColor(share)).norm(), 1e-5F);
        }
        EXPECT_EQ(lines, room.plan->trajectory.frames.size() - room.plan->paths.size());
    }
}

TEST(SurfaceLayer, DrawsASquareOnEachPatchOfTheStatesAskedFor) {
    SurfaceShare surface;
    EXPECT_TRUE(surfaceLayer(surface, {}).overlay.triangles.empty());
    surface.patch_m = 0.1;
    const Eigen::Vector3f normal = Eigen::Vector3f(1, 2, -2) / 3.0F;
    surface.measured = {{{0, 0, 0}, normal, PatchState::Unseen},
                        {{1, 0, 0}, normal, PatchState::Seen},
                        {{2, 0, 0}, normal, PatchState::SeenAtBest},
                        {{3, 0, 0}, normal, PatchState::Covered},
                        {{4, 0, 0}, normal, PatchState::Covered}};
    SurfaceOverlayOptions options;
    const PlanLayer missing = surfaceLayer(surface, options);
    EXPECT_EQ(missing.overlay.triangles.size(), 6U);
    EXPECT_EQ(countOf(missing.legend, "Surface that no frame shows"), 1);
    options.covered = true;
    options.unseen = options.seen = false;
    const PlanLayer covered = surfaceLayer(surface, options);
    ASSERT_EQ(covered.overlay.triangles.size(), 4U);
    EXPECT_EQ(countOf(covered.legend, "Covered"), 2);
    double area_m2 = 0.0;
    for (const render::OverlayTriangle& one : covered.overlay.triangles) {
        const Eigen::Vector3d twice = (one.b - one.a).cross(one.c - one.a);
        area_m2 += 0.5 * twice.norm();
        EXPECT_NEAR(twice.normalized().dot(normal.cast<double>()), 1.0, 1e-6);
        const double x = one.a.x() < 3.5 ? 3.0 : 4.0;
        EXPECT_NEAR((one.a - Eigen::Vector3d(x, 0, 0)).dot(normal.cast<double>()), 0.01, 1e-6);
    }
    EXPECT_NEAR(area_m2, 2.0 * 0.07 * 0.07, 1e-6);
}

TEST(TrajectoryLayer, ColoursByImageCornersWhereTheyWereCounted) {
    Plan plan = *furnished().plan;
    TrajectoryOverlayOptions options;
    options.color = TrajectoryColor::ImageCorners;
    const PlanLayer without = trajectoryLayer(plan, options);
    EXPECT_FALSE(without.legend.scale);
    ASSERT_FALSE(without.legend.entries.empty());
    EXPECT_NE(without.legend.entries[0].name.find("trackability"), std::string::npos);
    plan.series.image_corners.assign(plan.trajectory.frames.size(), 0.5 * kTrackableCorners);
    EXPECT_EQ(trajectoryLayer(plan, options).legend.scale->max, 2.0 * kTrackableCorners);
    plan.series.image_corners.assign(plan.trajectory.frames.size(), 5.0 * kTrackableCorners);
    plan.series.image_corners[1] = 0.0;
    const PlanLayer with = trajectoryLayer(plan, options);
    ASSERT_TRUE(with.legend.scale);
    EXPECT_EQ(with.legend.scale->max, 2.0 * kTrackableCorners);
    for (const render::OverlayLine& line : with.overlay.lines) {
        const float share = fromTag(line.tag).index == 1 ? 0.0F : 1.0F;
        EXPECT_LT((line.rgba - scaleColor(share)).norm(), 1e-5F);
    }
}

TEST(TrajectoryLayer, DotsAreWhereSomethingNewIsCaptured) {
    const auto& room = furnished();
    TrajectoryOverlayOptions options;
    options.color = TrajectoryColor::NewlyCaptured;
    const PlanLayer layer = trajectoryLayer(*room.plan, options);
    std::size_t captured = 0;
    for (const render::OverlayMark& mark : layer.overlay.marks) {
        if (mark.shape != render::OverlayMark::Shape::Dot) continue;
        const std::size_t frame = fromTag(mark.tag).index;
        captured += room.plan->series.newly_captured[frame].size();
    }
    EXPECT_EQ(captured, static_cast<std::size_t>(room.plan->capture_metrics.captured));
}

// The legend also counts the candidates that are not drawn, so that users know about them.
TEST(CandidatesLayer, LeavesOutWhatIsNotToBeShown) {
    const fixture::PlannedRoom& room = furnished();
    CandidatesOverlayOptions options;
    options.observation_point = 0;
    const PlanLayer all = candidatesLayer(*room.plan, options);
    const ViewpointSearch& search = room.plan->searches[0];
    const Verdict refused = std::ranges::find_if(search.candidates, [](const Candidate& one) {
                                return one.verdict != Verdict::Legal;
                            })->verdict;
    const auto number = std::ranges::count(search.candidates, refused, &Candidate::verdict);
    options.shown[static_cast<std::size_t>(refused)] = false;
    const PlanLayer fewer = candidatesLayer(*room.plan, options);
    EXPECT_EQ(tagged(all.overlay, Picked::Candidate).size() -
                  tagged(fewer.overlay, Picked::Candidate).size(),
              static_cast<std::size_t>(number));
    ASSERT_EQ(fewer.legend.entries.size(), all.legend.entries.size());
    const auto said = std::ranges::find_if(fewer.legend.entries, [](const LegendEntry& entry) {
        return entry.name.ends_with("(not drawn)");
    });
    ASSERT_NE(said, fewer.legend.entries.end());
    EXPECT_EQ(said->count, number);
}

TEST(CandidatesLayer, ColoursEveryCandidateByItsVerdict) {
    const auto& room = furnished();
    for (int o = 0; o < static_cast<int>(room.plan->observation_points.size()); ++o) {
        CandidatesOverlayOptions options;
        options.observation_point = o;
        const PlanLayer layer = candidatesLayer(*room.plan, options);
        const auto& search = room.plan->searches[o];
        std::map<std::string, int> counts;
        for (const Candidate& candidate : search.candidates) {
            std::string words(inWords(candidate.verdict));
            words[0] = static_cast<char>(std::toupper(words[0]));
            ++counts[words];
        }
        for (const auto& [words, count] : counts) EXPECT_EQ(countOf(layer.legend, words), count);
        EXPECT_EQ(tagged(layer.overlay, Picked::Candidate).size(), search.candidates.size());
        for (const render::OverlayMark& mark : layer.overlay.marks) {
            if (fromTag(mark.tag).kind != Picked::Candidate) continue;
            const std::size_t i = fromTag(mark.tag).index;
            EXPECT_EQ(mark.rgba, colorOf(search.candidates[i].verdict));
        }
        // The cone has its tip at the target and opens by the angle asked for.
        for (const render::OverlayTriangle& triangle : layer.overlay.triangles) {
            const auto& point = room.plan->observation_points[o];
            EXPECT_EQ(triangle.a, point.position);
            EXPECT_NEAR(angleBetween(triangle.b - triangle.a, point.direction),
                        40.0 * 3.14159265358979 / 180.0, 1e-6);
        }
        EXPECT_EQ(countOf(layer.legend, "Taken"), search.position_point >= 0 ? 1 : -1);
    }
    EXPECT_TRUE(candidatesLayer(*room.plan, {}).overlay.marks.empty());
}

}  // namespace
}  // namespace dollytrack::ui::plan_layers_test
