#include "planning/metrics/view_memo.h"

#include "engine/math/pose_key.h"

#include <utility>

namespace dollytrack::planning {
void ViewMemo::begin() {
    ++now_;
    const unsigned kept = entries_.size() > kMany ? 1 : kKept;
    std::erase_if(entries_, [&](const auto& entry) { return entry.second.used + kept < now_; });
}

ViewMemo::Entry* ViewMemo::find(const Pose& pose) {
    const auto found = entries_.find(keyOf(pose));
    if (found == entries_.end()) return nullptr;
    found->second.used = now_;
    return &found->second;
}

ViewMemo::Entry& ViewMemo::keep(const Pose& pose, std::vector<Look> looks) {
    Entry& entry = entries_[keyOf(pose)];
    entry.looks = std::move(looks);
    entry.used = now_;
    return entry;
}

}  // namespace dollytrack::planning
