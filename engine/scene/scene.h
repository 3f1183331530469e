#pragma once

#include "engine/scene/class_table.h"
#include "engine/scene/import_proposal.h"
#include "engine/scene/material.h"
#include "engine/scene/object.h"

#include <Eigen/Geometry>

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace dollytrack {

using Triangle = std::array<std::uint32_t, 3>;

/// What the import found, repaired, guessed or doubts: one sentence each, for `info` and the log.
struct ImportReport {
    std::vector<std::string> notes;     // choices and repairs worth knowing
    std::vector<std::string> warnings;  // doubts that the user should check
    int textures_found = 0;
    std::vector<std::string> textures_missing;
    double unit_m = 1.0;      // metres per source unit
    std::string unit_source;  // "file", "door height 2.05", "given"
    std::string up_axis;      // "y" | "z" | "x", in the source
    std::string up_source;
    ImportProposal proposal;  // how the file should likely be read instead
};

/// A loaded room in the world's frame: right-handed, z up, metres. Never recentred.
struct Scene {
    std::string name;
    std::filesystem::path source;
    std::string source_sha256;  // of the scene file itself

    std::vector<Eigen::Vector3f> positions;
    std::vector<Eigen::Vector3f> normals;  // unit, one per position
    std::vector<Eigen::Vector2f> uvs;      // one per position; v grows upwards
    std::vector<Triangle> triangles;       // counter-clockwise seen from outside
    std::vector<std::uint32_t> triangle_material;
    std::vector<Material> materials;
    std::vector<Texture> textures;
    std::vector<Object> objects;                    // ordered by id
    std::shared_ptr<const ClassTable> class_table;  // of the user's label file; null: NYU40

    Eigen::Affine3d source_from_world = Eigen::Affine3d::Identity();  // with scale
    Eigen::AlignedBox3d room_bounds;  // the building, without outliers, grounds and skies
    ImportReport report;

    [[nodiscard]] const Object& object(int id) const { return objects[id - 1]; }
    /// The classes that datasets of the scene are written with.
    [[nodiscard]] const ClassTable& classes() const {
        return class_table ? *class_table : ClassTable::nyu40();
    }
};

}  // namespace dollytrack
