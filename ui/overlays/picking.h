#pragma once

#include "render/overlays/overlay.h"
#include "render/view/view.h"
#include "ui/overlays/pick_tag.h"

#include <optional>

namespace dollytrack::ui {

/// The overlay element under the pointer.
struct PickedElement {
    PickTag tag;
    double distance_px = 0.0;  // distance from the pointer to its outline; 0: on it
    double depth_m = 0.0;
    bool visible = true;  // no surface of the scene is in front of it
};

/// The tagged element closest to an image position, at most `radius_px` away; nullopt if there is
/// none. Visible elements win over hidden ones, then marks over lines over boxes, then the closest.
/// `scene_depth_m` is the depth of the scene image at that position, 0 for no surface;
/// `pixel_scale` is the one used for drawing.
[[nodiscard]] std::optional<PickedElement> pickElement(const render::Overlay& overlay,
                                                       const render::View& view,
                                                       const Eigen::Vector2d& pixel,
                                                       double scene_depth_m, double radius_px = 6.0,
                                                       double pixel_scale = 1.0);

/// Whether `a` is the better pick, for comparing the results of several layers: visible first, then
/// smaller distance to the pointer, then smaller depth.
[[nodiscard]] bool isBetterPick(const PickedElement& a, const PickedElement& b);

}  // namespace dollytrack::ui
