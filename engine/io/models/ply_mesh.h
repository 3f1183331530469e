#pragma once

#include "engine/core/result.h"
#include "engine/io/raw_scene/raw_scene.h"

#include <Eigen/Core>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dollytrack {

/// The unchecked mesh of a PLY file, with the label numbers of its faces or vertices.
struct PlyMesh {
    std::vector<Eigen::Vector3f> positions;
    std::vector<Eigen::Vector3f> normals;  // empty, or one per position
    std::vector<Eigen::Vector3f> uvs;      // empty, or one per position; z unused
    std::vector<Eigen::Vector3f> colors;   // empty, or one per position; sRGB, 0 to 1
    std::vector<std::uint32_t> face_sizes;
    std::vector<std::uint32_t> face_indices;
    /// Object and class numbers by face or by position; empty if the file has none; -1 for values
    /// that are not integers.
    std::vector<std::int64_t> face_objects;
    std::vector<std::int64_t> face_classes;
    std::vector<std::int64_t> position_objects;
    std::vector<std::int64_t> position_classes;
    // Whether the class numbers are NYU40's; otherwise they are the file's own.
    bool face_classes_are_nyu40 = false;
    bool position_classes_are_nyu40 = false;
    std::string texture;  // file name; empty: none
    UpAxis up_axis;       // usual for the program that wrote the file; unknown for most programs
    /// Names of other integer properties, such as "segment of faces".
    std::vector<std::string> unread_numbers;
};

/// Parses text and binary files of either byte order. `path` is for errors. Error: BadInput.
[[nodiscard]] Result<PlyMesh> parsePlyMesh(std::string_view bytes,
                                           const std::filesystem::path& path);

/// The mesh as a scene of one part.
[[nodiscard]] RawScene sceneOfPly(const PlyMesh& mesh);

/// Adds the faces with these indices to `scene`, as a part under a new node. Vertex colours become a
/// texture. `first_index` must be the result of firstIndices(mesh). Returns the part's index.
std::size_t addPlyPart(const PlyMesh& mesh, std::span<const std::size_t> faces,
                       std::span<const std::size_t> first_index, const std::string& name,
                       RawScene& scene);

/// The index of each face's first corner in PlyMesh::face_indices.
[[nodiscard]] std::vector<std::size_t> firstIndices(const PlyMesh& mesh);

}  // namespace dollytrack
