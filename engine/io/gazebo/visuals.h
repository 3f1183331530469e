#pragma once

#include "engine/core/result.h"
#include "engine/io/gazebo/model_path.h"
#include "engine/io/raw_scene/raw_scene.h"
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
    std::filesystem::path texture;         // replaces those of the mesh; empty: none
    Eigen::Vector2f texture_scale = Eigen::Vector2f::Ones();  // of the picture; 2: twice as large
    float opacity = 1.0F;  // above 0; multiplies that of the colour or the mesh
};

/// Number of visuals with an unsupported shape, by element name.
using UnknownShapes = std::map<std::string, std::size_t>;

/// The parts of a scene that are left out.
struct OmittedParts {
    std::vector<std::string> models;    // that were not found
    std::vector<std::string> includes;  // names of the <include>s of these models
    std::vector<std::string> scripts;   // names of materials whose scripts were not found
    UnknownShapes shapes;
    std::vector<std::string> doubts;  // warnings, each with file and line
};

/// A link, or several that are connected by joints.
struct LinkObject {
    std::string name;  // clean text
    std::vector<Visual> visuals;
    std::string model = {};  // clean text; empty: none
    int model_number = -1;   // the same for all links of a model; -1: none
};

/// Builds a scene of the links: z up, metres. Missing meshes and submeshes, and the parts in
/// `left_out`, become warnings; nothing replaces them. `where` is the file in errors. Errors:
/// BadInput if there is nothing to draw or too many triangles; Cancelled.
[[nodiscard]] Result<RawScene> sceneOfLinks(const std::vector<LinkObject>& links,
                                            const ModelPath& files, const OmittedParts& left_out,
                                            const std::string& where, const JobContext& job);

}  // namespace dollytrack::gazebo
