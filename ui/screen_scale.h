#pragma once

namespace dollytrack::ui {

/// A screen as reported by the window system. Millimetres are often wrong; 0: unknown.
struct ScreenSize {
    int width_px = 0;
    int height_px = 0;
    int width_mm = 0;
    int height_mm = 0;
};

/// The scale of the user interface, a multiple of 0.25 between 0.75 and 4; 1 is 96 dots per inch.
/// If the desktop sets a scale (`content_scale` is not 1), that is used, rounded. Otherwise it is
/// estimated from the pixel size, or from the height in pixels if that is unknown; it is at least 1
/// and leaves room for 1280 x 720 scaled pixels.
[[nodiscard]] double screenScale(double content_scale, const ScreenSize& screen);

}  // namespace dollytrack::ui
