#include "ui/viewport/adaptive_resolution.h"

namespace dollytrack::ui {

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
