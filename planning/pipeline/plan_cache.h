#pragma once

#include "engine/camera/camera_params.h"
#include "engine/document/edits.h"
#include "engine/geometry/ray_caster.h"
#include "planning/gaze/corner_panorama.h"
#include "planning/metrics/view_cache.h"
#include "planning/plan_params.h"
#include "planning/viewpoints/key_frames.h"
#include "planning/viewpoints/moved_objects.h"
#include "planning/viewpoints/viewpoint_search.h"

#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace dollytrack::planning {

class AllowedRegion;
class FreeSpace;
class ViewEstimator;

/// The current map; versions tell whether it has changed.
struct CurrentMap {
    unsigned free_space_version = 0;
    unsigned region_version = 0;
    std::shared_ptr<const FreeSpace> free_space;  // null before the first map
    std::shared_ptr<const AllowedRegion> region;
};

/// Inputs of a search other than the scene and its map.
struct SearchInputs {
    CameraParams camera;
    ViewpointParams viewpoints;
    PitchBand pitch;
    int seed = 0;
    std::vector<NoGoBox> no_go;
    FreeSpaceParams free_space;
    BodyParams body;
    bool operator==(const SearchInputs&) const = default;
};

/// Caches that runs leave to later ones beyond the stages' outputs: searches, estimates by pose,
/// and parts of the ray structure. If objects only moved, it drops what the moves may affect; a run
/// that uses the rest gives exactly the plan made from scratch. Runs may be cancelled at any time.
class PlanCache {
  public:
    /// Valid after refreshSearches() (`searches`) or refreshViews() (`key_frame_visibility`,
    /// `frame_views`).
    SearchCache searches;
    VisibilityCache key_frame_visibility;
    ViewCache frame_views;

    /// Corner panoramas for `views`, which must be those last given to refreshViews(). The
    /// reference is valid until refreshViews() is called with other views.
    [[nodiscard]] CornerPanoramas& corners(const ViewEstimator& views);

    /// Records a new scene with the same objects, of which `moved` (ids, ascending; may be empty)
    /// changed their pose. `rays` and `map` are those of the scene before.
    void noteMoves(const Scene& before, const Scene& now, const std::vector<int>& moved,
                   std::shared_ptr<const RayCaster> rays, const CurrentMap& map);

    /// The ray structure of the scene; objects that did not move share the earlier one's.
    [[nodiscard]] RayCaster cast(const Scene& scene);

    /// The objects (ids, ascending) that moved since the last call, that is since the surface map
    /// or the free space was last built. Clears the list.
    [[nodiscard]] std::vector<int> takeMovedSinceSurfaces() {
        return std::exchange(moved_since_surfaces_, {});
    }
    [[nodiscard]] std::vector<int> takeMovedSinceFreeSpace() {
        return std::exchange(moved_since_free_space_, {});
    }

    /// Drops searches that are not valid for this map or these inputs.
    void refreshSearches(const CurrentMap& map, const SearchInputs& inputs);

    /// Drops cached views that are not valid for the current views.
    void refreshViews(unsigned views_version, const CameraParams& camera,
                      const ViewEstimator& views);

  private:
    std::pair<unsigned, unsigned> searched_in_;  // versions of free space and region
    std::optional<SearchInputs> searched_with_;
    unsigned views_version_ = 0;  // of the views that the cached ones were made with
    std::optional<CameraParams> views_camera_;
    std::unique_ptr<CornerPanoramas> corners_;  // null: not asked for since the views changed

    // Objects moved since the ray structure was built, and that structure.
    std::vector<int> moved_since_cast_;  // ids, ascending
    std::shared_ptr<const RayCaster> rays_before_;

    // Objects moved since the maps were built. If a build was cancelled, there is no earlier map to
    // update.
    std::vector<int> moved_since_surfaces_;  // ids, ascending
    std::vector<int> moved_since_free_space_;

    // Objects moved since searches and views were made, and the map at that time.
    MovedObjects moved_since_searched_;
    MovedObjects moved_since_views_;
    std::shared_ptr<const FreeSpace> map_searched_;  // only while something has moved
    std::shared_ptr<const AllowedRegion> region_searched_;
};

}  // namespace dollytrack::planning
