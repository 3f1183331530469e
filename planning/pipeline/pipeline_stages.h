#pragma once

#include "engine/geometry/ray_caster.h"
#include "planning/collision/allowed_region.h"
#include "planning/explanations/capture_ledger.h"
#include "planning/free_space/free_space.h"
#include "planning/free_space/surface_map.h"
#include "planning/metrics/estimate_captures.h"
#include "planning/path/time_budget.h"
#include "planning/pipeline/pipeline.h"
#include "planning/pipeline/plan_cache.h"
#include "planning/pipeline/stage.h"
#include "planning/repair/repair.h"
#include "planning/rooms/room_plan.h"
#include "planning/viewpoints/constraint_viewpoints.h"
#include "planning/viewpoints/hand_placed.h"
#include "planning/viewpoints/viewpoint_search.h"
#include "planning/visibility/view_estimator.h"

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace dollytrack::planning {

/// The stages of a pipeline, with the inputs and output of each. Internal to pipeline.cpp and
/// pipeline_stages.cpp.
struct Pipeline::Stages {
    using V = unsigned;  // version of an earlier stage's output

    /// What the frames show of must-see regions and, if the objective includes it, of all surface.
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
    V scene_version = 0;
    V geometry_version = 0;
    Stage<std::tuple<V>, RayCaster> rays;
    Stage<std::tuple<V, double>, SurfaceMap> surfaces;
    Stage<std::tuple<unsigned, double>, FreeSpace> free_space;
    Stage<std::tuple<V, std::vector<int>, std::vector<NoGoBox>, double, double, BodyParams>,
          AllowedRegion>
        region;
    Stage<std::tuple<V, CameraParams>, ViewEstimator> views;
    Stage<std::tuple<V, TargetParams, ViewpointParams>, std::vector<ObservationPoint>> targets;
    Stage<std::tuple<V, V, V, ViewpointParams, PitchBand, int>, Viewpoints> found;
    Stage<std::tuple<V, V, PitchBand, std::vector<PinnedPoint>, std::vector<RemovedPoint>>,
          PlacedPoints>
        placed;
    Stage<std::tuple<V, std::vector<int>>, RoomPlan> rooms;
    Stage<std::tuple<V, V, std::vector<Region>, Anchors, RoomTours, GazeParams, int, int,
                     CoverageParams>,
          ConstraintViewpoints>
        asked;
    Stage<std::tuple<V, std::vector<Region>, int, int, int, bool, Objective>, std::vector<int>>
        key_frames;
    Stage<std::tuple<V, RoadmapParams, int>, Roadmap> roadmap;
    Stage<std::tuple<V, LinkParams, int>, Roadmap> linking;
    Stage<std::tuple<V, PathParams, RoadmapParams, std::vector<Region>, int, int, bool, int,
                     SmoothingParams, TimingParams, BodyParams>,
          Paths>
        paths;
    Stage<std::tuple<V, SmoothingParams, BodyParams>, std::vector<SmoothPath>> smoothing;
    Stage<std::tuple<V, V, GazeParams, TimingParams>, std::vector<SmoothPath>> gaze;
    Stage<std::tuple<V, TimingParams, ShakeParams, BodyParams>, Trajectory> timing;
    Stage<std::tuple<V, V, RepairParams, int>, Repaired> repair;
    Stage<std::tuple<V, RepairParams>, Metrics> metrics;

    // Whether the last run needed constraint viewpoints, so that `asked` is valid.
    bool asks = false;
    [[nodiscard]] const PlacedPoints& points() const { return asks ? asked->placed : *placed; }
    /// Version of points(); differs whenever the points do.
    [[nodiscard]] V pointsVersion() const {
        return asks ? 2 * asked.version() + 1 : 2 * placed.version();
    }

    PlanCache memory;
    std::vector<StageTime> times;
    LeftOutFor left_out_for;  // reasons for the last run's parameters

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
    [[nodiscard]] MapInUse mapped() const {
        return {free_space.version(), region.version(), free_space.share(), region.share()};
    }

    Status map(const PlanParams& params, const PlanEdits& edits, const JobContext& job);
    Status plan(const PlanParams& params, const PlanEdits& edits, const JobContext& job,
                const OnTrajectory& on_trajectory);
    [[nodiscard]] Result<Coverages> measureCoverages(const Trajectory& trajectory,
                                                     const JobContext& job) const;
    [[nodiscard]] Plan collectMoves() const;
    [[nodiscard]] Plan collect(const PlanEdits& edits) const;
};

}  // namespace dollytrack::planning
