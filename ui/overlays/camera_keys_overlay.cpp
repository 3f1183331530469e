#include "ui/overlays/camera_keys_overlay.h"

#include "render/overlays/trajectory_overlay.h"
#include "ui/overlays/palette.h"
#include "ui/overlays/pick_tag.h"

#include <cstddef>

namespace dollytrack::ui {

PlanLayer cameraKeysLayer(const std::vector<MotionKey>& keys, const std::vector<PassedKey>& passed,
                          const CameraParams& camera, int selected) {
    constexpr double kLength_m = 0.3;
    PlanLayer layer;
    layer.legend.title = "Camera path";
    int kept = 0;
    for (std::size_t i = 0; i < keys.size(); ++i) {
        const bool has_note = passed.size() == keys.size() && !passed[i].note.empty();
        const bool is_selected = static_cast<int>(i) == selected;
        const Eigen::Vector4f& color = is_selected ? kSelectedColor
                                       : has_note  ? kRefusedColor
                                                   : kKeyFrameColor;
        kept += has_note ? 0 : 1;
        const std::int32_t tag = toTag(Picked::CameraKey, static_cast<int>(i));
        const std::size_t first = layer.overlay.lines.size();
        render::addFrustum(layer.overlay, keys[i].pose, camera, kLength_m, color,
                           is_selected ? 2.5 : 1.5);
        for (std::size_t k = first; k < layer.overlay.lines.size(); ++k) {
            layer.overlay.lines[k].tag = tag;
        }
        layer.overlay.marks.push_back({keys[i].pose.position,
                                       render::OverlayMark::Shape::Dot,
                                       color,
                                       is_selected ? 12.0 : 9.0,
                                       {0, 0, 0},
                                       tag});
    }
    const int others = static_cast<int>(keys.size()) - kept;
    layer.legend.entries.push_back({"Key", LegendEntry::Shape::Dot, kKeyFrameColor, kept});
    if (others > 0) {
        layer.legend.entries.push_back(
            {"Key that is not kept", LegendEntry::Shape::Dot, kRefusedColor, others});
    }
    return layer;
}

}  // namespace dollytrack::ui
