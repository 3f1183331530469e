#pragma once

#include "engine/camera/camera_params.h"
#include "engine/document/edits.h"
#include "engine/geometry/ray_caster.h"
#include "planning/metrics/view_memo.h"
#include "planning/plan_params.h"
#include "planning/viewpoints/key_frames.h"
#include "planning/viewpoints/moved_things.h"
#include "planning/viewpoints/viewpoint_search.h"

#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace dollytrack::planning {

class AllowedRegion;
class FreeSpace;
class ViewEstimator;

/// The map as stages have it: versions tell whether it is still the same.
struct MapInUse {
    unsigned free_space_version = 0;
    unsigned region_version = 0;
    std::shared_ptr<const FreeSpace> free_space;  // null before there is one
    std::shared_ptr<const AllowedRegion> region;
};

/// What a search depends on beside the scene and its map.
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

/// What runs leave to later ones beyond the stages' outputs: searches, what poses show, parts of
/// the ray structure. Where things have only moved it forgets what they may have touched, and a run
/// that uses the rest plans exactly as one from scratch. Runs may be cancelled in between.
class RunMemory {
  public:
    /// Those that hold, after the call below that is named like them.
    SearchMemo searches;
    ShownMemo shown;
    ViewMemo seen;

    /// Takes a scene of the same objects, of which those named (rising) stand elsewhere, or none
    /// do; `rays` and `map` are those of the scene before.
    void noteMoves(const Scene& before, const Scene& now, const std::vector<int>& moved,
                   std::shared_ptr<const RayCaster> rays, const MapInUse& map);

    /// The scene's ray structure, with what has not moved shared.
    [[nodiscard]] RayCaster cast(const Scene& scene);

    /// The objects (ids, rising) that have moved since the last call: since there was the map of
    /// surfaces, or of free space, that is to be made anew.
    [[nodiscard]] std::vector<int> takeMovedSinceSurfaces() {
        return std::exchange(moved_since_surfaces_, {});
    }
    [[nodiscard]] std::vector<int> takeMovedSinceFreeSpace() {
        return std::exchange(moved_since_free_space_, {});
    }

    /// Forgets searches that do not hold in this map or with these inputs.
    void refreshSearches(const MapInUse& map, const SearchInputs& inputs);

    /// Forgets what may show otherwise in the views of now.
    void refreshShown(unsigned views_version, const CameraParams& camera,
                      const ViewEstimator& views);

  private:
    std::pair<unsigned, unsigned> searched_in_;  // versions of map and region
    std::optional<SearchInputs> searched_with_;
    unsigned shown_in_ = 0;  // version of the views
    std::optional<CameraParams> shown_with_;

    // What has moved since the ray structure was made, and that.
    std::vector<int> moved_since_cast_;  // rising
    std::shared_ptr<const RayCaster> rays_before_;

    // What has moved since the maps were made, whether or not that came to an end: then there is
    // none to go on from.
    std::vector<int> moved_since_surfaces_;  // rising
    std::vector<int> moved_since_free_space_;

    // What has moved since searches and views were made, and the map of then.
    MovedThings moved_since_searched_;
    MovedThings moved_since_shown_;
    std::shared_ptr<const FreeSpace> map_searched_;  // only while something has moved
    std::shared_ptr<const AllowedRegion> region_searched_;
};

}  // namespace dollytrack::planning
