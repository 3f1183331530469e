#include "planning/metrics/view_memo.h"

#include <utility>

namespace dollytrack::planning {
namespace {

std::array<double, 7> keyOf(const Pose& pose) {
    const auto& p = pose.position;
    const auto& q = pose.rotation;
    return {p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w()};
}

}  // namespace

void ViewMemo::begin() {
    ++now_;
    std::erase_if(entries_, [&](const auto& entry) { return entry.second.used + kKept < now_; });
}

ViewMemo::Entry* ViewMemo::find(const Pose& pose) {
    const auto found = entries_.find(keyOf(pose));
    if (found == entries_.end()) return nullptr;
    found->second.used = now_;
    return &found->second;
}

ViewMemo::Entry& ViewMemo::keep(const Pose& pose, std::vector<Glance> glances) {
    Entry& entry = entries_[keyOf(pose)];
    entry.glances = std::move(glances);
    entry.used = now_;
    return entry;
}

}  // namespace dollytrack::planning
