#pragma once

#include "ui/viewport/render_thread.h"
#include "ui/viewport/viewer_camera.h"

#include <Eigen/Core>

#include <optional>
#include <string>

namespace dollytrack::ui {

/// What the viewport may read this frame.
struct ViewportView {
    const ViewImage* image = nullptr;
    std::string message;     // in the middle, while there is no picture
    std::string remark;      // at the top, over the picture
    bool locked = false;     // looking through the plan's camera: the mouse does not move it
    double aspect = 0.0;     // of the picture when it is not the pane's own; 0: fills the pane
    bool covered = false;    // something lies over it there, and has the mouse and the wheel
    bool on_handle = false;  // the mouse is on a gizmo, which has its left button
};

/// What it remembers between frames.
struct ViewportState {
    ViewerCamera camera;
    enum class Drag { None, Orbit, Pan, Look, Pressed } drag = Drag::None;
    Eigen::Vector2d pressed_at = Eigen::Vector2d::Zero();
    bool pressed_with_ctrl = false;
};

/// What the user did. Pixels are those of the picture.
struct ViewportActions {
    int width = 0;  // of the pane, px
    int height = 0;
    Eigen::Vector2f origin = Eigen::Vector2f::Zero();  // of the picture in the window
    bool hovered = false;
    Eigen::Vector2d cursor = Eigen::Vector2d::Zero();
    std::optional<Eigen::Vector2d> clicked;
    bool add_to_selection = false;
    bool double_clicked = false;
    bool camera_moved = false;
    bool unlock = false;  // the user tried to move a locked camera
};

/// The picture of the scene with the mouse on it: left drag orbits, Shift+left or middle drag pans,
/// the wheel goes towards what is under the cursor, right drag looks around while W A S D Q E fly.
ViewportActions drawViewport(const ViewportView& view, ViewportState& state);

/// Where the surface under a pixel of the picture is; nothing where none is.
[[nodiscard]] std::optional<Eigen::Vector3d> surfaceAt(const ViewImage& image,
                                                       const Eigen::Vector2d& pixel);
/// Id of the object under a pixel; 0 for none.
[[nodiscard]] int objectAt(const ViewImage& image, const Eigen::Vector2d& pixel);

}  // namespace dollytrack::ui
