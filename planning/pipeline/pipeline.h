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

/// The whole method as a chain of stages: free space, targets, viewpoints, what was placed by hand,
/// key frames, roadmap, linking, path, smoothing, timing, repair, metrics. Keeps what each stage
/// made; a later run repeats only the stages whose parameters, or whose input, have changed.
class Pipeline {
  public:
    using OnTrajectory = std::function<void(std::shared_ptr<const Plan>)>;

    explicit Pipeline(std::shared_ptr<const Scene> scene);
    ~Pipeline();
    Pipeline(Pipeline&&) noexcept;
    Pipeline& operator=(Pipeline&&) noexcept;

    /// Plans another scene from now on. When it has the same triangles in the same objects and
    /// places (sameGeometry()), and so differs in roles, classes, fronts and sizes only, ray
    /// structures and free space are kept, and searches repeated only for observation points that
    /// change. When objects have moved (movedObjects()), the map is made anew, and what was
    /// searched and looked at is kept where they cannot have been met. The plan is the one from
    /// scratch.
    void setScene(std::shared_ptr<const Scene> scene, bool same_geometry);

    /// The edits name objects by their numbers in this scene (findObjects() brings them up to
    /// date). Errors: Cancelled; Usage when parameters contradict each other; BadInput when the
    /// scene has no room for the camera. A scene without targets, or of which nothing can be
    /// captured, gives an empty trajectory.
    /// `on_trajectory` is called from within, with the plan as far as its timed trajectory, before
    /// the metrics are measured, when they have to be: a picture can follow sooner.
    Result<std::shared_ptr<const Plan>> run(const PlanParams& params, const PlanEdits& edits,
                                            const JobContext& job,
                                            const OnTrajectory& on_trajectory = {});
    Result<std::shared_ptr<const Plan>> run(const PlanParams& params, const JobContext& job) {
        return run(params, {}, job);
    }

    /// Free space of the last run, or null before one came that far.
    [[nodiscard]] std::shared_ptr<const FreeSpace> freeSpace() const;
    [[nodiscard]] std::shared_ptr<const RayCaster> rays() const;
    /// What the edits and the height band allow, as of the last run.
    [[nodiscard]] std::shared_ptr<const AllowedRegion> region() const;

  private:
    struct Stages;
    std::unique_ptr<Stages> stages_;
};

}  // namespace dollytrack::planning
