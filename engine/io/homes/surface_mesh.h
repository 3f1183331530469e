#pragma once

#include "engine/io/import/raw_scene.h"

#include <Eigen/Core>

#include <map>
#include <string>
#include <vector>

namespace dollytrack::homes {

/// Triangles of one thing made by hand, gathered by material. Points are in the source's axes: x
/// the plan's, y up, z the plan's y; cm.
class SurfaceMesh {
  public:
    /// A triangle that shows its front towards `outward`; `uvs` in repeats of the picture.
    void triangle(std::uint32_t material, const std::array<Eigen::Vector3d, 3>& corners,
                  const std::array<Eigen::Vector2d, 3>& uvs, const Eigen::Vector3d& outward);

    /// Four corners in turn, without a picture.
    void quad(std::uint32_t material, const std::array<Eigen::Vector3d, 4>& corners,
              const Eigen::Vector3d& outward);

    [[nodiscard]] bool empty() const { return meshes_.empty(); }

    /// Adds a node with a part for each material; their indices.
    std::vector<std::size_t> addTo(RawScene& scene, const std::string& name) const;

  private:
    struct Mesh {
        std::vector<Eigen::Vector3f> positions;
        std::vector<Eigen::Vector3f> uvs;
    };
    std::map<std::uint32_t, Mesh> meshes_;
};

}  // namespace dollytrack::homes
