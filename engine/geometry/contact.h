#pragma once

#include <Eigen/Geometry>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace dollytrack {

/// A surface to be tested: points and triangles between them.
struct SurfaceView {
    std::span<const Eigen::Vector3f> positions;
    std::span<const std::array<std::uint32_t, 3>> triangles;
};

/// Where two surfaces touch, cross or come nearer than `gap`: some of the places, none when they
/// do not. Looks at corners against triangles and edges through triangles; of very dense meshes it
/// looks at a part.
std::vector<Eigen::Vector3f> findContact(const std::vector<SurfaceView>& a,
                                         const std::vector<SurfaceView>& b, float gap);

}  // namespace dollytrack
