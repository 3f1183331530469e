#include "ui/screen_scale.h"

#include <algorithm>
#include <cmath>

namespace dollytrack::ui {
namespace {

constexpr double kSmallest = 0.75;
constexpr double kLargest = 4.0;

/// Scale from the physical pixel size; 0 if that is unknown or implausible.
double scaleOfPixels(const ScreenSize& screen) {
    constexpr double kMillimetresAnInch = 25.4;
    if (screen.width_mm < 100 || screen.width_mm > 2500) return 0.0;
    const double dpi = kMillimetresAnInch * screen.width_px / screen.width_mm;
    // Display servers without a real screen, and some televisions, always report 96 dpi.
    constexpr double kMadeUp = 96.0;
    if (std::abs(dpi - kMadeUp) < 0.7 || dpi > 500.0) return 0.0;
    // Desktops use scale 1 on 24-inch 1080p and on 27-inch 1440p screens (109 dpi).
    constexpr double kUnscaled = 110.0;
    return dpi / kUnscaled;
}

}  // namespace

double screenScale(double content_scale, const ScreenSize& screen) {
    if (std::abs(content_scale - 1.0) > 0.05) {
        return std::clamp(std::round(4.0 * content_scale) / 4.0, kSmallest, kLargest);
    }
    if (screen.width_px <= 0 || screen.height_px <= 0) return 1.0;
    double scale = scaleOfPixels(screen);
    if (scale == 0.0) scale = screen.height_px / 1080.0;
    const double room = std::min(screen.width_px / 1280.0, screen.height_px / 720.0);
    const double quarters = std::min(std::floor(4.0 * scale + 0.25), std::floor(4.0 * room));
    return std::clamp(quarters / 4.0, 1.0, kLargest);
}

}  // namespace dollytrack::ui
