#pragma once

#include "engine/io/gltf/document.h"
#include "engine/io/raw_scene/raw_scene.h"

#include <Eigen/Geometry>

#include <string>
#include <vector>

namespace dollytrack::gltf {

/// How a material's textures are mapped onto a surface.
struct PictureCoordinates {
    int set = 0;                                              // TEXCOORD_0, TEXCOORD_1 ...
    Eigen::Affine2d transform = Eigen::Affine2d::Identity();  // KHR_texture_transform

    [[nodiscard]] bool operator==(const PictureCoordinates& other) const {
        return set == other.set && transform.matrix() == other.transform.matrix();
    }
};

/// Fills the scene's materials and textures. glTF's default material is appended as the last one.
/// Returns the texture mapping of each material. Textures in formats that cannot be decoded are
/// left out, with one warning for all of them.
[[nodiscard]] std::vector<PictureCoordinates> readMaterials(const Document& document,
                                                            RawScene& raw);

}  // namespace dollytrack::gltf
