#pragma once

#include "engine/scene/scene.h"
#include "ui/viewport/render_thread.h"

#include <imgui.h>

#include <optional>
#include <string>

namespace dollytrack::ui {

/// Input of the panel for one window frame.
struct PreviewView {
    const PreviewImage* image = nullptr;  // null or without a texture: not drawn yet
    const Scene* scene = nullptr;         // scene of the image, for object names
    ImVec2 low, high;                     // corners of the area, px on the screen
    bool docked = false;                  // fills the area; otherwise it floats in a corner
    bool busy = false;                    // a newer image is being rendered
    std::string what;                     // name of the camera pose: "frame 12", "window_seat"
    std::string why_not;                  // why there is no image; empty: there is one
    bool point_selected = false;          // a position point is selected and can be previewed
};

enum class PaneCorner { TopLeft, TopRight, BottomLeft, BottomRight };

/// State kept between window frames.
struct PreviewState {
    Modality modality = Modality::Rgb;
    bool open = true;  // false: only the title bar
    bool full = false;
    bool docked = true;            // beside the timeline, not over the viewport
    bool shows_selection = false;  // the selected position point, not the timeline's frame
    float width = 250.0F;          // length of the longer side, px at 96 dots per inch
    PaneCorner corner = PaneCorner::BottomRight;
};

struct PreviewActions {
    bool changed = false;  // another modality or camera pose was chosen
    bool save_png = false;
    bool hovered = false;  // the mouse is over the panel and not for the viewport
};

/// Draws the image of the plan's camera in a corner of the viewport, over all of it, or docked in
/// an area of its own. To be called inside the ImGui window of that area; in the viewport's after
/// drawViewport().
PreviewActions drawPreviewPanel(const PreviewView& view, PreviewState& state);

/// A pixel of an image.
struct ImagePixel {
    int x = 0;
    int y = 0;
};
[[nodiscard]] std::optional<ImagePixel> pixelAt(ImVec2 mouse, ImVec2 low, ImVec2 size, int width,
                                                int height);

[[nodiscard]] const char* modalityName(Modality modality);

}  // namespace dollytrack::ui
