#pragma once

#include "engine/core/result.h"
#include "engine/document/object_trace.h"
#include "engine/document/project_state.h"
#include "engine/jobs/background_worker.h"
#include "engine/plan/plan.h"
#include "planning/plan_params.h"

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack {
class RayCaster;
namespace planning {
class AllowedRegion;
class FreeSpace;
}  // namespace planning
}  // namespace dollytrack

namespace dollytrack::editor {

/// A planning request. A newer request replaces older ones.
struct PlanRequest {
    std::shared_ptr<const Scene> imported;
    std::shared_ptr<const ProjectState> state;
    std::uint64_t serial = 0;  // set by the caller to identify the outcome
};

/// The outcome of a request. The scene is set without a plan while a newly imported scene is being
/// planned, and possibly after an error.
struct PlanOutcome {
    std::uint64_t serial = 0;
    std::shared_ptr<const ProjectState> state;
    std::shared_ptr<const Scene> scene;          // with the state's edits applied
    std::shared_ptr<const ObjectTrace> objects;  // its objects, traced to the imported ones
    std::uint64_t geometry = 0;                  // equal: same triangles in same objects
    std::uint64_t objects_since = 0;             // since this geometry, objects have only moved
    std::shared_ptr<const RayCaster> rays;
    std::shared_ptr<const planning::FreeSpace> free_space;
    std::shared_ptr<const planning::AllowedRegion> region;
    std::shared_ptr<const Plan> plan;  // null before the first plan and after an error
    planning::PlanParams params;
    PlanEdits edits;        // plan edits with object ids of this scene
    bool measured = false;  // false: the trajectory is set, its metrics are still missing
    double milliseconds = 0.0;
    std::optional<Error> error;
    bool outdated = false;              // the newest request was refused; the plan is older
    std::vector<std::string> warnings;  // edits that do not fit the scene

    /// Whether an image of that geometry number shows the same objects, perhaps at other positions.
    [[nodiscard]] bool hasObjectsOf(std::uint64_t other_geometry) const {
        return other_geometry >= objects_since && other_geometry <= geometry;
    }
};

/// Plans in the background and reuses results of earlier plans of the scene, so that a change costs
/// only what depends on it. If requests keep arriving, an outdated run continues until its
/// trajectory is ready, for at most about a second, so that a drag shows intermediate plans.
class LivePlanner {
  public:
    explicit LivePlanner(std::function<void()> wake,
                         BackgroundWorker::Clock clock = std::chrono::steady_clock::now);
    ~LivePlanner();

    void start(PlanRequest request);
    void cancel() { worker_.cancel(); }
    /// The newest outcome since the last call.
    [[nodiscard]] std::optional<PlanOutcome> poll() { return outcomes_->take(); }
    [[nodiscard]] BackgroundWorker::State state() const { return worker_.state(); }

  private:
    struct WorkerState;
    std::shared_ptr<LatestValue<PlanOutcome>> outcomes_;
    std::shared_ptr<WorkerState> worker_state_;  // data that the worker keeps between runs
    std::function<void()> wake_;
    BackgroundWorker worker_;  // last member: stops before the others are destroyed
};

}  // namespace dollytrack::editor
