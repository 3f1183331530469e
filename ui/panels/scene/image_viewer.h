#pragma once

#include <string>

namespace dollytrack::ui {

/// The image to display: a texture with row 0 at the top.
struct ImageViewerView {
    unsigned texture = 0;
    int width = 0;  // px
    int height = 0;
    std::string title;
    std::string message;  // shown instead of an image: "reading …", or why there is none
};

/// State kept between window frames.
struct ImageViewerState {
    double zoom = 0.0;  // screen pixels per image pixel; 0: fit the whole image
    double center_x = 0.5;
    double center_y = 0.5;  // image position at the centre of the pane, as a fraction of the image
};

struct ImageViewerActions {
    bool close = false;
};

/// Draws an image into the rest of the window; the wheel zooms about the mouse, dragging pans.
ImageViewerActions drawImageViewer(const ImageViewerView& view, ImageViewerState& state);

}  // namespace dollytrack::ui
