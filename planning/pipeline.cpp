#include "planning/pipeline.h"

#include "engine/geometry/ray_caster.h"
#include "engine/scene/move_object.h"
#include "planning/collision/allowed_region.h"
#include "planning/collision/swept_sphere.h"
#include "planning/coverage/region_weights.h"
#include "planning/free_space/free_space.h"
#include "planning/free_space/surface_map.h"
#include "planning/linking/link_groups.h"
#include "planning/metrics/capture_ledger.h"
#include "planning/metrics/estimate_captures.h"
#include "planning/path/frame_budget.h"
#include "planning/path/path_search.h"
#include "planning/repair/low_runs.h"
#include "planning/repair/repair.h"
#include "planning/roadmap/roadmap_search.h"
#include "planning/rooms/room_plan.h"
#include "planning/run_memory.h"
#include "planning/smoothing/smooth_path.h"
#include "planning/stage.h"
#include "planning/targets/observation_points.h"
#include "planning/timing/drop_repeats.h"
#include "planning/timing/shake.h"
#include "planning/timing/time_trajectory.h"
#include "planning/viewpoints/asked_points.h"
#include "planning/viewpoints/hand_placed.h"
#include "planning/viewpoints/key_frames.h"
#include "planning/viewpoints/viewpoint_search.h"
#include "planning/visibility/view_estimator.h"

#include <fmt/format.h>

#include <chrono>
#include <limits>
#include <optional>
#include <tuple>

namespace dollytrack::planning {
namespace {

struct Paths {
    Roadmap roadmap;  // with the cycle edges marked
    std::vector<CameraPath> paths;
};

struct Metrics {
    CaptureEstimate estimate;
    TrajectoryMetrics trajectory;
    std::vector<RegionCoverage> must_see;
    FrameSeries series;
    RepairReport repair;
};

using V = unsigned;  // version of an earlier stage's output

/// What tells floors from walls; other classes are of no account to where the camera may be.
std::vector<int> structureClasses(const Scene& scene) {
    std::vector<int> classes;
    for (const Object& object : scene.objects) {
        if (object.structure) classes.push_back(object.nyu40);
    }
    return classes;
}

/// What keeps key frames off the path, as a sentence's part.
std::string leftOutFor(const PlanParams& params) {
    if (params.path.path_mode == PathMode::LongestBranch) {
        return "as path_mode=longest_branch takes one branch of the tree only";
    }
    if (params.path.max_length_m <= 0.0) return "as no way leads there";
    return params.timing.max_frames > 0
               ? fmt::format("to keep to max_length_m={:g} with max_frames={}",
                             params.path.max_length_m, params.timing.max_frames)
               : fmt::format("to keep to max_length_m={:g}", params.path.max_length_m);
}

/// The position point of the pinned one that bears the name; -1 without one, or when it is refused.
int pointOfPin(const PlacedPoints& placed, const PlanEdits& edits, const std::string& name) {
    if (name.empty()) return -1;
    const std::vector<PositionPoint>& points = placed.viewpoints.position_points;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const int pin = points[i].pin;
        if (pin >= 0 && edits.pinned[static_cast<std::size_t>(pin)].name == name) {
            return static_cast<int>(i);
        }
    }
    return -1;
}

}  // namespace

