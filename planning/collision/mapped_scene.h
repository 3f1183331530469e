#pragma once

#include "engine/document/edits.h"
#include "engine/scene/scene.h"

#include <memory>

namespace dollytrack {
class RayCaster;
}

namespace dollytrack::planning {

class AllowedRegion;
class FreeSpace;
class SweptSphere;
class TextureCorners;
class ViewEstimator;

/// Shared input of all planners, Dollytrack's own included: one scene, its free space map and one
/// camera. Immutable.
struct MappedScene {
    std::shared_ptr<const Scene> scene;
    PlanEdits edits;  // with object ids of this scene
    std::shared_ptr<const RayCaster> rays;
    std::shared_ptr<const FreeSpace> free_space;
    std::shared_ptr<const AllowedRegion> region;
    std::shared_ptr<const SweptSphere> sphere;
    std::shared_ptr<const ViewEstimator> views;
    std::shared_ptr<const TextureCorners> texture_corners;
};

}  // namespace dollytrack::planning
