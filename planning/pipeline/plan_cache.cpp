#include "planning/pipeline/plan_cache.h"

#include "engine/scene/move_object.h"
#include "planning/collision/allowed_region.h"
#include "planning/free_space/free_space.h"

#include <algorithm>
#include <iterator>

namespace dollytrack::planning {
namespace {

/// An object that is a target only now has no cached views.
bool haveSameRoles(const Scene& a, const Scene& b) {
    return std::ranges::equal(a.objects, b.objects, {}, &Object::role, &Object::role);
}

}  // namespace

void PlanCache::noteMoves(const Scene& before, const Scene& now, const std::vector<int>& moved,
                          std::shared_ptr<const RayCaster> rays, const CurrentMap& map) {
    if (!haveSameRoles(before, now)) views_camera_.reset();
    if (moved.empty()) return;
    std::vector<Eigen::AlignedBox3d> boxes;
    for (const int id : moved) {
        boxes.push_back(cornerBox(before, id));
        boxes.push_back(cornerBox(now, id));
    }
    if (!map_searched_ && searched_in_ == std::pair(map.free_space_version, map.region_version)) {
        map_searched_ = map.free_space;
        region_searched_ = map.region;
    }
    if (!rays_before_) rays_before_ = std::move(rays);
    for (std::vector<int>* since :
         {&moved_since_cast_, &moved_since_surfaces_, &moved_since_free_space_}) {
        std::vector<int> all;
        std::ranges::set_union(*since, moved, std::back_inserter(all));
        since->swap(all);
    }
    moved_since_searched_.add(moved, boxes);
    moved_since_views_.add(moved, boxes);
}

RayCaster PlanCache::cast(const Scene& scene) {
    RayCaster made =
        rays_before_ ? RayCaster(scene, *rays_before_, moved_since_cast_) : RayCaster(scene);
    rays_before_.reset();
    moved_since_cast_.clear();
    return made;
}

void PlanCache::refreshSearches(const CurrentMap& map, const SearchInputs& inputs) {
    const std::pair in(map.free_space_version, map.region_version);
    const bool same_inputs = searched_with_ == inputs;
    if (searched_in_ != in || !same_inputs) {
        // A height band depends on the floors, which may have moved; in a scan the whole image
        // counts, not only the space in front of the target.
        if (!same_inputs || !map_searched_ || map.region->hasBand() ||
            map.free_space->scannedShare().has_value()) {
            searches.clear();
        } else {
            searches.forget(moved_since_searched_,
                            MapChange(*map_searched_, region_searched_.get(), *map.free_space,
                                      map.region.get()),
                            inputs.camera.camera_radius_m);
        }
    }
    searched_in_ = in;
    searched_with_ = inputs;
    map_searched_.reset();
    region_searched_.reset();
    moved_since_searched_.clear();
}

void PlanCache::refreshViews(unsigned views_version, const CameraParams& camera,
                             const ViewEstimator& views) {
    if (views_version_ != views_version) {
        corners_.reset();
        if (views_camera_ != camera || moved_since_views_.empty()) {
            key_frame_visibility.clear();
            frame_views.clear();
        } else {
            key_frame_visibility.forget(moved_since_views_, views);
            frame_views.forget(moved_since_views_, views);
        }
    }
    views_version_ = views_version;
    views_camera_ = camera;
    moved_since_views_.clear();
}

CornerPanoramas& PlanCache::corners(const ViewEstimator& views) {
    if (!corners_) corners_ = std::make_unique<CornerPanoramas>(views);
    return *corners_;
}

}  // namespace dollytrack::planning
