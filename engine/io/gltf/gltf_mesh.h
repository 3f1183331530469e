#pragma once

#include "engine/io/gltf/document.h"
#include "engine/io/gltf/gltf_materials.h"
#include "engine/io/import/mesh_part_builder.h"

#include <Eigen/Core>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack::gltf {

/// One primitive of a mesh, as triangles; nothing checked yet but that it is within the file.
struct Primitive {
    std::string name;            // of its mesh, with its number where the mesh has several
    std::uint32_t material = 0;  // index into RawScene::materials
    std::vector<Eigen::Vector3f> positions;
    std::vector<Eigen::Vector3f> normals;
    std::vector<Eigen::Vector3f> uvs;  // v upwards
    std::vector<std::uint32_t> indices;
    std::size_t lines = 0;                // points and lines, which are left out
    std::vector<Eigen::Vector3f> colors;  // of its vertices, as the file has them; see readMesh
    std::optional<Eigen::Vector3f> mean_color;  // linear, of its vertices; multiplies the material
};

/// The primitives of a mesh. `coordinates` says of each material where its pictures lie; the last
/// material is the one of primitives that name none. Colours of vertices are kept only where
/// `keep_colors` says so; else primitives have but their mean.
[[nodiscard]] std::vector<Primitive> readMesh(const Document& document, std::size_t mesh,
                                              const std::vector<PictureCoordinates>& coordinates,
                                              bool keep_colors);

}  // namespace dollytrack::gltf
