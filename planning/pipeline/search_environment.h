#pragma once

#include "planning/collision/swept_sphere.h"
#include "planning/viewpoints/viewpoint_search.h"
#include "planning/visibility/view_estimator.h"

#include <memory>

namespace dollytrack::planning {

class AllowedRegion;
class FreeSpace;
class Pipeline;
struct PlanParams;

/// The maps of a planned scene. None is null.
struct SceneMaps {
    std::shared_ptr<const Scene> scene;
    std::shared_ptr<const RayCaster> rays;
    std::shared_ptr<const FreeSpace> free_space;
    std::shared_ptr<const AllowedRegion> region;
};

/// The maps of a pipeline's last run for this scene, which must have got to the allowed region.
[[nodiscard]] SceneMaps mapsOf(const Pipeline& pipeline, std::shared_ptr<const Scene> scene);

/// The PlanningEnvironment of searches in a planned scene that are no stages of the pipeline. Owns
/// or shares what the environment refers to. Immutable.
class SearchEnvironment {
  public:
    /// @param params  those that the scene was mapped with
    SearchEnvironment(SceneMaps maps, const PlanParams& params);
    SearchEnvironment(const SearchEnvironment&) = delete;
    SearchEnvironment& operator=(const SearchEnvironment&) = delete;

    /// Valid as long as this object.
    [[nodiscard]] const PlanningEnvironment& environment() const { return environment_; }

  private:
    SceneMaps maps_;
    ViewEstimator views_;
    SweptSphere sphere_;
    PlanningEnvironment environment_;
};

}  // namespace dollytrack::planning
