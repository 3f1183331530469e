#pragma once

#include "engine/io/raw_scene/mesh_part_builder.h"
#include "engine/io/raw_scene/raw_scene.h"

#include <Eigen/Core>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace dollytrack {

/// A mesh with the same faces in the same order, each with vertices of its own, and with a texture
/// that shows its former vertex colours.
struct PaintedMesh {
    std::vector<Eigen::Vector3f> positions;
    std::vector<Eigen::Vector3f> normals;  // empty, or one per position
    std::vector<Eigen::Vector3f> uvs;
    std::vector<std::uint32_t> indices;
    TextureRequest texture;

    /// The mesh with the face sizes of the unpainted one. This object must outlive it.
    [[nodiscard]] SourceMesh mesh(std::span<const std::uint32_t> face_sizes) const {
        return {positions, normals, uvs, face_sizes, indices};
    }
};

/// Paints a texture with the colours of a mesh's vertices (sRGB, 0 to 1, one per position), because
/// a Scene has no vertex colours. Triangles and quadrilaterals keep the interpolation between their
/// vertices; larger faces have their mean colour. In a mesh with more than a million faces of
/// several colours, each face has its mean colour. Returns nullopt if the mesh has no colours or
/// all vertices have the same one.
[[nodiscard]] std::optional<PaintedMesh> paintVertexColors(const SourceMesh& mesh,
                                                           std::span<const Eigen::Vector3f> colors);

}  // namespace dollytrack
