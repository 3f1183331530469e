#pragma once

#include "render/draw/view.h"
#include "render/overlays/overlay.h"
#include "ui/overlays/pick_tag.h"

#include <optional>

namespace dollytrack::ui {

/// The element of an overlay under the pointer.
struct PickedElement {
    PickTag tag;
    double distance_px = 0.0;  // from the pointer to its border; 0: on it
    double depth_m = 0.0;
    bool visible = true;  // no surface of the scene stands in front
};

/// The tagged element next to an image position, none further than `radius_px` away. What can be
/// seen goes before what is hidden, marks before lines before boxes, then the nearest.
/// `scene_depth_m` is the depth of the picture there, 0 where there is nothing; `pixel_scale` as it
/// was drawn with.
[[nodiscard]] std::optional<PickedElement> pickElement(const render::Overlay& overlay,
                                                       const render::View& view,
                                                       const Eigen::Vector2d& pixel,
                                                       double scene_depth_m, double radius_px = 6.0,
                                                       double pixel_scale = 1.0);

/// Whether `a` is what a person meant rather than `b`, for the best of several layers.
[[nodiscard]] bool isBetterPick(const PickedElement& a, const PickedElement& b);

}  // namespace dollytrack::ui
