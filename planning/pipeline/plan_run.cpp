#include "engine/plan/frame_quality.h"
#include "planning/collision/mapped_scene.h"
#include "planning/collision/swept_sphere.h"
#include "planning/coverage/region_weights.h"
#include "planning/gaze/image_corners.h"
#include "planning/gaze/room_views.h"
#include "planning/linking/link_groups.h"
#include "planning/path/frame_budget.h"
#include "planning/path/path_search.h"
#include "planning/pipeline/follow_motion.h"
#include "planning/pipeline/pipeline_stages.h"
#include "planning/pipeline/trajectory_builder.h"
#include "planning/repair/low_runs.h"
#include "planning/roadmap/roadmap_search.h"
#include "planning/targets/observation_points.h"
#include "planning/timing/clip.h"
#include "planning/viewpoints/key_frames.h"

#include <algorithm>
#include <limits>
#include <optional>

namespace dollytrack::planning {
namespace {

/// The position point of the pin with this name; -1 if there is none or it was refused.
int pointOfPin(const PlacedPoints& placed, const PlanEdits& edits, const std::string& name) {
    if (name.empty()) return -1;
    const std::vector<PositionPoint>& points = placed.viewpoints.position_points;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const int pin = points[i].pin;
        if (pin >= 0 && edits.pinned[pin].name == name) {
            return static_cast<int>(i);
        }
    }
    return -1;
}

}  // namespace

/// One run of the stages from targets to metrics. Each function runs one stage and needs
/// those before it.
class Pipeline::Stages::PlanRun {
  public:
    PlanRun(Stages& stages, const PlanParams& params, const PlanEdits& edits, const JobContext& job,
            const OnTrajectory& on_trajectory)
        : stages_(stages),
          params_(params),
          edits_(edits),
          job_(job),
          on_trajectory_(on_trajectory),
          sphere_(*stages_.rays, *stages_.free_space, params.camera.camera_radius_m,
                  &*stages_.region),
          environment_{*stages_.views, *stages_.free_space, sphere_, pitchBand(params.constraints),
                       headingLimit(params.body)} {}

    Status run() {
        return setTargets()
            .and_then([&] { return searchForViewpoints(); })
            .and_then([&] { return placePointsByHand(); })
            .and_then([&] { return divideIntoRooms(); })
            .and_then([&] { return addConstraints(); })
            .and_then([&] { return edits_.motion ? takeMotion() : planTrajectory(); })
            .and_then([&] { return measure(); });
    }

  private:
    Status planTrajectory() {
        stages_.follows_motion = false;
        return selectKeyFrames()
            .and_then([&] { return growRoadmap(); })
            .and_then([&] { return linkRoadmap(); })
            .and_then([&] { return findPaths(); })
            .and_then([&] { return smoothPaths(); })
            .and_then([&] { return addContextViews(); })
            .and_then([&] { return timePaths(); })
            .and_then([&] { return repairFrames(); });
    }

    Status setTargets();
    Status searchForViewpoints();
    Status placePointsByHand();
    Status divideIntoRooms();
    Status addConstraints();
    Status selectKeyFrames();
    Status growRoadmap();
    Status linkRoadmap();
    Status findPaths();
    Status smoothPaths();
    Status addContextViews();
    Status timePaths();
    Status repairFrames();
    Status takeMotion();
    Status measure();

    [[nodiscard]] PathEnds pathEnds() const;
    Result<Paths> pathsWithin(double max_length_m, const PathEnds& ends, const JobContext& job);
    Result<Paths> pathsOfClip(const JobContext& job);
    Result<Metrics> measureFound(const JobContext& job);
    [[nodiscard]] Result<Coverages> measureCoverages(const JobContext& job) const;

    [[nodiscard]] const Viewpoints& viewpoints() const { return stages_.points().viewpoints; }
    [[nodiscard]] const std::vector<PositionPoint>& positionPoints() const {
        return viewpoints().position_points;
    }
    /// Where the camera may move; with one trajectory per room, within its room.
    [[nodiscard]] const PlanningEnvironment& movementEnvironment() const {
        return room_environment_ ? *room_environment_ : environment_;
    }

    Stages& stages_;
    const PlanParams& params_;
    const PlanEdits& edits_;
    const JobContext& job_;
    const OnTrajectory& on_trajectory_;
    SweptSphere sphere_;
    PlanningEnvironment environment_;
    std::optional<SweptSphere> room_sphere_;
    std::optional<PlanningEnvironment> room_environment_;
    PathEnds ends_;                             // from selectKeyFrames()
    std::optional<TrajectoryBuilder> builder_;  // from selectKeyFrames()
};

