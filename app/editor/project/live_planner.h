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
class FreeSpace;
}
}  // namespace dollytrack

namespace dollytrack::editor {

/// What is to be planned. The newest request wins.
struct PlanRequest {
    std::shared_ptr<const Scene> imported;
    std::shared_ptr<const ProjectState> state;
    std::uint64_t serial = 0;  // the caller's, to tell outcomes apart
};

/// What came of it. After an error the scene may still be there, without a plan.
struct PlanOutcome {
    std::uint64_t serial = 0;
    std::shared_ptr<const ProjectState> state;
    std::shared_ptr<const Scene> scene;          // with the state's edits
    std::shared_ptr<const ObjectTrace> objects;  // of that scene, by the imported one
    std::uint64_t geometry = 0;                  // equal numbers: equal triangles in equal objects
    std::uint64_t objects_since = 0;             // since that geometry objects have only moved
    std::shared_ptr<const RayCaster> rays;
    std::shared_ptr<const planning::FreeSpace> free_space;
    std::shared_ptr<const Plan> plan;  // null after an error
    planning::PlanParams params;
    PlanEdits edits;        // of the plan, with the numbers that objects have in this scene
    bool measured = false;  // false: the trajectory is there, its metrics are still to come
    double milliseconds = 0.0;
    std::optional<Error> error;
    bool outdated = false;              // the plan is of an earlier request: the newest was refused
    std::vector<std::string> warnings;  // edits that no longer fit the scene

    /// Whether a picture of that geometry shows the same objects, if perhaps elsewhere.
    [[nodiscard]] bool hasObjectsOf(std::uint64_t other_geometry) const {
        return other_geometry >= objects_since && other_geometry <= geometry;
    }
};

/// Plans in the background, keeping what earlier plans of the same scene made, so that a change
/// costs only what depends on it. While requests keep coming, a run that is outdated goes on until
/// its trajectory is there, but for about a second at the most: so a drag shows plans on its way.
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
    struct Desk;
    std::shared_ptr<Outbox<PlanOutcome>> outcomes_;
    std::shared_ptr<Desk> desk_;  // what the worker keeps between runs
    std::function<void()> wake_;
    BackgroundWorker worker_;  // last: it stops before what it uses goes
};

}  // namespace dollytrack::editor
