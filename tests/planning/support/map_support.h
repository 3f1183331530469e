#pragma once

#include "planning/free_space/free_space.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace dollytrack::planning::test_support {

inline const test::SceneBuilder::Look kWallLook = {kNyuWall, Role::Structure, {0.8F, 0.8F, 0.8F}};
inline const test::SceneBuilder::Look kFloorLook = {kNyuFloor, Role::Structure, {0.5F, 0.5F, 0.5F}};
inline const test::SceneBuilder::Look kSofaLook = {6, Role::Target, {0.3F, 0.5F, 0.3F}};

inline Result<FreeSpace> tryMap(const Scene& scene, double resolution_m = 0.05,
                                double radius_m = 0.1) {
    CameraParams camera;
    camera.camera_radius_m = radius_m;
    return FreeSpace::build(scene, RayCaster(scene), camera, {resolution_m}, JobContext{});
}

/// The map of a scene that must have one.
inline FreeSpace map(const Scene& scene, double resolution_m = 0.05, double radius_m = 0.1) {
    Result<FreeSpace> result = tryMap(scene, resolution_m, radius_m);
    if (!result) throw std::runtime_error(describe(result.error()));
    return std::move(*result);
}

}  // namespace dollytrack::planning::test_support