Status Pipeline::Stages::PlanRun::setTargets() {
    return stages_.run(
        "targets", stages_.targets,
        TargetInputs{stages_.views.version(), params_.targets, params_.viewpoints},
        job_.stage(0.42, 0.44, "targets"), [&]() -> Result<std::vector<ObservationPoint>> {
            return setObservationPoints(*stages_.views, params_.targets, params_.viewpoints);
        });
}

Status Pipeline::Stages::PlanRun::searchForViewpoints() {
    const JobContext job = job_.stage(0.44, 0.68, "viewpoints");
    stages_.cache.refreshSearches(
        stages_.mapped(), {params_.camera, params_.viewpoints, environment_.pitch, params_.seed,
                           edits_.no_go, params_.free_space, params_.body});
    return stages_.run("viewpoints", stages_.found,
                       ViewpointInputs{stages_.targets.version(), stages_.region.version(),
                                       stages_.views.version(), params_.viewpoints,
                                       environment_.pitch, params_.seed},
                       job, [&] {
                           return searchViewpoints(environment_, *stages_.targets,
                                                   params_.viewpoints, params_.seed, job,
                                                   &stages_.cache.searches);
                       });
}

Status Pipeline::Stages::PlanRun::placePointsByHand() {
    stages_.cache.refreshViews(stages_.views.version(), params_.camera, *stages_.views);
    return stages_.run("by_hand", stages_.placed,
                       PlacedInputs{stages_.found.version(), stages_.views.version(),
                                    environment_.pitch, edits_.pinned, edits_.removed},
                       job_.stage(0.68, 0.69, "by hand"), [&]() -> Result<PlacedPoints> {
                           return placeByHand(*stages_.found, edits_, environment_,
                                              &stages_.cache.key_frame_visibility);
                       });
}

Status Pipeline::Stages::PlanRun::divideIntoRooms() {
    if (!asksForRooms(params_.constraints)) return {};
    const double radius_m = params_.camera.camera_radius_m;
    return stages_
        .run("rooms", stages_.rooms,
             RoomInputs{stages_.free_space.version(), structureClasses(*stages_.scene)},
             job_.stage(0.69, 0.69, "rooms"),
             [&]() -> Result<RoomPlan> {
                 return RoomPlan(*stages_.scene, *stages_.rays, *stages_.free_space, radius_m);
             })
        .map([&] {
            if (params_.constraints.rooms != RoomTours::Each) return;
            room_sphere_.emplace(*stages_.rays, *stages_.free_space, radius_m, &*stages_.region,
                                 &*stages_.rooms);
            room_environment_.emplace(PlanningEnvironment{*stages_.views, *stages_.free_space,
                                                          *room_sphere_, environment_.pitch,
                                                          environment_.heading});
        });
}

Status Pipeline::Stages::PlanRun::addConstraints() {
    const bool rooms = asksForRooms(params_.constraints);
    const bool room_views = asksForRoomViews(params_);
    const bool surface = asksForSurface(params_);
    ConstraintInputs inputs{stages_.placed.version(), stages_.rooms.version(),
                            mustSeeAmong(edits_.regions), params_.constraints.anchors,
                            params_.constraints.rooms};
    stages_.has_constraints = rooms || !inputs.must_see.empty() || room_views || surface;
    if (!stages_.has_constraints) return {};
    if (room_views) inputs.view_mix = params_.gaze.view_mix;
    if (room_views) inputs.seed = params_.seed;
    if (room_views || surface) inputs.max_frames = params_.timing.max_frames;
    if (surface) inputs.coverage = params_.coverage;
    const JobContext job = job_.stage(0.69, 0.7, "constraints");
    return stages_.run("constraints", stages_.constraints, inputs, job, [&] {
        return addConstraintViewpoints(*stages_.placed, inputs.must_see, params_,
                                       rooms ? &*stages_.rooms : nullptr, environment_,
                                       &stages_.cache.key_frame_visibility, job);
    });
}

