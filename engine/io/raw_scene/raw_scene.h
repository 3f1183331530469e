#pragma once

#include "engine/math/up_axis.h"
#include "engine/scene/material.h"
#include "engine/scene/scene.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack {

/// A mesh with one material under a node, in the source's axes and unit. It is checked: all indices
/// are valid, all numbers finite, and no triangle has zero area.
struct MeshPart {
    std::string name;  // the mesh's own name, clean text
    int node = 0;      // index into RawScene::nodes
    std::uint32_t material = 0;
    std::vector<Eigen::Vector3f> positions;
    std::vector<Eigen::Vector3f> normals;
    std::vector<Eigen::Vector2f> uvs;
    std::vector<Triangle> triangles;
    Eigen::AlignedBox3f bounds;
    /// Area of surfaces that face along each source axis within 2 degrees: -x +x -y +y -z +z.
    std::array<double, 6> facing_area{};
    double area = 0.0;
};

struct SourceNode {
    std::string name;  // clean text
    int parent = -1;
    int children = 0;
};

/// A texture that a material uses: a path as written in the file, or an image inside the file
/// (encoded, or raw RGBA if embedded_width is above 0).
struct TextureRequest {
    std::string name;                    // byte for byte as in the file
    std::vector<std::uint8_t> embedded;  // an encoded file, or width x height RGBA
    int embedded_width = 0;              // of raw RGBA; 0: encoded, or not embedded
    int embedded_height = 0;
    bool opaque = true;            // no material uses its alpha
    std::filesystem::path folder;  // in which the name is searched for; empty: the scene's
    bool only_there = false;       // whether files of the same name elsewhere must not be used
};

/// Largest coordinate, in units. The fourth power of larger ones overflows.
constexpr float kFarthest = 1e9F;

struct RepairCounts {
    std::size_t bad_numbers = 0;   // faces with NaN or infinity
    std::size_t too_far = 0;       // faces with a coordinate beyond kFarthest
    std::size_t bad_indices = 0;   // faces with an invalid vertex index
    std::size_t no_area = 0;       // faces without area
    std::size_t approximate = 0;   // self-intersecting polygons
    std::size_t polygons = 0;      // faces with four or more corners
    std::size_t lines = 0;         // points and lines, which are not rendered
    std::size_t made_normals = 0;  // meshes without normals
    std::size_t mirrored = 0;      // parts under a mirroring transform

    void add(const RepairCounts& other);
};

/// An object that the source itself defines: an instance in a dataset, or a piece of furniture in a
/// home.
struct SourceObject {
    std::string name;                      // clean text
    std::string category;                  // the source's class name, for the label tables
    int nyu40 = 0;                         // 0: determined by the category, otherwise by the name
    bool structure = false;                // part of the building; if false, the category decides
    std::vector<std::size_t> parts;        // indices into RawScene::parts
    std::optional<Eigen::Vector3d> front;  // horizontal, in the source's axes
};

/// The content of a scene file as read, before unit, axes and objects are estimated.
struct RawScene {
    std::vector<SourceNode> nodes;  // parents before children
    std::vector<MeshPart> parts;
    std::vector<SourceObject> objects;  // empty: to be found by nodes and shapes
    std::vector<Material> materials;
    std::vector<TextureRequest> textures;
    RepairCounts repairs;
    std::optional<double> file_unit_m;  // from metadata
    UpAxis file_up_axis;                // unknown if the format does not define it
    bool up_is_certain = false;         // the exporter always writes the axis correctly
    /// Transform back to the file's axes and unit, if the reader rotated or moved the scene.
    Eigen::Affine3d file_from_parts = Eigen::Affine3d::Identity();
    std::vector<std::string> notes;
    std::vector<std::string> warnings;  // about missing and doubtful content
};

}  // namespace dollytrack
