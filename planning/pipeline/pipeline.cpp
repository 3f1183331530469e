#include "planning/pipeline/pipeline.h"

#include "engine/scene/move_object.h"
#include "planning/path/frame_budget.h"
#include "planning/pipeline/pipeline_stages.h"
#include "planning/timing/clip.h"

#include <fmt/format.h>

#include <optional>

namespace dollytrack::planning {
namespace {

/// The reason for key frames that are not on the path, as a phrase.
std::string leftOutOfPathFor(const PlanParams& params) {
    if (params.path.path_mode == PathMode::LongestBranch) {
        return "because path_mode=longest_branch follows only one branch of the tree";
    }
    if (params.timing.duration_s > 0.0) {
        return fmt::format("to keep within duration_s={:g}", params.timing.duration_s);
    }
    if (clipFrames(params.timing) > 0) {
        return fmt::format("to keep within max_frames={} at a fixed frame rate",
                           params.timing.max_frames);
    }
    if (params.path.max_length_m <= 0.0) return "because no collision-free path to it was found";
    return params.timing.max_frames > 0
               ? fmt::format("to keep within max_length_m={:g} with max_frames={}",
                             params.path.max_length_m, params.timing.max_frames)
               : fmt::format("to keep within max_length_m={:g}", params.path.max_length_m);
}

/// The reason for position points that are no key frames, as a phrase.
std::string notChosenFor(const PlanParams& params) {
    return params.coverage.objective == Objective::Surface
               ? "because objective=surface chooses key frames for surface alone"
               : ExclusionReasons{}.key_frames;
}

}  // namespace

Plan Pipeline::Stages::collectMoves() const {
    Plan plan;
    for (const Room& room : free_space->rooms()) plan.rooms.push_back(room.box);
    plan.scanned_share = free_space->scannedShare();
    plan.observation_points = points().viewpoints.observation_points;
    plan.searches = points().viewpoints.searches;
    plan.position_points = points().viewpoints.position_points;
    if (!follows_motion) plan.key_frames = *key_frames;
    if (!follows_motion) plan.roadmap = paths->roadmap;
    plan.paths = made().paths;
    plan.smooth_paths = made().smooth_paths;
    plan.trajectory = made().trajectory;
    plan.given_motion = follows_motion;
    if (follows_motion) plan.passed_keys = motion->keys;
    if (has_constraints) plan.tour_rooms = constraints->tour_rooms;
    if (has_constraints) plan.anchors = countAnchors(*constraints, plan.smooth_paths);
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
    plan.must_see = metrics->shown.must_see;
    plan.surface = metrics->shown.surface;
    if (!follows_motion) refusePinsOverBudget(edits, plan);
    plan.ledger = captureLedger(*scene, plan, exclusion_reasons);
    return plan;
}

void Pipeline::setScene(std::shared_ptr<const Scene> scene, bool same_geometry) {
    const Scene& before = *stages_->scene;
    const auto moved =
        same_geometry ? std::optional(std::vector<int>{}) : movedObjects(before, *scene);
    if (!moved) {
        stages_ = std::make_unique<Stages>();
    } else {
        stages_->cache.noteMoves(before, *scene, *moved, stages_->rays.share(), stages_->mapped());
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
    if (Status status = validate(params); !status) {
        return tl::unexpected(std::move(status.error()));
    }
    if (!edits.motion && params.constraints.loop && !edits.end.empty() &&
        edits.end != edits.start) {
        return fail(ErrorCode::Usage,
                    "A loop ends where it starts; remove the end point, or set loop=false.",
                    "loop");
    }
    if (Status status = edits.motion ? Status() : validateClip(params); !status) {
        return tl::unexpected(std::move(status.error()));
    }
    stages_->times.clear();
    stages_->exclusion_reasons = {leftOutOfPathFor(params), notChosenFor(params),
                                  static_cast<bool>(edits.motion)};
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