struct Pipeline::Stages {
    std::shared_ptr<const Scene> scene;
    V scene_version = 0;
    V geometry_version = 0;
    Stage<std::tuple<V>, RayCaster> rays;
    Stage<std::tuple<V, double>, SurfaceMap> surfaces;
    Stage<std::tuple<unsigned, double>, FreeSpace> free_space;
    Stage<std::tuple<V, std::vector<int>, std::vector<NoGoBox>, double, double>, AllowedRegion>
        region;
    Stage<std::tuple<V, CameraParams>, ViewEstimator> views;
    Stage<std::tuple<V, TargetParams, ViewpointParams>, std::vector<ObservationPoint>> targets;
    Stage<std::tuple<V, V, V, ViewpointParams, PitchBand, int>, Viewpoints> found;
    Stage<std::tuple<V, V, PitchBand, std::vector<PinnedPoint>, std::vector<RemovedPoint>>,
          PlacedPoints>
        placed;
    Stage<std::tuple<V, std::vector<int>>, RoomPlan> rooms;
    Stage<std::tuple<V, V, std::vector<Region>, Anchors, RoomTours>, AskedPoints> asked;
    Stage<std::tuple<V, std::vector<Region>, int, int, int, bool>, std::vector<int>> key_frames;
    Stage<std::tuple<V, RoadmapParams, int>, Roadmap> roadmap;
    Stage<std::tuple<V, LinkParams, int>, Roadmap> linking;
    Stage<std::tuple<V, PathParams, RoadmapParams, std::vector<Region>, int, int, bool, int,
                     SmoothingParams>,
          Paths>
        paths;
    Stage<std::tuple<V, SmoothingParams>, std::vector<SmoothPath>> smoothing;
    Stage<std::tuple<V, TimingParams, ShakeParams>, Trajectory> timing;
    Stage<std::tuple<V, V, RepairParams, int>, Repaired> repair;
    Stage<std::tuple<V, RepairParams>, Metrics> metrics;

    // Whether the last run asked for more points than objects need, so that `asked` holds.
    bool asks = false;
    [[nodiscard]] const PlacedPoints& points() const { return asks ? asked->placed : *placed; }
    /// Never the same for different points.
    [[nodiscard]] V pointsVersion() const {
        return asks ? 2 * asked.version() + 1 : 2 * placed.version();
    }

    RunMemory memory;
    std::vector<StageTime> times;
    std::string left_out_for;  // of the last run's parameters, see captureLedger()

    /// Runs one stage, timed, unless the job was cancelled before it.
    template <class StageType, class Inputs, class Make>
    Status run(std::string_view name, StageType& stage, const Inputs& inputs, const JobContext& job,
               Make&& make) {
        if (job.cancelled()) return fail(ErrorCode::Cancelled, "Planning was cancelled.");
        job.report(0.0);
        const auto begin = std::chrono::steady_clock::now();
        Status status = stage.update(inputs, std::forward<Make>(make));
        const std::chrono::duration<double, std::milli> spent =
            std::chrono::steady_clock::now() - begin;
        times.push_back({std::string(name), spent.count(), stage.reused()});
        job.report(1.0);
        return status;
    }

    /// The map of the last run that made one.
    [[nodiscard]] MapInUse mapped() const {
        return {free_space.version(), region.version(), free_space.share(), region.share()};
    }

    Status map(const PlanParams& params, const PlanEdits& edits, const JobContext& job);
    Status plan(const PlanParams& params, const PlanEdits& edits, const JobContext& job,
                const OnTrajectory& on_trajectory);
    [[nodiscard]] Plan collectMoves() const;
    [[nodiscard]] Plan collect(const PlanEdits& edits) const;
};

Status Pipeline::Stages::map(const PlanParams& params, const PlanEdits& edits,
                             const JobContext& job) {
    return run("rays", rays, std::tuple(geometry_version), job.stage(0.0, 0.1, "rays"),
               [&]() -> Result<RayCaster> { return memory.cast(*scene); })
        .and_then([&] {
            const JobContext part = job.stage(0.1, 0.2, "surfaces");
            const auto before = surfaces.share();
            return run("surfaces", surfaces,
                       std::tuple(geometry_version, params.free_space.octree_resolution_m), part,
                       [&] {
                           const std::vector<int> moved = memory.takeMovedSinceSurfaces();
                           return before ? SurfaceMap::afterMoves(*before, *scene, moved,
                                                                  params.free_space, part)
                                         : SurfaceMap::build(*scene, params.free_space, part);
                       });
        })
        .and_then([&] {
            const JobContext part = job.stage(0.2, 0.4, "free space");
            const auto before = free_space.share();
            return run("free_space", free_space,
                       std::tuple(surfaces.version(), params.camera.camera_radius_m), part, [&] {
                           const std::vector<int> moved = memory.takeMovedSinceFreeSpace();
                           return before ? FreeSpace::afterMoves(*before, surfaces.share(), moved,
                                                                 *scene, *rays, params.camera, part)
                                         : FreeSpace::buildOver(surfaces.share(), *scene, *rays,
                                                                params.camera, part);
                       });
        })
        .and_then([&] {
            const FreeSpaceParams& limits = params.free_space;
            return run("region", region,
                       std::tuple(free_space.version(), structureClasses(*scene), edits.no_go,
                                  limits.min_height_m, limits.max_height_m),
                       job.stage(0.4, 0.4, "region"), [&]() -> Result<AllowedRegion> {
                           return AllowedRegion(*scene, *rays, *free_space, edits.no_go, limits,
                                                params.camera.camera_radius_m);
                       });
        })
        .and_then([&] {
            return run("views", views, std::tuple(scene_version, params.camera),
                       job.stage(0.4, 0.42, "views"), [&]() -> Result<ViewEstimator> {
                           return ViewEstimator(*scene, *rays, params.camera);
                       });
        });
}

