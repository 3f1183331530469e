#include "planning/pipeline/pipeline_stages.h"

#include "engine/core/log.h"
#include "planning/collision/swept_sphere.h"
#include "planning/coverage/region_weights.h"
#include "planning/gaze/context_views.h"
#include "planning/gaze/image_motion.h"
#include "planning/gaze/room_views.h"
#include "planning/linking/link_groups.h"
#include "planning/path/frame_budget.h"
#include "planning/path/path_search.h"
#include "planning/path/time_budget.h"
#include "planning/repair/low_runs.h"
#include "planning/roadmap/roadmap_search.h"
#include "planning/smoothing/smooth_path.h"
#include "planning/targets/observation_points.h"
#include "planning/timing/clip.h"
#include "planning/timing/drop_repeats.h"
#include "planning/timing/key_views.h"
#include "planning/timing/shake.h"
#include "planning/timing/time_trajectory.h"
#include "planning/viewpoints/key_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>

namespace dollytrack::planning {
namespace {

/// Classes of the structure objects; other classes do not affect where the camera may be.
std::vector<int> structureClasses(const Scene& scene) {
    std::vector<int> classes;
    for (const Object& object : scene.objects) {
        if (object.structure) classes.push_back(object.nyu40);
    }
    return classes;
}

void warnOfUnscanned(const FreeSpace& map) {
    constexpr double kNearlyAll = 0.9;
    if (map.scannedShare().value_or(1.0) >= kNearlyAll) return;
    log::warn("planning", fmt::format("only {:.0f} % of the rooms was scanned; the camera avoids "
                                      "the rest and may miss objects there",
                                      100.0 * *map.scannedShare()));
}

/// The position point of the pin with this name; -1 if there is none or it was refused.
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
            if (!free_space.reused()) warnOfUnscanned(*free_space);
            const FreeSpaceParams& limits = params.free_space;
            return run("region", region,
                       std::tuple(free_space.version(), structureClasses(*scene), edits.no_go,
                                  limits.min_height_m, limits.max_height_m, params.body),
                       job.stage(0.4, 0.4, "region"), [&]() -> Result<AllowedRegion> {
                           return AllowedRegion(*scene, *rays, *free_space, edits.no_go, limits,
                                                params.body, params.camera.camera_radius_m);
                       });
        })
        .and_then([&] {
            return run("views", views, std::tuple(scene_version, params.camera),
                       job.stage(0.4, 0.42, "views"), [&]() -> Result<ViewEstimator> {
                           return ViewEstimator(*scene, *rays, params.camera);
                       });
        });
}

Result<Pipeline::Stages::Coverages> Pipeline::Stages::measureCoverages(
    const Trajectory& trajectory, const JobContext& job) const {
    if (!asks) return Coverages{};
    return measureCoverage(asked->must_see, *views, trajectory, job)
        .and_then([&](std::vector<RegionCoverage>&& must_see) -> Result<Coverages> {
            if (!asked->surface) return Coverages{std::move(must_see), {}};
            return measureSurface(*asked->surface, *views, trajectory, job)
                .map([&](const SurfaceShare& surface) {
                    return Coverages{std::move(must_see), surface};
                });
        });
}

