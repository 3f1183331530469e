#pragma once

#include "engine/io/files/file_source.h"
#include "engine/io/homes/home.h"
#include "engine/io/import/raw_scene.h"

#include <map>
#include <string>

namespace dollytrack::homes {

/// Makes a material of each different surface, once. Pictures are taken out of the home's files.
class HomeMaterials {
  public:
    /// `files` and `scene` have to outlive this object.
    HomeMaterials(const FileSource& files, RawScene& scene) : files_(files), scene_(scene) {}

    /// The index of the material for a surface; `otherwise` is its linear colour where the home
    /// gives none.
    std::uint32_t of(const HomeSurface& surface, const Eigen::Vector3f& otherwise);

    /// A copy of a material with the surface's colour or picture laid over.
    std::uint32_t overlaid(std::uint32_t material, const HomeSurface& surface);

  private:
    int texture(const std::string& image);

    const FileSource& files_;
    RawScene& scene_;
    std::map<std::string, std::uint32_t> made_;
    std::map<std::string, int> textures_;
};

}  // namespace dollytrack::homes
