#pragma once

#include "engine/io/gltf/document.h"
#include "engine/io/import/raw_scene.h"

#include <Eigen/Geometry>

#include <string>
#include <vector>

namespace dollytrack::gltf {

/// Where the pictures of a material lie on a surface.
struct PictureCoordinates {
    int set = 0;                                              // TEXCOORD_0, TEXCOORD_1 ...
    Eigen::Affine2d transform = Eigen::Affine2d::Identity();  // KHR_texture_transform

    [[nodiscard]] bool operator==(const PictureCoordinates& other) const {
        return set == other.set && transform.matrix() == other.transform.matrix();
    }
};

/// Fills the scene's materials, the default material of the specification last, and its textures;
/// returns each material's coordinates. Pictures of kinds that cannot be decoded are left out with
/// one warning for all of them.
[[nodiscard]] std::vector<PictureCoordinates> readMaterials(const Document& document,
                                                            RawScene& raw);

}  // namespace dollytrack::gltf
