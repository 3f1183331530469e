#pragma once

#include "engine/scene/scene.h"
#include "ui/viewport/render_thread.h"

#include <imgui.h>

#include <optional>
#include <string>

namespace dollytrack::ui {

/// What the panel may read this frame.
struct PreviewView {
    const PreviewImage* image = nullptr;  // null or without a texture: nothing drawn yet
    const Scene* scene = nullptr;         // the image's, for names
    ImVec2 low, high;                     // of the pane that it lies in, px on the screen
    bool busy = false;                    // a newer picture is on its way
    std::string what;                     // "frame 12", "window_seat": whose camera it is
    std::string why_not;                  // why there is no picture; empty when there is one
    bool point_selected = false;          // a position point is, so that it can be shown
};

enum class PaneCorner { TopLeft, TopRight, BottomLeft, BottomRight };

/// What the panel remembers.
struct PreviewState {
    Modality modality = Modality::Rgb;
    bool open = true;  // else only its title
    bool full = false;
    bool shows_selection = false;  // the selected position point rather than the timeline's frame
    float width = 250.0F;          // at 96 dots per inch
    PaneCorner corner = PaneCorner::BottomRight;
};

struct PreviewActions {
    bool changed = false;  // another modality or camera is wanted
    bool save_png = false;
    bool hovered = false;  // the mouse is over it, not over the viewport
};

/// The picture of the plan's camera within the viewport, or over all of it. Call it inside the
/// viewport's window, after the viewport.
PreviewActions drawPreviewPanel(const PreviewView& view, PreviewState& state);

/// The pixel of an image shown at `low` with a size on the screen; nothing outside of it.
struct ImagePixel {
    int x = 0;
    int y = 0;
};
[[nodiscard]] std::optional<ImagePixel> pixelAt(ImVec2 mouse, ImVec2 low, ImVec2 size, int width,
                                                int height);

[[nodiscard]] const char* modalityName(Modality modality);

}  // namespace dollytrack::ui