Status Pipeline::Stages::plan(const PlanParams& params, const PlanEdits& edits,
                              const JobContext& job, const OnTrajectory& on_trajectory) {
    const SweptSphere sphere(*rays, *free_space, params.camera.camera_radius_m, &*region);
    const PitchBand pitch = pitchBand(params.constraints);
    const Surroundings around{*views, *free_space, sphere, pitch};
    PathEnds ends;
    // Made when they are asked for: a sphere that stays in its room where each has a trajectory.
    std::optional<SweptSphere> in_room;
    const auto moves = [&]() -> const SweptSphere& { return in_room ? *in_room : sphere; };
    const auto around_moves = [&] { return Surroundings{*views, *free_space, moves(), pitch}; };
    const TrajectoryMaker maker{
        [&](const CameraPath& path) {
            return smoothPath(path, points().viewpoints.position_points,
                              points().viewpoints.observation_points, around_moves(),
                              params.smoothing, job);
        },
        [&](const std::vector<SmoothPath>& smooth) {
            const Viewpoints& all = points().viewpoints;
            const auto within = [&](int max_frames) {
                TimingParams timed = params.timing;
                timed.max_frames = max_frames;
                return timeTrajectory(smooth, all.position_points, all.observation_points, timed,
                                      pitch);
            };
            return within(params.timing.max_frames)
                .and_then([&](Trajectory&& timed) -> Result<Trajectory> {
                    if (params.timing.max_frames <= 0) return std::move(timed);
                    FrameLooks looks(*views);  // of this call: repairs are tried in parallel
                    return dropRepeats(std::move(timed), params.timing.max_repeat_rate, within,
                                       looks, job);
                })
                .and_then([&](Trajectory&& steady) {
                    return shakeTrajectory(smooth, std::move(steady), all.position_points, *views,
                                           moves(), params.shake, pitch, params.seed, job);
                });
        }};
    return run("targets", targets, std::tuple(views.version(), params.targets, params.viewpoints),
               job.stage(0.42, 0.44, "targets"),
               [&]() -> Result<std::vector<ObservationPoint>> {
                   return setObservationPoints(*views, params.targets, params.viewpoints);
               })
        .and_then([&] {
            const JobContext part = job.stage(0.44, 0.68, "viewpoints");
            memory.refreshSearches(mapped(), {params.camera, params.viewpoints, pitch, params.seed,
                                              edits.no_go, params.free_space});
            return run("viewpoints", found,
                       std::tuple(targets.version(), region.version(), views.version(),
                                  params.viewpoints, pitch, params.seed),
                       part, [&] {
                           return searchViewpoints(around, *targets, params.viewpoints, params.seed,
                                                   part, &memory.searches);
                       });
        })
        .and_then([&] {
            memory.refreshShown(views.version(), params.camera, *views);
            return run(
                "by_hand", placed,
                std::tuple(found.version(), views.version(), pitch, edits.pinned, edits.removed),
                job.stage(0.68, 0.7, "by hand"), [&]() -> Result<PlacedPoints> {
                    return placeByHand(*found, edits, around, &memory.shown);
                });
        })
        .and_then([&]() -> Status {
            if (!asksForRooms(params.constraints)) return {};
            return run("rooms", rooms, std::tuple(free_space.version(), structureClasses(*scene)),
                       job.stage(0.69, 0.69, "rooms"),
                       [&]() -> Result<RoomPlan> {
                           return RoomPlan(*scene, *rays, *free_space,
                                           params.camera.camera_radius_m);
                       })
                .map([&] {
                    if (params.constraints.rooms != RoomTours::Each) return;
                    in_room.emplace(*rays, *free_space, params.camera.camera_radius_m, &*region,
                                    &*rooms);
                });
        })
        .and_then([&]() -> Status {
            const std::vector<Region> must_see = mustSeeAmong(edits.regions);
            asks = asksForRooms(params.constraints) || !must_see.empty();
            if (!asks) return {};
            const JobContext part = job.stage(0.69, 0.7, "constraints");
            return run("constraints", asked,
                       std::tuple(placed.version(), rooms.version(), must_see,
                                  params.constraints.anchors, params.constraints.rooms),
                       part, [&] {
                           return addAskedPoints(
                               *placed, must_see, params.constraints,
                               asksForRooms(params.constraints) ? &*rooms : nullptr, around,
                               &memory.shown, part);
                       });
        })
        .and_then([&] {
            const std::vector<double> weights = objectWeights(*scene, edits.regions);
            ends = {pointOfPin(*placed, edits, edits.start),
                    pointOfPin(*placed, edits, edits.end),
                    params.constraints.loop,
                    pointWeights(points().viewpoints.position_points, weights),
                    weights,
                    params.timing.max_frames};
            // One point for both ends is a loop, whatever the parameter says.
            ends.loop = ends.loop || (ends.start >= 0 && ends.start == ends.end);
            const auto& all = points().viewpoints.position_points;
            ends.chosen_by_tour = isChosenByTour(params.path, all, ends);
            return run(
                "key_frames", key_frames,
                std::tuple(pointsVersion(), edits.regions, ends.chosen_by_tour ? 0 : ends.visits,
                           ends.start, ends.end, ends.loop),
                job.stage(0.7, 0.71, "key frames"), [&]() -> Result<std::vector<int>> {
                    std::vector<int> chosen = chooseKeyFrames(all, weights);
                    return ends.chosen_by_tour ? chosen : withinBudget(chosen, all, ends);
                });
        })
        .and_then([&] {
            const JobContext part = job.stage(0.71, 0.75, "roadmap");
            return run("roadmap", roadmap,
                       std::tuple(key_frames.version(), params.roadmap, params.seed), part, [&] {
                           return searchRoadmap(
                               points().viewpoints.position_points, *key_frames,
                               targetSizes(*scene, points().viewpoints.observation_points,
                                           points().viewpoints.position_points),
                               moves(), params.roadmap, params.seed, part);
                       });
        })
        .and_then([&] {
            const JobContext part = job.stage(0.75, 0.8, "linking");
            return run(
                "linking", linking, std::tuple(roadmap.version(), params.linking, params.seed),
                part, [&]() -> Result<Roadmap> {
                    Roadmap linked = *roadmap;
                    return linkGroups(linked, points().viewpoints.position_points, *key_frames,
                                      *free_space, moves(), params.linking, params.seed, part)
                        .map([&] { return std::move(linked); });
                });
        })
        .and_then([&] {
            const JobContext part = job.stage(0.8, 0.84, "path");
            ends.rank.assign(points().viewpoints.position_points.size(), 0);
            for (std::size_t i = 0; i < key_frames->size(); ++i) {
                ends.rank[static_cast<std::size_t>((*key_frames)[i])] = static_cast<int>(i);
            }
            ends.corner_distance_m = params.smoothing.corner_distance_m;
            ends.flown_m = [&](const CameraPath& path) {
                const auto smooth = maker.smooth(path);
                return smooth ? smooth->length_m : std::numeric_limits<double>::infinity();
            };
            return run(
                "path", paths,
                std::tuple(linking.version(), params.path, params.roadmap, edits.regions,
                           ends.start, ends.end, ends.loop, ends.visits,
                           params.path.max_length_m > 0.0 ? params.smoothing : SmoothingParams{}),
                part, [&]() -> Result<Paths> {
                    Paths taken{*linking, {}};
                    return takePaths(taken.roadmap, points().viewpoints.position_points, moves(),
                                     params.path, params.roadmap, ends, part)
                        .map([&](std::vector<CameraPath> made) {
                            taken.paths = std::move(made);
                            return std::move(taken);
                        });
                });
        })
        .and_then([&] {
            const JobContext part = job.stage(0.84, 0.9, "smoothing");
            return run("smoothing", smoothing, std::tuple(paths.version(), params.smoothing), part,
                       [&]() -> Result<std::vector<SmoothPath>> {
                           std::vector<SmoothPath> smooth;
                           for (const CameraPath& path : paths->paths) {
                               auto made = maker.smooth(path);
                               if (!made) return tl::unexpected<Error>(std::move(made.error()));
                               smooth.push_back(std::move(*made));
                           }
                           return smooth;
                       });
        })
        .and_then([&] {
            return run("timing", timing,
                       std::tuple(smoothing.version(), params.timing, params.shake),
                       job.stage(0.9, 0.91, "timing"), [&] { return maker.time(*smoothing); });
        })
        .and_then([&] {
            const JobContext part =
                job.stage(0.91, asksForRepair(params.repair) ? 0.97 : 0.92, "repair");
            return run("repair", repair,
                       std::tuple(timing.version(), views.version(), params.repair, params.seed),
                       part, [&]() -> Result<Repaired> {
                           const Repaired as_timed{paths->paths, *smoothing, *timing, {}};
                           if (!asksForRepair(params.repair)) return as_timed;
                           return repairTrajectory(as_timed, maker, around_moves(), params.repair,
                                                   params.seed, part, &memory.seen);
                       });
        })
        .and_then([&] {
            const auto with = std::tuple(repair.version(), params.repair);
            if (on_trajectory && !metrics.holds(with)) {
                on_trajectory(std::make_shared<const Plan>(collectMoves()));
            }
            const JobContext part = job.stage(0.92, 1.0, "metrics");
            return run("metrics", metrics, with, part, [&]() -> Result<Metrics> {
                const Trajectory& trajectory = repair->trajectory;
                auto estimate = estimateCaptures(*views, trajectory, part, &memory.seen);
                if (!estimate) return tl::unexpected<Error>(std::move(estimate.error()));
                FrameSeries series = measureFrames(
                    trajectory, estimate->frame_views, estimate->captures,
                    imageScores(trajectory, estimate->frame_boxes, params.repair.score), *rays);
                RepairReport report = repair->report;
                if (!asksForRepair(params.repair)) {
                    report.threshold = lowThreshold(series.score, params.repair.score_threshold);
                    report.before = report.after = tally(series.score, report.threshold);
                }
                return measureTrajectory(*views, repair->smooth_paths, trajectory, moves(), *rays,
                                         part)
                    .and_then([&](const TrajectoryMetrics& measured) {
                        static const std::vector<MustSee> kNone;
                        return measureCoverage(asks ? asked->must_see : kNone, *views, trajectory,
                                               part)
                            .map([&](std::vector<RegionCoverage> must_see) {
                                return Metrics{std::move(*estimate), measured, std::move(must_see),
                                               std::move(series), report};
                            });
                    });
            });
        });
}

