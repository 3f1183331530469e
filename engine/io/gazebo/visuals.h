#pragma once

#include "engine/core/result.h"
#include "engine/io/import/raw_scene.h"
#include "engine/io/import/scene_import.h"
#include "engine/io/sandbox/reachable_files.h"
#include "engine/jobs/job.h"

#include <Eigen/Geometry>

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack::gazebo {

/// What a link shows: a mesh of a file, or a shape of numbers alone, in the link's frame.
struct Visual {
    enum class Shape { Mesh, Box, Cylinder, Sphere, Plane };
    Shape shape = Shape::Mesh;
    Eigen::Vector3d size = Eigen::Vector3d::Ones();   // of shapes: x, y, z of the box around it, m
    Eigen::Vector3d scale = Eigen::Vector3d::Ones();  // of meshes
    std::string uri;                                  // of meshes
    std::string submesh;                              // the mesh of that name alone; empty: all
    bool center_submesh = false;   // move the middle of its bounding box to the mesh's origin
    std::filesystem::path folder;  // of the file that names the mesh
    Eigen::Affine3d scene_from_visual = Eigen::Affine3d::Identity();
    std::optional<Eigen::Vector4f> color;  // linear red, green, blue; opacity
    float opacity = 1.0F;                  // above 0; multiplies the colour's or the mesh's own
};

/// How many visuals have a shape that is not read, by the element's name.
using UnknownShapes = std::map<std::string, std::size_t>;

/// The parts of a scene that are left out.
struct LeftOut {
    std::vector<std::string> models;  // that were not found
    UnknownShapes shapes;
    std::vector<std::string> doubts;  // a sentence each, with the place in its file
};

/// A link, or several that joints hold together.
struct LinkObject {
    std::string name;  // clean text
    std::vector<Visual> visuals;
};

/// Looks up what model://, package://, file:// and plain names mean, below the folders that may be
/// read. For one thread.
class ModelPath {
  public:
    explicit ModelPath(io::ReachableFiles files) : files_(std::move(files)) {}

    /// The file that a name in a file of `folder` means.
    [[nodiscard]] std::optional<std::filesystem::path> find(const std::filesystem::path& folder,
                                                            const std::string& uri) const;
    /// Whether this file or folder may be read.
    [[nodiscard]] bool reaches(const std::filesystem::path& path) const {
        return files_.reaches(path);
    }
    /// The description of the model that an <include> names: a file, or a folder with a
    /// model.config or model.sdf. Addresses of Gazebo Fuel are looked up among downloaded models.
    [[nodiscard]] std::optional<std::filesystem::path> findModel(
        const std::filesystem::path& folder, const std::string& uri) const;

  private:
    const std::string& nameOf(const std::filesystem::path& config) const;

    io::ReachableFiles files_;
    mutable std::map<std::filesystem::path, std::string> names_;  // in files read so far
};

/// The folders that a world or robot may name files of: those of the options, `models`, `meshes`
/// and the like beside it, the package that it lies in and, of a model, the folder of models around
/// it.
[[nodiscard]] std::vector<std::filesystem::path> foldersOfWorld(const std::filesystem::path& scene,
                                                                const ImportOptions& options);

/// Makes a scene of the links: z up, metres. Meshes and submeshes that are not there, and what is
/// left out already, are named in warnings, and nothing stands in their place. Errors: BadInput,
/// when there is nothing to draw; Cancelled.
[[nodiscard]] Result<RawScene> sceneOfLinks(const std::vector<LinkObject>& links,
                                            const ModelPath& files, const LeftOut& left_out,
                                            const std::string& where, const JobContext& job);

}  // namespace dollytrack::gazebo
