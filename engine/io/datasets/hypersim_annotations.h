#pragma once

#include "engine/core/result.h"

#include <Eigen/Core>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack::io {

/// A box around a semantic instance, as it is annotated: in asset units, z up.
struct HypersimBox {
    Eigen::Vector3d center;
    Eigen::Vector3d size;  // along its own axes
    Eigen::Matrix3d world_from_object;
};

/// What a Hypersim scene's _detail folder says: which mesh is what. One entry an object of the OBJ
/// file, in its order; the meshes themselves are bought elsewhere.
struct HypersimAnnotations {
    std::filesystem::path folder;           // that holds metadata_objects.csv
    std::vector<std::string> objects;       // names of the OBJ file's objects, as they are
    std::vector<int> nyu40;                 // 1..40; 0: not labelled
    std::vector<int> instance;              // semantic instance, 1..; 0: none
    std::optional<double> meters_per_unit;  // of the asset
    std::vector<std::string> cameras;       // clean text
    std::map<int, HypersimBox> boxes;       // by semantic instance
};

/// The folder with metadata_objects.csv in a scene's folder (ai_VVV_NNN), its _detail or
/// _detail/mesh; empty where there is none.
std::filesystem::path findHypersimMesh(const std::filesystem::path& folder);

/// Reads metadata_objects.csv and mesh_objects_si/sii.hdf5, and where they are there the scene's
/// unit, cameras and boxes. Errors: BadInput.
Result<HypersimAnnotations> readHypersimAnnotations(const std::filesystem::path& mesh_folder);

/// What readHypersimAnnotations() opens.
std::vector<std::filesystem::path> hypersimInputs(const std::filesystem::path& mesh_folder);

/// One sentence that says what is there and that the geometry is not; empty when the folder is no
/// scene of Hypersim.
std::string describeHypersimFolder(const std::filesystem::path& folder);

}  // namespace dollytrack::io