Plan Pipeline::Stages::collectMoves() const {
    Plan plan;
    for (const Room& room : free_space->rooms()) plan.rooms.push_back(room.box);
    plan.observation_points = points().viewpoints.observation_points;
    plan.searches = points().viewpoints.searches;
    plan.position_points = points().viewpoints.position_points;
    plan.key_frames = *key_frames;
    plan.roadmap = paths->roadmap;
    plan.paths = repair->paths;
    plan.smooth_paths = repair->smooth_paths;
    plan.trajectory = repair->trajectory;
    if (asks) plan.tour_rooms = asked->tour_rooms;
    if (asks) plan.anchors = countAnchors(*asked, plan.smooth_paths);
    plan.refused_pins = points().refused;
    plan.stages = times;
    for (const StageTime& stage : times) {
        const bool maps = stage.name == "rays" || stage.name == "surfaces" ||
                          stage.name == "free_space" || stage.name == "region" ||
                          stage.name == "views";
        if (maps) plan.map_ms += stage.milliseconds;
        if (!maps && stage.name != "metrics") plan.plan_ms += stage.milliseconds;
    }
    return plan;
}

Plan Pipeline::Stages::collect(const PlanEdits& edits) const {
    Plan plan = collectMoves();
    plan.captures = metrics->estimate.captures;
    plan.frame_views = metrics->estimate.frame_views;
    plan.series = metrics->series;
    plan.capture_metrics = summarize(*scene, plan.captures);
    plan.trajectory_metrics = metrics->trajectory;
    plan.repair = metrics->repair;
    plan.must_see = metrics->must_see;
    refusePinsOverBudget(edits, plan);
    plan.ledger = captureLedger(*scene, plan, left_out_for);
    return plan;
}

