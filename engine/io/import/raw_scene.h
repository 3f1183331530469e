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

/// One mesh under one node: one material, checked (every index valid, every number finite, no
/// triangle without area) and placed, in the source's own axes and unit.
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

/// A picture a material asks for: a path as the file writes it, or bytes inside the file.
struct TextureRequest {
    std::string name;                    // byte for byte, as it has to be found on disk
    std::vector<std::uint8_t> embedded;  // an encoded file, or width x height RGBA
    int embedded_width = 0;              // of raw RGBA; 0: encoded, or not embedded
    int embedded_height = 0;
    bool opaque = true;            // no material uses its alpha
    std::filesystem::path folder;  // where the name is looked up; empty: the scene's own
    bool only_there = false;       // a file of that name in another folder is another picture
};

/// Units from the origin. Further away there is no room, and squares of squares are no numbers
/// any more.
constexpr float kFarthest = 1e9F;

struct RepairCounts {
    std::size_t bad_numbers = 0;   // triangles with NaN or infinity
    std::size_t too_far = 0;       // triangles that reach further than kFarthest
    std::size_t bad_indices = 0;   // triangles that name a vertex that is not there
    std::size_t no_area = 0;       // triangles and polygons without area
    std::size_t approximate = 0;   // polygons that cross themselves
    std::size_t polygons = 0;      // faces of four corners or more
    std::size_t lines = 0;         // points and lines, which cannot be seen
    std::size_t made_normals = 0;  // meshes without normals
    std::size_t mirrored = 0;      // parts under a mirroring transform

    void add(const RepairCounts& other);
};

/// One thing as the source itself tells things apart: an instance of a data set, a piece of
/// furniture of a home.
struct SourceObject {
    std::string name;                      // clean text
    std::string category;                  // the source's word for its class, for the label tables
    int nyu40 = 0;                         // 0: found by the category, else by the name
    bool structure = false;                // part of the building; else its word for it may say so
    std::vector<std::size_t> parts;        // indices into RawScene::parts
    std::optional<Eigen::Vector3d> front;  // horizontal, in the source's axes
};

/// What a file holds, before anything is guessed about it.
struct RawScene {
    std::vector<SourceNode> nodes;  // parents before children
    std::vector<MeshPart> parts;
    std::vector<SourceObject> objects;  // empty: they are found from nodes and shapes
    std::vector<Material> materials;
    std::vector<TextureRequest> textures;
    RepairCounts repairs;
    std::optional<double> file_unit_m;  // from metadata
    UpAxis file_up_axis;                // not known: the format does not say
    /// Where the reader turned or moved what the file says: back to the file's own axes and unit.
    Eigen::Affine3d file_from_parts = Eigen::Affine3d::Identity();
    std::vector<std::string> notes;
    std::vector<std::string> warnings;  // what is missing or doubtful: the user should look
};

}  // namespace dollytrack