Status Pipeline::Stages::plan(const PlanParams& params, const PlanEdits& edits,
                              const JobContext& job, const OnTrajectory& on_trajectory) {
    const SweptSphere sphere(*rays, *free_space, params.camera.camera_radius_m, &*region);
    const PitchBand pitch = pitchBand(params.constraints);
    const HeadingLimit heading = headingLimit(params.body);
    const Surroundings around{*views, *free_space, sphere, pitch, heading};
    PathEnds ends;
    // Created if needed: with one trajectory per room, the sphere must stay in its room.
    std::optional<SweptSphere> in_room;
    const auto moves = [&]() -> const SweptSphere& { return in_room ? *in_room : sphere; };
    const auto around_moves = [&] {
        return Surroundings{*views, *free_space, moves(), pitch, heading};
    };
    const auto steadily = [&](const std::vector<SmoothPath>& smooth, const TimingParams& with) {
        return timeTrajectory(smooth, points().viewpoints.position_points,
                              points().viewpoints.observation_points, with, pitch, heading);
    };
    // Each key needs a frame, including look-aside views and turns on the spot.
    const auto leastOf = [&](const std::vector<SmoothPath>& smooth) {
        return static_cast<int>(leastFrames(smooth, points().viewpoints.position_points,
                                            points().viewpoints.observation_points, pitch,
                                            heading));
    };
    const auto withImageMotion = [&](std::vector<SmoothPath> paths_of_keys) {
        const KeyViews at(points().viewpoints.position_points,
                          points().viewpoints.observation_points, pitch);
        for (SmoothPath& path : paths_of_keys) {
            measureImageMotion(
                path, [&](const SmoothPath::Key& key) { return at.pose(key); }, *views, pitch);
        }
        return paths_of_keys;
    };
    const auto timed = [&](std::vector<SmoothPath> smooth, const TimingParams& with) {
        // With a heading limit, timing adds keys of its own, which have no image motion.
        if (limitsImageMotion(with) && !heading.restricts()) {
            smooth = withImageMotion(std::move(smooth));
        }
        const auto within = [&](int max_frames) {
            TimingParams fewer = with;
            fewer.max_frames = max_frames;
            return steadily(smooth, fewer);
        };
        return within(with.max_frames)
            .and_then([&](Trajectory&& steady) -> Result<Trajectory> {
                if (with.max_frames <= 0 || keepsFrameRate(with)) return std::move(steady);
                const int least = leastOf(smooth);
                FrameLooks looks(*views);  // local to the call, since repairs are tried in parallel
                return dropRepeats(
                    std::move(steady), with.max_repeat_rate,
                    [&](int max_frames) { return within(std::max(max_frames, least)); }, looks,
                    job);
            })
            .and_then([&](Trajectory&& steady) {
                return shakeTrajectory(smooth, std::move(steady),
                                       points().viewpoints.position_points, *views, moves(),
                                       params.shake, pitch, params.seed, job);
            });
    };
    TimingParams timing_of_part = params.timing;  // a part of a clip has no duration of its own
    timing_of_part.keep_frame_rate = keepsFrameRate(params.timing);
    timing_of_part.duration_s = 0.0;
    const auto smoothOne = [&](const CameraPath& path) {
        return smoothPath(path, points().viewpoints.position_points,
                          points().viewpoints.observation_points, around_moves(), params.smoothing,
                          job);
    };
    const auto withContext = [&](const SmoothPath& path, const std::vector<SmoothPath>& all) {
        const KeyViews at(points().viewpoints.position_points,
                          points().viewpoints.observation_points, pitch);
        const auto pose = [&](const SmoothPath::Key& key) { return at.pose(key); };
        std::size_t keys = 0;
        for (const SmoothPath& each : all) keys += each.keys.size();
        TimingParams share = params.timing;  // the budget of frames, shared out by the paths' keys
        if (share.max_frames > 0 && keys > path.keys.size()) {
            const double part = static_cast<double>(path.keys.size()) / static_cast<double>(keys);
            share.max_frames = std::max(1, static_cast<int>(share.max_frames * part));
        }
        return withContextViews(path, pose, around, params.gaze, share);
    };
    const TrajectoryMaker maker{
        [&](const CameraPath& path) {
            return smoothOne(path).map(
                [&](const SmoothPath& made) { return withContext(made, *smoothing); });
        },
        [&](const std::vector<SmoothPath>& smooth) { return timed(smooth, params.timing); },
        [&](const SmoothPath& part) { return timed({part}, timing_of_part); }};
    const auto smoothAll =
        [&](const std::vector<CameraPath>& all) -> Result<std::vector<SmoothPath>> {
        std::vector<SmoothPath> smooth;
        for (const CameraPath& path : all) {
            auto made = smoothOne(path);
            if (!made) return tl::unexpected<Error>(std::move(made.error()));
            smooth.push_back(std::move(*made));
        }
        return smooth;
    };
    const auto withContextAll = [&](const std::vector<SmoothPath>& all) {
        std::vector<SmoothPath> made;
        for (const SmoothPath& path : all) made.push_back(withContext(path, all));
        return made;
    };
    return run("targets", targets, std::tuple(views.version(), params.targets, params.viewpoints),
               job.stage(0.42, 0.44, "targets"),
               [&]() -> Result<std::vector<ObservationPoint>> {
                   return setObservationPoints(*views, params.targets, params.viewpoints);
               })
        .and_then([&] {
            const JobContext part = job.stage(0.44, 0.68, "viewpoints");
            memory.refreshSearches(mapped(), {params.camera, params.viewpoints, pitch, params.seed,
                                              edits.no_go, params.free_space, params.body});
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
            const bool room_views = asksForRoomViews(params);
            const bool surface = asksForSurface(params);
            asks = asksForRooms(params.constraints) || !must_see.empty() || room_views || surface;
            if (!asks) return {};
            const JobContext part = job.stage(0.69, 0.7, "constraints");
            return run(
                "constraints", asked,
                std::tuple(placed.version(), rooms.version(), must_see, params.constraints.anchors,
                           params.constraints.rooms, room_views ? params.gaze : GazeParams{},
                           room_views || surface ? params.timing.max_frames : 0,
                           room_views ? params.seed : 0,
                           surface ? params.coverage : CoverageParams{}),
                part, [&] {
                    return addConstraintViewpoints(
                        *placed, must_see, params,
                        asksForRooms(params.constraints) ? &*rooms : nullptr, around, &memory.shown,
                        part);
                });
        })
        .and_then([&] {
            const std::vector<double> weights = objectWeights(*scene, edits.regions);
            ends = {pointOfPin(*placed, edits, edits.start),
                    pointOfPin(*placed, edits, edits.end),
                    params.constraints.loop,
                    pointWeights(points().viewpoints.position_points, weights),
                    weights,
                    keepsFrameRate(params.timing) ? 0 : mostVisits(params)};
            // The same point for both ends is a loop, whatever the parameter says.
            ends.loop = ends.loop || (ends.start >= 0 && ends.start == ends.end);
            const auto& all = points().viewpoints.position_points;
            ends.chosen_by_tour = isChosenByTour(params.path, all, ends);
            return run(
                "key_frames", key_frames,
                std::tuple(pointsVersion(), edits.regions, ends.chosen_by_tour ? 0 : ends.visits,
                           ends.start, ends.end, ends.loop, params.coverage.objective),
                job.stage(0.7, 0.71, "key frames"), [&]() -> Result<std::vector<int>> {
                    std::vector<int> chosen =
                        chooseKeyFrames(all, weights, params.coverage.objective);
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
                const auto smooth = smoothOne(path);
                return smooth ? smooth->length_m : std::numeric_limits<double>::infinity();
            };
            const bool clip = clipFrames(params.timing) > 0;
            const TimedPaths measured{
                [&](double max_length_m) -> Result<Paths> {
                    Paths taken{*linking, {}};
                    PathParams within = params.path;
                    within.max_length_m = max_length_m;
                    return takePaths(taken.roadmap, points().viewpoints.position_points, moves(),
                                     within, params.roadmap, ends, part)
                        .map([&](std::vector<CameraPath> made) {
                            taken.paths = std::move(made);
                            return std::move(taken);
                        });
                },
                [&](const Paths& taken) {
                    return smoothAll(taken.paths)
                        .and_then([&](const std::vector<SmoothPath>& smooth) {
                            return steadily(withContextAll(smooth), timing_of_part);
                        })
                        .map([](const Trajectory& trajectory) { return trajectory.frames.size(); });
                }};
            return run(
                "path", paths,
                std::tuple(
                    linking.version(), params.path, params.roadmap, edits.regions, ends.start,
                    ends.end, ends.loop, ends.visits,
                    clip || params.path.max_length_m > 0.0 ? params.smoothing : SmoothingParams{},
                    clip ? params.timing : TimingParams{}, params.body),
                part, [&]() -> Result<Paths> {
                    if (!clip) return measured.take(params.path.max_length_m);
                    return pathsWithinFrames(measured, params.path.max_length_m,
                                             static_cast<std::size_t>(clipFrames(params.timing)))
                        .and_then([&](std::optional<Paths>&& found_paths) -> Result<Paths> {
                            if (!found_paths) return tooShortClip(params.timing);
                            return std::move(*found_paths);
                        });
                });
        })
        .and_then([&] {
            const JobContext part = job.stage(0.84, 0.89, "smoothing");
            return run("smoothing", smoothing,
                       std::tuple(paths.version(), params.smoothing, params.body), part,
                       [&] { return smoothAll(paths->paths); });
        })
        .and_then([&] {
            return run("gaze", gaze,
                       std::tuple(smoothing.version(), views.version(), params.gaze,
                                  params.gaze.view_mix > 0.0 ? params.timing : TimingParams{}),
                       job.stage(0.89, 0.9, "gaze"), [&]() -> Result<std::vector<SmoothPath>> {
                           return withContextAll(*smoothing);
                       });
        })
        .and_then([&] {
            return run("timing", timing,
                       std::tuple(gaze.version(), params.timing, params.shake, params.body),
                       job.stage(0.9, 0.91, "timing"), [&] { return maker.time(*gaze); });
        })
        .and_then([&] {
            const JobContext part =
                job.stage(0.91, asksForRepair(params.repair) ? 0.97 : 0.92, "repair");
            return run("repair", repair,
                       std::tuple(timing.version(), views.version(), params.repair, params.seed),
                       part, [&]() -> Result<Repaired> {
                           const Repaired as_timed{paths->paths, *gaze, *timing, {}};
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
                        return measureCoverages(trajectory, part).map([&](Coverages&& shown) {
                            return Metrics{std::move(*estimate), measured, std::move(shown),
                                           std::move(series), report};
                        });
                    });
            });
        });
}

}  // namespace dollytrack::planning
