#pragma once

#include "engine/scene/scene.h"

#include <cstdint>
#include <vector>

namespace dollytrack::view {

/// A scene's surfaces for a small file: few triangles, 16-bit positions, a colour a vertex.
struct ViewMesh {
    struct Part {
        int object_id = 0;
        std::uint32_t first_corner = 0;
        std::uint32_t corner_count = 0;
    };

    Eigen::Vector3d origin = Eigen::Vector3d::Zero();  // world, of position 0 0 0
    double step_m = 0.0;                               // a world position is origin + step * stored
    std::vector<std::uint16_t> positions;              // three a vertex
    std::vector<std::uint8_t> colors;                  // three a vertex, sRGB
    std::vector<std::uint32_t> corners;                // three a triangle, indices of vertices
    std::vector<Part> parts;                           // one an object that has triangles
    std::size_t scene_triangles = 0;                   // of the shown objects, before
};

/// The surfaces of all objects but the hidden ones (by object id), in at most about
/// `most_triangles`. They stay within a tolerance that grows until they are few enough (Garland &
/// Heckbert's quadrics, by meshoptimizer); glass is left out. The result does not depend on the
/// number of threads.
[[nodiscard]] ViewMesh makeViewMesh(const Scene& scene, const std::vector<bool>& hidden,
                                    std::size_t most_triangles);

}  // namespace dollytrack::view
