#pragma once

#include "ui/viewport/render_thread.h"
#include "ui/viewport/viewer_camera.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <optional>
#include <string>
#include <vector>

namespace dollytrack::ui {

/// Input of the viewport for one window frame.
struct ViewportView {
    const ViewImage* image = nullptr;
    std::string message;     // centred, while there is no image
    std::string remark;      // at the top of the image
    std::string name;        // of the view, in the image's top left corner: "Front Orthographic"
    bool locked = false;     // locked to the plan's camera: the mouse does not move it
    double aspect = 0.0;     // fixed aspect ratio of the image; 0: fills the pane
    bool covered = false;    // another widget lies over the mouse and takes its input
    bool on_handle = false;  // the mouse is on a gizmo handle, which receives the left button
};

/// State kept between window frames.
struct ViewportState {
    ViewerCamera camera;
    enum class Drag { None, Orbit, Pan, Look, Pressed, Box } drag = Drag::None;
    Eigen::Vector2d pressed_at = Eigen::Vector2d::Zero();
    // Held at the press; they may be released before the button.
    bool pressed_with_shift = false;
    bool pressed_with_ctrl = false;
    bool pressed_with_alt = false;
    // The camera turned or flew since the right button was pressed; otherwise its release is a
    // right click.
    bool looked = false;
    bool box_select = false;  // the next left drag selects the objects in a box

    /// Ends the selection with a box; returns whether there was one.
    bool cancelBoxSelect();
};

/// User input of this frame. Positions are in pixels of the image.
struct ViewportActions {
    int width = 0;  // pane size, px
    int height = 0;
    Eigen::Vector2f origin = Eigen::Vector2f::Zero();  // top-left of the image in the window, px
    bool hovered = false;
    Eigen::Vector2d cursor = Eigen::Vector2d::Zero();
    std::optional<Eigen::Vector2d> clicked;
    std::optional<Eigen::Vector2d> right_clicked;
    std::optional<Eigen::AlignedBox2d> box;  // a box was drawn to select what is in it
    bool add_to_selection = false;
    bool remove_from_selection = false;  // the objects in the box
    bool list = false;                   // list what lies under the click instead of selecting it
    bool double_clicked = false;
    bool camera_moved = false;
    bool unlock = false;  // the user tried to move the locked camera
};

/// Draws the scene's image and handles its mouse: left or middle drag orbits, with Shift it pans,
/// the wheel zooms towards the point under the cursor, right drag looks around while W A S D Q E
/// fly; a right click is reported. With ViewportState::box_select, a left drag draws a box instead:
/// Shift adds its objects to the selection, Ctrl takes them out.
ViewportActions drawViewport(const ViewportView& view, ViewportState& state);

/// World position (m) of the surface under an image pixel; nullopt if there is no surface.
[[nodiscard]] std::optional<Eigen::Vector3d> surfaceAt(const ViewImage& image,
                                                       const Eigen::Vector2d& pixel);
/// The world point (m) to zoom towards, which stays under the cursor: the surface in the image, if
/// that is under the cursor in the `current` view, too (the image may show an older view), else the
/// point under the cursor at the pivot's depth. `image` may be null.
[[nodiscard]] Eigen::Vector3d zoomCentre(const ViewImage* image, const render::View& current,
                                         const Eigen::Vector3d& pivot,
                                         const Eigen::Vector2d& cursor);
/// Ids of the objects visible in a part of the image, ascending.
[[nodiscard]] std::vector<int> objectsIn(const ViewImage& image, const Eigen::AlignedBox2d& pixels);
/// Id of the object under an image pixel; 0 for none.
[[nodiscard]] int objectAt(const ViewImage& image, const Eigen::Vector2d& pixel);

}  // namespace dollytrack::ui
