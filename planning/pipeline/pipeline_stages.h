#pragma once

#include "engine/geometry/ray_caster.h"
#include "planning/collision/allowed_region.h"
#include "planning/constraints/constraint_viewpoints.h"
#include "planning/explanations/capture_ledger.h"
#include "planning/free_space/free_space.h"
#include "planning/free_space/surface_map.h"
#include "planning/metrics/estimate_captures.h"
#include "planning/path/time_budget.h"
#include "planning/pipeline/follow_motion.h"
#include "planning/pipeline/pipeline.h"
#include "planning/pipeline/plan_cache.h"
#include "planning/pipeline/stage.h"
#include "planning/pipeline/stage_inputs.h"
#include "planning/repair/repair.h"
#include "planning/rooms/room_plan.h"
#include "planning/viewpoints/hand_placed.h"
#include "planning/viewpoints/viewpoint_search.h"
#include "planning/visibility/view_estimator.h"

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dollytrack::planning {

/// Classes of the structure objects; other classes do not affect where the camera may be.
std::vector<int> structureClasses(const Scene& scene);

/// The stages of a pipeline, with the inputs and output of each. Internal to this folder.
struct Pipeline::Stages {
    /// Coverage by the frames: of must-see regions and, if the objective includes it, of all
    /// surface.
    struct Coverages {
        std::vector<RegionCoverage> must_see;
        std::optional<SurfaceShare> surface;
    };
    struct Metrics {
        CaptureEstimate estimate;
        TrajectoryMetrics trajectory;
        Coverages shown;
        FrameSeries series;
        RepairReport repair;
    };

    std::shared_ptr<const Scene> scene;
    StageVersion scene_version = 0;
    StageVersion geometry_version = 0;
    Stage<RayInputs, RayCaster> rays;
    Stage<SurfaceInputs, SurfaceMap> surfaces;
    Stage<FreeSpaceInputs, FreeSpace> free_space;
    Stage<RegionInputs, AllowedRegion> region;
    Stage<ViewInputs, ViewEstimator> views;
    Stage<TargetInputs, std::vector<ObservationPoint>> targets;
    Stage<ViewpointInputs, Viewpoints> found;
    Stage<PlacedInputs, PlacedPoints> placed;
    Stage<RoomInputs, RoomPlan> rooms;
    Stage<ConstraintInputs, ConstraintViewpoints> constraints;
    Stage<KeyFrameInputs, std::vector<int>> key_frames;
    Stage<RoadmapInputs, Roadmap> roadmap;
    Stage<LinkingInputs, Roadmap> linking;
    Stage<PathInputs, Paths> paths;
    Stage<SmoothingInputs, std::vector<SmoothPath>> smoothing;
    Stage<GazeInputs, std::vector<SmoothPath>> gaze;
    Stage<TimingInputs, Trajectory> timing;
    Stage<RepairInputs, RepairedTrajectory> repair;
    Stage<MotionInputs, FollowedMotion> motion;  // instead of the stages from key frames on
    Stage<MetricInputs, Metrics> metrics;

    // Whether the last run needed constraint viewpoints, so that `constraints` is valid.
    bool has_constraints = false;
    [[nodiscard]] const PlacedPoints& points() const {
        return has_constraints ? constraints->placed : *placed;
    }
    /// Version of points(); differs whenever the points do.
    [[nodiscard]] StageVersion pointsVersion() const {
        return has_constraints ? 2 * constraints.version() + 1 : 2 * placed.version();
    }

    // Whether the last run had a given motion, so that `motion` is valid and the stages from key
    // frames to repair are not.
    bool follows_motion = false;
    [[nodiscard]] const RepairedTrajectory& made() const {
        return follows_motion ? motion->made : *repair;
    }
    /// Version of made(); differs whenever the trajectory or what it is measured by does.
    [[nodiscard]] StageVersion madeVersion() const {
        return follows_motion ? 2 * motion.version() + 1 : 2 * repair.version();
    }

    PlanCache cache;
    std::vector<StageTime> times;
    ExclusionReasons exclusion_reasons;  // reasons for the last run's parameters

    /// Runs and times one stage. Error: Cancelled if the job was cancelled before it, or the
    /// stage's own.
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

    /// The map of the last run.
    [[nodiscard]] CurrentMap mapped() const {
        return {free_space.version(), region.version(), free_space.share(), region.share()};
    }

    /// The stages from rays to views.
    Status map(const PlanParams& params, const PlanEdits& edits, const JobContext& job);
    /// The stages from targets to metrics, after map().
    Status plan(const PlanParams& params, const PlanEdits& edits, const JobContext& job,
                const OnTrajectory& on_trajectory);
    class PlanRun;  // plan_run.cpp: one run of plan()
    [[nodiscard]] Plan collectMoves() const;
    [[nodiscard]] Plan collect(const PlanEdits& edits) const;
};

}  // namespace dollytrack::planning
