#pragma once

#include "engine/core/result.h"

#include <Eigen/Core>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack {

/// The annotated box of a semantic instance, in asset units, z up.
struct HypersimBox {
    Eigen::Vector3d center;
    Eigen::Vector3d size;  // along its own axes
    Eigen::Matrix3d world_from_object;
};

/// The content of a Hypersim scene's _detail folder. `objects`, `nyu40` and `instance` have one
/// entry per object of the OBJ file, in its order; the OBJ file itself is sold separately.
struct HypersimAnnotations {
    std::filesystem::path folder;           // with metadata_objects.csv
    std::vector<std::string> objects;       // names of the OBJ file's objects, unchanged
    std::vector<int> nyu40;                 // 1..40; 0: not labelled
    std::vector<int> instance;              // semantic instance, 1..; 0: none
    std::optional<double> meters_per_unit;  // of the asset
    std::vector<std::string> cameras;       // clean text
    std::map<int, HypersimBox> boxes;       // by semantic instance
};

/// The folder with metadata_objects.csv: a scene's folder (ai_VVV_NNN), its _detail or
/// _detail/mesh; empty if there is none.
std::filesystem::path findHypersimMesh(const std::filesystem::path& folder);

/// Reads metadata_objects.csv and mesh_objects_si/sii.hdf5 and, if they exist, the scene's unit,
/// cameras and boxes. Error: BadInput.
Result<HypersimAnnotations> readHypersimAnnotations(const std::filesystem::path& mesh_folder);

/// The files that readHypersimAnnotations() opens.
std::vector<std::filesystem::path> hypersimInputs(const std::filesystem::path& mesh_folder);

/// A sentence about the content of a Hypersim folder without geometry; empty for other folders.
std::string describeHypersimFolder(const std::filesystem::path& folder);

}  // namespace dollytrack
