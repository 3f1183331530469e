#pragma once

#include "engine/core/result.h"
#include "engine/io/files/reachable_files.h"
#include "engine/io/raw_scene/raw_scene.h"
#include "engine/io/settings/import_options.h"
#include "engine/jobs/job.h"

#include <Eigen/Geometry>

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack::gazebo {

/// A visual of a link: a mesh file or a primitive shape.
struct Visual {
    enum class Shape { Mesh, Box, Cylinder, Sphere, Plane };
    Shape shape = Shape::Mesh;
    Eigen::Vector3d size = Eigen::Vector3d::Ones();   // shapes: size of the bounding box, m
    Eigen::Vector3d scale = Eigen::Vector3d::Ones();  // meshes
    std::string uri;                                  // meshes
    std::string submesh;                              // only the mesh of this name; empty: all
    bool center_submesh = false;   // moves the centre of its bounding box to the mesh's origin
    std::filesystem::path folder;  // of the file that refers to the mesh
    Eigen::Affine3d scene_from_visual = Eigen::Affine3d::Identity();
    std::optional<Eigen::Vector4f> color;  // linear red, green, blue; opacity
    float opacity = 1.0F;                  // above 0; multiplies that of the colour or the mesh
};

/// Number of visuals with an unsupported shape, by element name.
using UnknownShapes = std::map<std::string, std::size_t>;

/// The parts of a scene that are left out.
struct OmittedParts {
    std::vector<std::string> models;  // that were not found
    UnknownShapes shapes;
    std::vector<std::string> doubts;  // warnings, each with file and line
};

/// A link, or several that are connected by joints.
struct LinkObject {
    std::string name;  // clean text
    std::vector<Visual> visuals;
};

/// Finds the files of model://, package://, file:// and plain names in the folders that may be
/// read. Not thread-safe.
class ModelPath {
  public:
    explicit ModelPath(ReachableFiles files) : files_(std::move(files)) {}

    /// The file that `uri`, written in a file of `folder`, refers to; nullopt if it is not found.
    [[nodiscard]] std::optional<std::filesystem::path> find(const std::filesystem::path& folder,
                                                            const std::string& uri) const;
    /// Whether this file or folder may be read.
    [[nodiscard]] bool reaches(const std::filesystem::path& path) const {
        return files_.reaches(path);
    }
    /// The description of the model that an <include> names: a file, or that of a folder with a
    /// model.config or model.sdf. Models of Gazebo Fuel are searched for among downloaded ones.
    [[nodiscard]] std::optional<std::filesystem::path> findModel(
        const std::filesystem::path& folder, const std::string& uri) const;

    /// Why find() did not find a mesh.
    enum class Absence {
        NoFolder,   // the folder that its address names is not there either
        NoFile,     // only the file is not there
        OtherCase,  // a file is there whose name differs in upper and lower case
    };
    [[nodiscard]] Absence absenceOf(const std::filesystem::path& folder,
                                    const std::string& uri) const;

  private:
    /// The folders in which a model or package is searched for: the given ones and those around
    /// `folder`.
    [[nodiscard]] std::vector<std::filesystem::path> rootsFor(
        const std::filesystem::path& folder) const;
    const std::string& nameOf(const std::filesystem::path& config) const;

    ReachableFiles files_;
    mutable std::map<std::filesystem::path, std::string> names_;  // cache of nameOf()
};

/// The folders in which a world or robot may refer to files: those of the options, its own,
/// `models`, `meshes` and the like beside it, its package and, for a model, the folder that
/// contains the model's folder.
[[nodiscard]] std::vector<std::filesystem::path> foldersOfWorld(const std::filesystem::path& scene,
                                                                const ImportOptions& options);

/// Builds a scene of the links: z up, metres. Missing meshes and submeshes, and the parts in
/// `left_out`, become warnings; nothing replaces them. `where` is the file in errors. Errors:
/// BadInput if there is nothing to draw or too many triangles; Cancelled.
[[nodiscard]] Result<RawScene> sceneOfLinks(const std::vector<LinkObject>& links,
                                            const ModelPath& files, const OmittedParts& left_out,
                                            const std::string& where, const JobContext& job);

}  // namespace dollytrack::gazebo
