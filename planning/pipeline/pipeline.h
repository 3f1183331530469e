#pragma once

#include "engine/core/result.h"
#include "engine/document/edits.h"
#include "engine/jobs/job.h"
#include "engine/plan/plan.h"
#include "planning/plan_params.h"

#include <functional>
#include <memory>

namespace dollytrack {
class RayCaster;
}

namespace dollytrack::planning {

class AllowedRegion;
class FreeSpace;

/// The whole method as a chain of stages: free space, targets, viewpoints, manual edits,
/// constraints, key frames, roadmap, linking, path, smoothing, gaze, timing, repair, metrics.
/// Caches the output of each stage; a later run repeats only the stages whose parameters or input
/// have changed.
class Pipeline {
  public:
    using OnTrajectory = std::function<void(std::shared_ptr<const Plan>)>;

    explicit Pipeline(std::shared_ptr<const Scene> scene);
    ~Pipeline();
    Pipeline(Pipeline&&) noexcept;
    Pipeline& operator=(Pipeline&&) noexcept;

    /// Replaces the scene. If `same_geometry` (see sameGeometry(): only roles, classes, fronts and
    /// sizes may differ), ray structures and free space are kept, and searches are repeated only
    /// for observation points that change. If objects only moved (see movedObjects()), the map is
    /// updated, and searches and estimates that the moves cannot affect are kept. Otherwise
    /// everything is cleared. The plan equals one made from scratch.
    void setScene(std::shared_ptr<const Scene> scene, bool same_geometry);

    /// Plans with these parameters and edits. A given motion in the edits is the trajectory; only
    /// its metrics are computed, and parameters that paramsForMotion() resets do not apply. Edits
    /// refer to objects by their ids in this scene (findObjects() updates them). A scene without
    /// capturable targets gives an empty trajectory. `on_trajectory` is called before the metrics
    /// are measured, unless they are cached, with a plan that is complete up to its trajectory.
    /// Errors: Cancelled; Usage if parameters contradict each other; BadInput if the scene has no
    /// room for the camera; Failed if a clip or budget of frames is too small.
    Result<std::shared_ptr<const Plan>> run(const PlanParams& params, const PlanEdits& edits,
                                            const JobContext& job,
                                            const OnTrajectory& on_trajectory = {});
    Result<std::shared_ptr<const Plan>> run(const PlanParams& params, const JobContext& job) {
        return run(params, {}, job);
    }

    /// Free space of the last run; null if none got that far.
    [[nodiscard]] std::shared_ptr<const FreeSpace> freeSpace() const;
    [[nodiscard]] std::shared_ptr<const RayCaster> rays() const;
    /// Allowed region of the last run (no-go boxes, height band); null if none got that far.
    [[nodiscard]] std::shared_ptr<const AllowedRegion> region() const;

  private:
    struct Stages;
    std::unique_ptr<Stages> stages_;
};

}  // namespace dollytrack::planning
