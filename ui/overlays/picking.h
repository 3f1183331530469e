#pragma once

#include "render/overlays/overlay.h"
#include "render/view/view.h"
#include "ui/overlays/pick_tag.h"

#include <Eigen/Geometry>

#include <optional>
#include <vector>

namespace dollytrack::ui {

/// The overlay element under the pointer.
struct PickedElement {
    enum class Drawn { Mark, Line, Box };  // from top to bottom, as overlays are drawn
    PickTag tag;
    double distance_px = 0.0;  // distance from the pointer to its outline; 0: on it
    double depth_m = 0.0;
    bool visible = true;  // no surface of the scene is in front of it
    Drawn drawn = Drawn::Mark;
    bool on = true;  // the pointer is on it, or misses it by a pixel or two
};

/// The tagged elements at most `radius_px` away from an image position, the best first and each
/// once; see isBetterPick(). `scene_depth_m` is the depth of the scene image at that position, 0
/// for no surface; `pixel_scale` is the one used for drawing.
[[nodiscard]] std::vector<PickedElement> pickElements(const render::Overlay& overlay,
                                                      const render::View& view,
                                                      const Eigen::Vector2d& pixel,
                                                      double scene_depth_m, double radius_px = 6.0,
                                                      double pixel_scale = 1.0);
/// The best of them; nullopt if there is none.
[[nodiscard]] std::optional<PickedElement> pickElement(const render::Overlay& overlay,
                                                       const render::View& view,
                                                       const Eigen::Vector2d& pixel,
                                                       double scene_depth_m, double radius_px = 6.0,
                                                       double pixel_scale = 1.0);

/// Whether `a` is the better pick: visible elements win over hidden ones, then those under the
/// pointer over those beside it, marks over lines over boxes, then the smaller distance in
/// the image, then the smaller depth.
[[nodiscard]] bool isBetterPick(const PickedElement& a, const PickedElement& b);

/// A range of the parameter t of a line, origin + t * direction; empty if first > last.
struct LineRange {
    double first = 0.0;
    double last = 0.0;
};

/// The part of a range of a line that lies in a box, which may be empty.
[[nodiscard]] LineRange partInBox(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& origin,
                                  const Eigen::Vector3d& direction, LineRange range);

}  // namespace dollytrack::ui
