#pragma once

namespace dollytrack::ui {

/// A screen as the window system describes it; millimetres are often made up, 0 where unknown.
struct ScreenSize {
    int width_px = 0;
    int height_px = 0;
    int width_mm = 0;
    int height_mm = 0;
};

/// How large to draw on it, in quarters; 1 is 96 dots per inch. Where the desktop has a scale of
/// its own (`content_scale` is not 1) it is that; else one guessed so that text is as large as one
/// is used to, and 1280 x 720 still fits.
[[nodiscard]] double screenScale(double content_scale, const ScreenSize& screen);

}  // namespace dollytrack::ui