PathEnds Pipeline::Stages::PlanRun::pathEnds() const {
    std::vector<double> weights = objectWeights(*stages_.scene, edits_.regions);
    const bool limited = clipFrames(params_.timing) > 0 || params_.timing.max_frames > 0 ||
                         params_.path.max_length_m > 0.0;
    if (environment_.corners && limited) {
        weighByCorners(*stages_.views, environment_.corners->textures(), positionPoints(), weights,
                       job_);
    }
    PathEnds ends{pointOfPin(*stages_.placed, edits_, edits_.start),
                  pointOfPin(*stages_.placed, edits_, edits_.end),
                  params_.constraints.loop,
                  pointWeights(positionPoints(), weights),
                  weights,
                  keepsFrameRate(params_.timing) ? 0 : mostVisits(params_)};
    // The same point for both ends is a loop, whatever the parameter says.
    ends.loop = ends.loop || (ends.start >= 0 && ends.start == ends.end);
    ends.chosen_by_tour = isChosenByTour(params_.path, positionPoints(), ends);
    return ends;
}

Status Pipeline::Stages::PlanRun::selectKeyFrames() {
    if (asksForTrackability(params_.gaze, params_.timing) && !environment_.heading.restricts()) {
        environment_.corners = &stages_.cache.corners(*stages_.views);
    }
    builder_.emplace(environment_, movementEnvironment(), viewpoints(), params_, job_);
    ends_ = pathEnds();
    const KeyFrameInputs inputs{stages_.pointsVersion(),
                                ends_.object_weights,
                                ends_.chosen_by_tour ? 0 : ends_.visits,
                                ends_.start,
                                ends_.end,
                                ends_.loop,
                                params_.coverage.objective};
    return stages_
        .run("key_frames", stages_.key_frames, inputs, job_.stage(0.7, 0.71, "key frames"),
             [&]() -> Result<std::vector<int>> {
                 std::vector<int> chosen = chooseKeyFrames(positionPoints(), ends_.object_weights,
                                                           params_.coverage.objective);
                 return ends_.chosen_by_tour ? chosen
                                             : withinBudget(chosen, positionPoints(), ends_);
             })
        .map([&] {
            ends_.rank.assign(positionPoints().size(), 0);
            for (std::size_t i = 0; i < stages_.key_frames->size(); ++i) {
                ends_.rank[(*stages_.key_frames)[i]] = static_cast<int>(i);
            }
            ends_.corner_distance_m = params_.smoothing.corner_distance_m;
            ends_.smooth_length_m = [this](const CameraPath& path) {
                const auto smooth = builder_->smooth(path);
                return smooth ? smooth->length_m : std::numeric_limits<double>::infinity();
            };
        });
}

Status Pipeline::Stages::PlanRun::growRoadmap() {
    const JobContext job = job_.stage(0.71, 0.75, "roadmap");
    return stages_.run(
        "roadmap", stages_.roadmap,
        RoadmapInputs{stages_.key_frames.version(), params_.roadmap, params_.seed}, job, [&] {
            return searchRoadmap(
                positionPoints(), *stages_.key_frames,
                targetSizes(*stages_.scene, viewpoints().observation_points, positionPoints()),
                movementEnvironment().sphere, params_.roadmap, params_.seed, job);
        });
}

Status Pipeline::Stages::PlanRun::linkRoadmap() {
    const JobContext job = job_.stage(0.75, 0.8, "linking");
    return stages_.run("linking", stages_.linking,
                       LinkingInputs{stages_.roadmap.version(), params_.linking, params_.seed}, job,
                       [&]() -> Result<Roadmap> {
                           Roadmap linked = *stages_.roadmap;
                           return linkGroups(linked, positionPoints(), *stages_.key_frames,
                                             *stages_.free_space, movementEnvironment().sphere,
                                             params_.linking, params_.seed, job)
                               .map([&] { return std::move(linked); });
                       });
}

Result<Paths> Pipeline::Stages::PlanRun::pathsWithin(double max_length_m, const PathEnds& ends,
                                                     const JobContext& job) {
    Paths found{*stages_.linking, {}};
    PathParams within = params_.path;
    within.max_length_m = max_length_m;
    return takePaths(found.roadmap, positionPoints(), movementEnvironment().sphere, within,
                     params_.roadmap, ends, job)
        .map([&](std::vector<CameraPath> paths) {
            found.paths = std::move(paths);
            return std::move(found);
        });
}

