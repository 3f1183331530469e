#pragma once

#include "engine/io/gltf/document.h"
#include "engine/io/gltf/gltf_materials.h"
#include "engine/io/raw_scene/mesh_part_builder.h"

#include <Eigen/Core>

#include <cstdint>
#include <string>
#include <vector>

namespace dollytrack::gltf {

/// One primitive of a mesh, as triangles. Only checked to lie within the file: indices may be out
/// of range.
struct Primitive {
    std::string name;            // of its mesh, with its number where the mesh has several
    std::uint32_t material = 0;  // index into RawScene::materials
    std::vector<Eigen::Vector3f> positions;
    std::vector<Eigen::Vector3f> normals;
    std::vector<Eigen::Vector3f> uvs;  // v upwards
    std::vector<std::uint32_t> indices;
    std::size_t lines = 0;  // points and lines, which are left out
    // Vertex colours, linear, which multiply the material's base colour; empty, or one per
    // position.
    std::vector<Eigen::Vector3f> colors;
};

/// Reads the primitives of a mesh. `coordinates` has the texture mapping of each material; the last
/// material is used by primitives that name none.
[[nodiscard]] std::vector<Primitive> readMesh(const Document& document, std::size_t mesh,
                                              const std::vector<PictureCoordinates>& coordinates);

}  // namespace dollytrack::gltf
