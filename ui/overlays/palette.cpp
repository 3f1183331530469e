#include "ui/overlays/palette.h"

#include <algorithm>
#include <array>

namespace dollytrack::ui {

Eigen::Vector4f withOpacity(const Eigen::Vector4f& rgba, float opacity) {
    return {rgba[0], rgba[1], rgba[2], opacity};
}

Eigen::Vector4f partColor(int part) {
    static const std::array<Eigen::Vector4f, 10> colors = {{
        {0.16F, 0.50F, 0.90F, 1.0F},
        {0.20F, 0.72F, 0.30F, 1.0F},
        {0.80F, 0.30F, 0.85F, 1.0F},
        {0.05F, 0.72F, 0.72F, 1.0F},
        {0.93F, 0.65F, 0.05F, 1.0F},
        {0.48F, 0.40F, 0.95F, 1.0F},
        {0.62F, 0.78F, 0.10F, 1.0F},
        {0.95F, 0.45F, 0.62F, 1.0F},
        {0.55F, 0.38F, 0.22F, 1.0F},
        {0.30F, 0.62F, 0.55F, 1.0F},
    }};
    return part < 0 ? Eigen::Vector4f(0.5F, 0.5F, 0.5F, 1.0F)
                    : colors[static_cast<std::size_t>(part) % colors.size()];
}

Eigen::Vector4f scaleColor(double share) {
    static const std::array<Eigen::Vector4f, 5> stops = {{
        {0.44F, 0.06F, 0.52F, 1.0F},
        {0.24F, 0.36F, 0.88F, 1.0F},
        {0.05F, 0.58F, 0.64F, 1.0F},
        {0.38F, 0.78F, 0.30F, 1.0F},
        {0.99F, 0.90F, 0.20F, 1.0F},
    }};
    const double at = std::clamp(share, 0.0, 1.0) * (stops.size() - 1);
    const auto low = std::min(static_cast<std::size_t>(at), stops.size() - 2);
    const auto rest = static_cast<float>(at - static_cast<double>(low));
    return stops[low] + rest * (stops[low + 1] - stops[low]);
}

}  // namespace dollytrack::ui
