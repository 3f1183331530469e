#include "ui/viewport/adaptive_resolution.h"

#include <algorithm>

namespace dollytrack::ui {
namespace {

constexpr double kLongestRest_ms = 600.0;

}  // namespace

AdaptiveResolution::Time AdaptiveResolution::restsAt() const {
    const std::chrono::milliseconds whole(static_cast<int>(std::min(whole_ms_, kLongestRest_ms)));
    return moved_ + std::max(kRest, whole);
}

int AdaptiveResolution::shrinkFor(bool same, Time now) const {
    if (now >= restsAt() || whole_ms_ <= kFluent_ms) return 1;
    if (same) return shrink_;
    constexpr int kCoarsest = 3;
    return whole_ms_ <= 4.0 * kFluent_ms ? 2 : kCoarsest;
}

void AdaptiveResolution::drew(int shrink, bool same, bool scene, double milliseconds, Time now) {
    shrink_ = shrink;
    if (!same) moved_ = now;
    if (shrink == 1 && scene) whole_ms_ = milliseconds;
}

}  // namespace dollytrack::ui
