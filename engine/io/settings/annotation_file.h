#pragma once

#include "engine/core/result.h"
#include "engine/math/up_axis.h"

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack::io {

/// Some triangles of a mesh, counted as they are read: triangles without area are gone by then,
/// polygons are cut.
struct AnnotatedTriangles {
    std::string mesh;  // its name, or that of its node
    std::size_t first = 0;
    std::size_t count = 0;
};

/// What a person says is one thing.
struct AnnotatedObject {
    std::string name;
    std::vector<std::string> nodes;  // with all below them
    std::vector<std::string> meshes;
    std::vector<AnnotatedTriangles> triangles;
    std::string category;                  // a word for its class, as label tables have them
    std::optional<int> nyu40;              // 0..40
    bool structure = false;                // part of the building
    std::optional<Eigen::Vector3d> front;  // in the file's axes
};

/// What stands on, lies in or hangs on what; objects by their names.
struct AnnotatedRelation {
    std::string object;
    std::string relation;  // "on", "in" or "hangs_on"
    std::string holder;
};

/// A person's own words about a scene file: the JSON file that lies beside it.
struct Annotations {
    std::filesystem::path file;  // empty: there is none
    std::optional<double> unit_m;
    std::optional<UpAxis> up_axis;
    std::vector<AnnotatedObject> objects;
    std::vector<AnnotatedRelation> relations;
    std::vector<std::string> doubts;                    // keys that look like slips, in words
    nlohmann::json edits;                               // as in a project: see edits_json.h
    nlohmann::json content = nlohmann::json::object();  // all of it, for keys we do not know
};

/// Where the annotations of a scene lie: room.glb.objects.json beside room.glb.
[[nodiscard]] std::filesystem::path annotationFileOf(const std::filesystem::path& scene);

/// Errors: BadInput, with the file and the place in it ("room.glb.objects.json: objects[2].front").
Result<Annotations> readAnnotations(const std::filesystem::path& file);

/// Those of `given` if it is a file, else of the file beside the scene, else none. Errors: as
/// above.
Result<Annotations> findAnnotations(const std::filesystem::path& scene,
                                    const std::optional<std::filesystem::path>& given);

/// A file with these settings (`unit_m`, `up_axis`, as a project's section `import` has them) and
/// edits. What else an earlier content of it says stays. `edits` is as editsJson() makes it.
[[nodiscard]] std::string annotationText(const nlohmann::json& earlier,
                                         const nlohmann::json& import, const nlohmann::json& edits);

/// Writes the file whole or not at all, over what an earlier one says. Errors: BadInput for an
/// earlier one that cannot be read, CannotWrite.
Status writeAnnotations(const std::filesystem::path& file, const nlohmann::json& import,
                        const nlohmann::json& edits);

}  // namespace dollytrack::io
