#pragma once

#include "tests/support/scene_builder.h"

namespace dollytrack::render::fixture {

/// A room 3 x 3 x 2.6 m without gloss, and a table lamp beside its wall at x = 0: 0.5 m high with a
/// closed shade 0.2 m wide, its ball at lampBall(). `paint` is the colour of everything except the
/// lamp.
inline Scene lampRoom(float paint, bool second_room = false) {
    using dollytrack::test::SceneBuilder;
    SceneBuilder builder;
    const SceneBuilder::Look wall{kNyuWall, Role::Structure, {paint, paint, paint}};
    const auto shell = [&](double low, double high) {
        const double x = high - low;
        builder.object("floor", {kNyuFloor, Role::Structure, {paint, paint, paint}})
            .quad({low, 0, 0}, {x, 0, 0}, {0, 3, 0});
        builder.object("ceiling", {kNyuCeiling, Role::Structure, {paint, paint, paint}})
            .quad({low, 0, 2.6}, {0, 3, 0}, {x, 0, 0});
        builder.object("walls", wall)
            .quad({low, 0, 0}, {0, 3, 0}, {0, 0, 2.6})
            .quad({high, 0, 0}, {0, 0, 2.6}, {0, 3, 0})
            .quad({low, 0, 0}, {0, 0, 2.6}, {x, 0, 0})
            .quad({low, 3, 0}, {x, 0, 0}, {0, 0, 2.6});
    };
    shell(0.0, 3.0);
    if (second_room) shell(-3.1, -0.1);
    builder.object("table", {kNyuOtherFurniture, Role::Target, {paint, paint, paint}})
        .box({0.45, 1.5, 0.67}, {0.8, 1.2, 0.06});
    builder.object("lamp", {kNyuLamp, Role::Target, {0.8F, 0.8F, 0.8F}})
        .box({0.35, 1.5, 0.85}, {0.04, 0.04, 0.3})
        .box({0.35, 1.5, 1.1}, {0.2, 0.2, 0.2});
    Scene scene = builder.build();
    for (Material& material : scene.materials) material.roughness = 1.0F;
    return scene;
}

inline Eigen::Vector3d lampBall() {
    return {0.35, 1.5, 1.2 - 0.5 / 6.0};
}

}  // namespace dollytrack::render::fixture
