#pragma once

#include <string>

namespace dollytrack::ui {

/// A picture to look at: a texture with row 0 at the top.
struct ImageViewerView {
    unsigned texture = 0;
    int width = 0;  // px
    int height = 0;
    std::string title;
    std::string message;  // instead of a picture: "reading …", or why there is none
};

/// What the viewer remembers.
struct ImageViewerState {
    double zoom = 0.0;  // pixels of the screen a pixel of the picture; 0: all of it fits
    double center_x = 0.5;
    double center_y = 0.5;  // of the pane, as a share of the picture
};

struct ImageViewerActions {
    bool close = false;
};

/// A picture in the rest of the window: the wheel zooms to the mouse, dragging moves it.
ImageViewerActions drawImageViewer(const ImageViewerView& view, ImageViewerState& state);

}  // namespace dollytrack::ui