void Pipeline::setScene(std::shared_ptr<const Scene> scene, bool same_geometry) {
    const Scene& before = *stages_->scene;
    const auto moved =
        same_geometry ? std::optional(std::vector<int>{}) : movedObjects(before, *scene);
    if (!moved) {
        stages_ = std::make_unique<Stages>();
    } else {
        stages_->memory.noteMoves(before, *scene, *moved, stages_->rays.share(), stages_->mapped());
        if (!moved->empty()) ++stages_->geometry_version;
    }
    stages_->scene = std::move(scene);
    ++stages_->scene_version;
}

Pipeline::Pipeline(std::shared_ptr<const Scene> scene) : stages_(std::make_unique<Stages>()) {
    stages_->scene = std::move(scene);
}
Pipeline::~Pipeline() = default;
Pipeline::Pipeline(Pipeline&&) noexcept = default;
Pipeline& Pipeline::operator=(Pipeline&&) noexcept = default;

Result<std::shared_ptr<const Plan>> Pipeline::run(const PlanParams& params, const PlanEdits& edits,
                                                  const JobContext& job,
                                                  const OnTrajectory& on_trajectory) {
    if (Status status = validate(params.camera); !status) {
        return tl::unexpected<Error>(std::move(status.error()));
    }
    if (!(params.free_space.min_height_m < params.free_space.max_height_m)) {
        return fail(ErrorCode::Usage, "The height band is empty; it must be above min_height_m.",
                    "max_height_m");
    }
    if (params.constraints.min_pitch_deg > params.constraints.max_pitch_deg) {
        return fail(ErrorCode::Usage,
                    "The pitch band is empty; it must not be below min_pitch_deg.",
                    "max_pitch_deg");
    }
    if (params.constraints.loop && !edits.end.empty() && edits.end != edits.start) {
        return fail(ErrorCode::Usage,
                    "A loop ends where it begins; leave its end open, or do without the loop.",
                    "loop");
    }
    stages_->times.clear();
    stages_->left_out_for = leftOutFor(params);
    return stages_->map(params, edits, job)
        .and_then([&] { return stages_->plan(params, edits, job, on_trajectory); })
        .map([&] { return std::make_shared<const Plan>(stages_->collect(edits)); });
}

std::shared_ptr<const FreeSpace> Pipeline::freeSpace() const {
    return stages_->free_space.share();
}
std::shared_ptr<const AllowedRegion> Pipeline::region() const {
    return stages_->region.share();
}
std::shared_ptr<const RayCaster> Pipeline::rays() const {
    return stages_->rays.share();
}

}  // namespace dollytrack::planning
