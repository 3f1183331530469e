#pragma once

#include "engine/scene/scene.h"
#include "render/light/light_volume.h"

#include <algorithm>

namespace dollytrack::ui {

/// Nearly uniform ambient light, used until the scene's own light is computed.
inline render::LightVolume plainLight(const Scene& scene) {
    render::LightVolume light;
    const Eigen::AlignedBox3d& room = scene.room_bounds;
    light.low = room.isEmpty() ? Eigen::Vector3d::Zero().eval() : room.min().eval();
    light.cell_m = room.isEmpty() ? 1.0 : std::max(room.sizes().maxCoeff(), 1.0);
    light.cells = {1, 1, 1};
    light.ambient = {Eigen::Vector3f::Constant(0.75F)};
    light.lamps = {Eigen::Vector3f(0.1F, -0.15F, 0.35F)};
    return light;
}

}  // namespace dollytrack::ui
