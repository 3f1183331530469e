#pragma once

#include "render/light/light_rig.h"
#include "tests/support/scene_builder.h"

#include <cmath>

namespace dollytrack::render::fixture {

/// What fills the hole in the wall.
enum class Hole { Window, Shutter, Pane };

/// A room 4 x 3 x 2.6 m with a hole 1 x 1 m in the wall at x = 0, from y and z 1 to 2. The panes of
/// the window are opaque in the file; the floor is object 1. Hole::Pane is glass that does not
/// belong to a window object and lets a part of the light through.
inline Scene sunnyRoom(Hole hole) {
    using dollytrack::test::SceneBuilder;
    const SceneBuilder::Look wall{kNyuWall, Role::Structure, {0.8F, 0.8F, 0.8F}};
    SceneBuilder builder;
    builder.object("floor", {kNyuFloor, Role::Structure, {0.5F, 0.5F, 0.5F}})
        .quad({0, 0, 0}, {4, 0, 0}, {0, 3, 0});
    builder.object("ceiling", {kNyuCeiling, Role::Structure, {0.8F, 0.8F, 0.8F}})
        .quad({0, 0, 2.6}, {0, 3, 0}, {4, 0, 0});
    builder.object("walls", wall)
        .quad({4, 0, 0}, {0, 3, 0}, {0, 0, 2.6})
        .quad({0, 0, 0}, {4, 0, 0}, {0, 0, 2.6})
        .quad({0, 3, 0}, {4, 0, 0}, {0, 0, 2.6})
        .quad({0, 0, 0}, {0, 3, 0}, {0, 0, 1})
        .quad({0, 0, 2}, {0, 3, 0}, {0, 0, 0.6})
        .quad({0, 0, 1}, {0, 1, 0}, {0, 0, 1})
        .quad({0, 2, 1}, {0, 1, 0}, {0, 0, 1});
    const int what = hole == Hole::Window ? static_cast<int>(kNyuWindow) : kNyuOtherStructure;
    builder.object("hole", {what, Role::Structure, {0.1F, 0.1F, 0.1F}})
        .quad({0, 1, 1}, {0, 1, 0}, {0, 0, 1});
    Scene scene = builder.build();
    for (Material& material : scene.materials) material.roughness = 1.0F;
    if (hole == Hole::Pane) scene.materials.back().opacity = 0.25F;
    return scene;
}

/// Only a sun at 45 degrees in front of that wall: its light falls on the floor where x and y are
/// between 1 and 2.
inline LightRig sunAlone(const Scene& scene) {
    LightRig rig;
    rig.sky_strength = 0.0;
    rig.sun = {Eigen::Vector3d(-1, 0, 1).normalized(), {4.0F, 3.0F, 2.0F}, scene.room_bounds};
    rig.sun.shades.min().array() -= 0.5;
    rig.sun.shades.max().array() += 0.5;
    return rig;
}

}  // namespace dollytrack::render::fixture
