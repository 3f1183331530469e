#pragma once

#include "engine/io/raw_scene/raw_scene.h"

#include <Eigen/Core>

#include <map>
#include <string>
#include <vector>

namespace dollytrack::homes {

/// The triangles of a constructed object, by material. Points are in the source's axes: x of the
/// plan, y up, z the plan's y; cm.
class SurfaceMesh {
  public:
    /// Adds a triangle whose front faces `outward`; `uvs` are in repeats of the texture.
    void triangle(std::uint32_t material, const std::array<Eigen::Vector3d, 3>& corners,
                  const std::array<Eigen::Vector2d, 3>& uvs, const Eigen::Vector3d& outward);

    /// Adds a quad with its corners in order, without a texture.
    void quad(std::uint32_t material, const std::array<Eigen::Vector3d, 4>& corners,
              const Eigen::Vector3d& outward);

    [[nodiscard]] bool empty() const { return meshes_.empty(); }

    /// Adds a node with one part per material to a scene. Returns the parts' indices.
    std::vector<std::size_t> addTo(RawScene& scene, const std::string& name) const;

  private:
    struct Mesh {
        std::vector<Eigen::Vector3f> positions;
        std::vector<Eigen::Vector3f> uvs;
    };
    std::map<std::uint32_t, Mesh> meshes_;
};

}  // namespace dollytrack::homes