Result<Paths> Pipeline::Stages::PlanRun::pathsOfClip(const JobContext& job) {
    constexpr int kMostRounds = 5;
    PathEnds ends = ends_;
    const TimedPaths timed{
        [&](double max_length_m) { return pathsWithin(max_length_m, ends, job); },
        [&](const Paths& found) {
            return builder_->timeAtLimits(found.paths).map([](const Trajectory& trajectory) {
                return trajectory.frames.size();
            });
        }};
    std::optional<Paths> best;
    double best_worth = 0.0;
    // With trackability, searches again without the key frames among views of few corners, and
    // keeps the paths with the best trackable run.
    for (int round = 0; round < kMostRounds; ++round) {
        auto found = pathsWithinFrames(timed, params_.path.max_length_m,
                                       static_cast<std::size_t>(clipFrames(params_.timing)));
        if (!found) return tl::unexpected(std::move(found.error()));
        if (!*found) break;
        if (!environment_.corners) return std::move(**found);
        const auto trajectory = builder_->timeAtLimits((*found)->paths);
        if (!trajectory) return tl::unexpected(trajectory.error());
        const auto corners = estimateImageCorners(*stages_.views, environment_.corners->textures(),
                                                  *trajectory, job);
        if (!corners) return tl::unexpected(corners.error());
        // Length of the longest trackable run, times its share of all frames.
        const auto run = static_cast<double>(longestTrackableRun(*trajectory, *corners));
        const double worth =
            run * run / static_cast<double>(std::max<std::size_t>(1, corners->size()));
        if (!best || worth > best_worth) {
            best_worth = worth;
            best = std::move(**found);
        }
        const std::vector<int> bare = pointsAmongBareViews(*trajectory, *corners, positionPoints());
        const std::size_t known = ends.avoided.size();
        ends.avoided.insert(bare.begin(), bare.end());
        // The same search again: none are left, or the tour keeps them, because all of it fits.
        if (ends.avoided.size() == known) break;
    }
    if (!best) return tooShortClip(params_.timing);
    return std::move(*best);
}

Status Pipeline::Stages::PlanRun::findPaths() {
    const JobContext job = job_.stage(0.8, 0.84, "path");
    const bool clip = clipFrames(params_.timing) > 0;
    PathInputs inputs{stages_.linking.version(),
                      params_.path,
                      params_.roadmap,
                      ends_.object_weights,
                      ends_.start,
                      ends_.end,
                      ends_.loop,
                      ends_.visits};
    if (clip || params_.path.max_length_m > 0.0) inputs.smoothing = params_.smoothing;
    if (clip) {
        inputs.timing = params_.timing;
        inputs.gaze = params_.gaze;
    }
    inputs.body = params_.body;
    return stages_.run("path", stages_.paths, inputs, job, [&] {
        return clip ? pathsOfClip(job) : pathsWithin(params_.path.max_length_m, ends_, job);
    });
}

Status Pipeline::Stages::PlanRun::smoothPaths() {
    return stages_.run("smoothing", stages_.smoothing,
                       SmoothingInputs{stages_.paths.version(), params_.smoothing, params_.body},
                       job_.stage(0.84, 0.89, "smoothing"),
                       [&] { return builder_->smooth(stages_.paths->paths); });
}

Status Pipeline::Stages::PlanRun::addContextViews() {
    GazeInputs inputs{stages_.smoothing.version(), stages_.views.version(), params_.gaze};
    if (params_.gaze.view_mix > 0.0 || environment_.corners) inputs.timing = params_.timing;
    return stages_.run("gaze", stages_.gaze, inputs, job_.stage(0.89, 0.9, "gaze"),
                       [&]() -> Result<std::vector<SmoothPath>> {
                           return builder_->withContext(*stages_.smoothing);
                       });
}

Status Pipeline::Stages::PlanRun::timePaths() {
    return stages_.run(
        "timing", stages_.timing,
        TimingInputs{stages_.gaze.version(), params_.timing, params_.shake, params_.body},
        job_.stage(0.9, 0.91, "timing"),
        [&] { return builder_->time(*stages_.gaze, params_.timing); });
}

Status Pipeline::Stages::PlanRun::repairFrames() {
    const bool wanted = asksForRepair(params_.repair);
    const JobContext job = job_.stage(0.91, wanted ? 0.97 : 0.92, "repair");
    return stages_.run("repair", stages_.repair,
                       RepairInputs{stages_.timing.version(), stages_.views.version(),
                                    params_.repair, params_.seed},
                       job, [&]() -> Result<RepairedTrajectory> {
                           const RepairedTrajectory as_timed{
                               stages_.paths->paths, *stages_.gaze, *stages_.timing, {}};
                           if (!wanted) return as_timed;
                           return repairTrajectory(as_timed, builder_->maker(*stages_.smoothing),
                                                   movementEnvironment(), params_.repair,
                                                   params_.seed, job, &stages_.cache.frame_views);
                       });
}

