#include "planning/metrics/view_cache.h"

#include "engine/math/pose_key.h"
#include "planning/viewpoints/moved_objects.h"
#include "planning/visibility/image_boxes.h"
#include "planning/visibility/view_estimator.h"

#include <algorithm>
#include <utility>

namespace dollytrack::planning {
void ViewCache::begin() {
    ++now_;
    const unsigned kept = entries_.size() > kMany ? 1 : kKept;
    std::erase_if(entries_, [&](const auto& entry) { return entry.second.used + kept < now_; });
}

void ViewCache::forget(const MovedObjects& moved, const ViewEstimator& now) {
    std::erase_if(entries_, [&](const auto& entry) {
        const Pose pose = poseOf(entry.first);
        return std::ranges::any_of(entry.second.coarse,
                                   [&](const CoarseEstimate& one) {
                                       const int id = one.view.object_id;
                                       return moved.isOne(id) ||
                                              moved.cross(pose.position, reachedBox(now, id));
                                   }) ||
               std::ranges::any_of(moved.objects(), [&](int id) {
                   return now.scene().object(id).role == Role::Target && mayCapture(now, pose, id);
               });
    });
}

ViewCache::Entry* ViewCache::find(const Pose& pose) {
    const auto found = entries_.find(keyOf(pose));
    if (found == entries_.end()) return nullptr;
    found->second.used = now_;
    return &found->second;
}

ViewCache::Entry& ViewCache::keep(const Pose& pose, std::vector<CoarseEstimate> coarse) {
    Entry& entry = entries_[keyOf(pose)];
    entry.coarse = std::move(coarse);
    entry.used = now_;
    return entry;
}

}  // namespace dollytrack::planning
