#pragma once

#include "engine/core/result.h"
#include "engine/math/up_axis.h"

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack {

/// A range of triangles of a mesh, counted after polygons are triangulated and triangles without
/// area dropped.
struct AnnotatedTriangles {
    std::string mesh;  // name of the mesh or of its node
    std::size_t first = 0;
    std::size_t count = 0;
};

/// An object defined in an annotation file.
struct AnnotatedObject {
    std::string name;
    std::vector<std::string> nodes;  // with all nodes below them
    std::vector<std::string> meshes;
    std::vector<AnnotatedTriangles> triangles;
    std::string category;                  // class name in the label tables
    std::optional<int> nyu40;              // 0..40
    bool structure = false;                // part of the building
    std::optional<Eigen::Vector3d> front;  // in the file's axes
};

/// A relation of two objects, given by their names: `object` stands on, lies in or hangs on
/// `holder`.
struct AnnotatedRelation {
    std::string object;
    std::string relation;  // "on", "in" or "hangs_on"
    std::string holder;
};

/// The content of an annotation file (assets/schemas/objects.schema.json).
struct Annotations {
    std::filesystem::path file;  // empty: there is none
    std::optional<double> unit_m;
    std::optional<UpAxis> up_axis;
    std::vector<AnnotatedObject> objects;
    std::vector<AnnotatedRelation> relations;
    std::vector<std::string> doubts;                    // warnings about misspelt keys
    nlohmann::json edits;                               // as in a project: see edits_json.h
    nlohmann::json content = nlohmann::json::object();  // the whole file, with unknown keys
};

/// Path of a scene's annotation file: room.glb.objects.json beside room.glb.
[[nodiscard]] std::filesystem::path annotationFileOf(const std::filesystem::path& scene);

/// Reads an annotation file. Error: BadInput, with file and field ("room.glb.objects.json:
/// objects[2].front").
Result<Annotations> readAnnotations(const std::filesystem::path& file);

/// Reads `given` if it is a file, otherwise the file beside the scene; Annotations::file is empty
/// if there is neither. Error: as above.
Result<Annotations> findAnnotations(const std::filesystem::path& scene,
                                    const std::optional<std::filesystem::path>& given);

/// The text of an annotation file with `unit_m` and `up_axis` of a project's section `import` and
/// with `edits` (see editsJson()). All other content of `earlier` is kept.
[[nodiscard]] std::string annotationText(const nlohmann::json& earlier,
                                         const nlohmann::json& import, const nlohmann::json& edits);

/// Writes an annotation file atomically; other content of an existing file is kept. Errors:
/// BadInput if the existing file cannot be read, CannotWrite.
Status writeAnnotations(const std::filesystem::path& file, const nlohmann::json& import,
                        const nlohmann::json& edits);

}  // namespace dollytrack
