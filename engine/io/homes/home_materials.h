#pragma once

#include "engine/io/files/file_source.h"
#include "engine/io/homes/home.h"
#include "engine/io/raw_scene/raw_scene.h"

#include <map>
#include <string>

namespace dollytrack::homes {

/// Adds one material per distinct surface to a scene. Textures are read from the home's files.
class HomeMaterials {
  public:
    /// `files` and `scene` must outlive this object.
    HomeMaterials(const FileSource& files, RawScene& scene) : files_(files), scene_(scene) {}

    /// The index of a surface's material; `otherwise` is the linear colour if the home has none.
    std::uint32_t of(const HomeSurface& surface, const Eigen::Vector3f& otherwise);

    /// The index of a material's copy with the surface's colour or texture.
    std::uint32_t overlaid(std::uint32_t material, const HomeSurface& surface);

  private:
    int texture(const std::string& image);

    const FileSource& files_;
    RawScene& scene_;
    std::map<std::string, std::uint32_t> made_;
    std::map<std::string, int> textures_;
};

}  // namespace dollytrack::homes
