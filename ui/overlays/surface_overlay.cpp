#include "ui/overlays/surface_overlay.h"

#include "ui/overlays/palette.h"

#include <array>

namespace dollytrack::ui {
namespace {

constexpr double kSide = 0.7;       // of a patch, so that the scene shows in between
constexpr double kLifted_m = 0.01;  // above the surface
constexpr float kOpacity = 0.75F;

struct StateStyle {
    const char* name;
    Eigen::Vector4f rgba;
};

StateStyle styleOf(PatchState state) {
    switch (state) {
        case PatchState::Unseen:
            return {"Surface that no frame shows", kRefusedColor};
        case PatchState::Seen:
            return {"Seen from too few sides or too far away", kLargeTargetColor};
        case PatchState::SeenAtBest:
            return {"Seen from as many sides as possible", kSpareColor};
        case PatchState::Covered:
            break;
    }
    return {"Covered", kAcceptedColor};
}

bool isDrawn(PatchState state, const SurfaceOverlayOptions& options) {
    if (state == PatchState::Unseen) return options.unseen;
    return state == PatchState::Covered ? options.covered : options.seen;
}

/// Counter-clockwise about the normal.
void addSquare(render::Overlay& overlay, const MeasuredPatch& patch, double side_m,
               const Eigen::Vector4f& rgba) {
    const Eigen::Vector3d normal = patch.normal.cast<double>();
    const Eigen::Vector3d center = patch.point.cast<double>() + kLifted_m * normal;
    // Sides are level where the surface is not.
    const Eigen::Vector3d level = Eigen::Vector3d::UnitZ().cross(normal);
    const bool flat = level.norm() < 0.3;
    const Eigen::Vector3d along_x = Eigen::Vector3d::UnitY().cross(normal);
    const Eigen::Vector3d across = 0.5 * side_m * (flat ? along_x : level).normalized();
    const Eigen::Vector3d along = normal.cross(across);
    const Eigen::Vector3d a = center - across - along;
    const Eigen::Vector3d b = center + across - along;
    const Eigen::Vector3d c = center + across + along;
    const Eigen::Vector3d d = center - across + along;
    overlay.triangles.push_back({a, b, c, rgba});
    overlay.triangles.push_back({a, c, d, rgba});
}

}  // namespace

PlanLayer surfaceLayer(const SurfaceShare& surface, const SurfaceOverlayOptions& options) {
    PlanLayer layer;
    layer.legend.title = "Surface";
    // Ceilings that are cut away, and walls seen from behind, must not hide the room.
    layer.overlay.one_sided_triangles = true;
    constexpr std::array kStates = {PatchState::Unseen, PatchState::Seen, PatchState::SeenAtBest,
                                    PatchState::Covered};
    for (const PatchState state : kStates) {
        if (!isDrawn(state, options)) continue;
        const StateStyle style = styleOf(state);
        int count = 0;
        for (const MeasuredPatch& patch : surface.measured) {
            if (patch.state != state) continue;
            addSquare(layer.overlay, patch, kSide * surface.patch_m,
                      withOpacity(style.rgba, kOpacity));
            ++count;
        }
        if (count == 0) continue;
        layer.legend.entries.push_back(
            {style.name, LegendEntry::Shape::Block, withOpacity(style.rgba, kOpacity), count});
    }
    return layer;
}

}  // namespace dollytrack::ui