Status Pipeline::Stages::PlanRun::takeMotion() {
    stages_.follows_motion = true;
    const bool has_keys = !edits_.motion->keys.empty();
    const MotionInputs inputs{edits_.motion,
                              has_keys ? params_.timing : TimingParams{},
                              stages_.region.version(),
                              stages_.views.version(),
                              stages_.pointsVersion(),
                              asksForTrackability(params_.gaze, params_.timing)};
    const JobContext job = job_.stage(0.7, 0.92, "motion");
    return stages_.run("motion", stages_.motion, inputs, job, [&] {
        MappedScene map;
        map.scene = stages_.scene;
        map.rays = stages_.rays.share();
        map.free_space = stages_.free_space.share();
        map.region = stages_.region.share();
        map.sphere = std::make_shared<const SweptSphere>(environment_.sphere);
        return followMotion(*edits_.motion, map, params_.timing, job);
    });
}

Status Pipeline::Stages::PlanRun::measure() {
    const MetricInputs inputs{stages_.madeVersion(), params_.repair};
    if (on_trajectory_ && !stages_.metrics.holds(inputs)) {
        on_trajectory_(std::make_shared<const Plan>(stages_.collectMoves()));
    }
    const JobContext job = job_.stage(0.92, 1.0, "metrics");
    return stages_.run("metrics", stages_.metrics, inputs, job, [&] { return measureFound(job); });
}

Result<Pipeline::Stages::Metrics> Pipeline::Stages::PlanRun::measureFound(const JobContext& job) {
    const Trajectory& trajectory = stages_.made().trajectory;
    auto estimate = estimateCaptures(*stages_.views, trajectory, job, &stages_.cache.frame_views);
    if (!estimate) return tl::unexpected(std::move(estimate.error()));
    FrameSeries series = measureFrames(
        trajectory, estimate->frame_views, estimate->captures,
        imageScores(trajectory, estimate->frame_boxes, params_.repair.score), *stages_.rays);
    RepairReport report = stages_.made().report;
    if (!asksForRepair(params_.repair)) {
        report.threshold = lowThreshold(series.score, params_.repair.score_threshold);
        report.before = report.after = tally(series.score, report.threshold);
    }
    if (asksForTrackability(params_.gaze, params_.timing)) {
        auto corners = estimateImageCorners(
            *stages_.views, stages_.cache.corners(*stages_.views).textures(), trajectory, job);
        if (!corners) return tl::unexpected(std::move(corners.error()));
        series.image_corners = std::move(*corners);
    }
    return measureTrajectory(*stages_.views, stages_.made().smooth_paths, trajectory,
                             movementEnvironment().sphere, *stages_.rays, job)
        .and_then([&](TrajectoryMetrics&& measured) {
            measured.trackable_rate = trackableRate(series.image_corners);
            return measureCoverages(job).map([&](Coverages&& shown) {
                return Metrics{std::move(*estimate), measured, std::move(shown), std::move(series),
                               report};
            });
        });
}

Result<Pipeline::Stages::Coverages> Pipeline::Stages::PlanRun::measureCoverages(
    const JobContext& job) const {
    if (!stages_.has_constraints) return Coverages{};
    const Trajectory& trajectory = stages_.made().trajectory;
    return measureCoverage(stages_.constraints->must_see, *stages_.views, trajectory, job)
        .and_then([&](std::vector<RegionCoverage>&& must_see) -> Result<Coverages> {
            if (!stages_.constraints->surface) return Coverages{std::move(must_see), {}};
            return measureSurface(*stages_.constraints->surface, *stages_.views, trajectory, job)
                .map([&](const SurfaceShare& surface) {
                    return Coverages{std::move(must_see), surface};
                });
        });
}

Status Pipeline::Stages::plan(const PlanParams& params, const PlanEdits& edits,
                              const JobContext& job, const OnTrajectory& on_trajectory) {
    PlanParams used = edits.motion ? paramsForMotion(params) : params;
    used.viewpoints.fill = usedFill(params);
    return PlanRun(*this, used, edits, job, on_trajectory).run();
}

}  // namespace dollytrack::planning
