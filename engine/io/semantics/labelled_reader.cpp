#include "engine/io/semantics/labelled_reader.h"

#include "engine/core/clean_text.h"
#include "engine/core/object_names.h"
#include "engine/core/text_lists.h"
#include "engine/io/files/confined_folder.h"
#include "engine/io/files/file_type.h"
#include "engine/io/files/input_file.h"
#include "engine/io/models/model_reader.h"
#include "engine/io/models/ply_mesh.h"
#include "engine/io/raw_scene/mesh_part_builder.h"
#include "engine/io/semantics/colored_mesh.h"
#include "engine/io/semantics/label_transfer.h"
#include "engine/io/semantics/labelled_faces.h"
#include "engine/io/semantics/name_list.h"
#include "engine/scene/label_table.h"
#include "engine/scene/labels.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace dollytrack::semantics {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMostMeshBytes = std::uint64_t{4} << 30U;

Result<PlyMesh> readPlyMesh(const fs::path& path) {
    const Result<std::string> bytes = readNamedFile(path, kMostMeshBytes);
    if (!bytes) return tl::unexpected(bytes.error());
    return parsePlyMesh(*bytes, path);
}

/// Adds labelled objects with unique names to a scene.
class ObjectList {
  public:
    explicit ObjectList(RawScene& scene) : scene_(scene) {}

    void add(const LabelledObject& labelled, std::vector<std::size_t> parts) {
        if (parts.empty()) return;
        SourceObject object;
        object.category = labelled.category;
        object.nyu40 = labelled.nyu40;
        object.structure = !labelled.target || isStructureClass(labelled.nyu40);
        std::string base = labelled.category;
        if (base.empty() && labelled.nyu40 > 0) base = nyu40Name(labelled.nyu40);
        if (base.empty()) {
            base = labelled.number < 0 ? "object" : fmt::format("instance_{}", labelled.number);
        }
        if (!labelled.target) base = labelled.nyu40 > 0 ? base + " specks" : "unlabelled";
        object.name = names_.next(base);
        object.parts = std::move(parts);
        for (const std::size_t part : object.parts) {
            scene_.nodes[scene_.parts[part].node].name = object.name;
        }
        if (!labelled.target && labelled.nyu40 == 0) ++unlabelled_;
        scene_.objects.push_back(std::move(object));
    }

    void note(const fs::path& names) const {
        const std::size_t targets = scene_.objects.size() - unlabelled_;
        scene_.notes.push_back(fmt::format(
            "{} by the labels of {}", counted(targets, "object", "objects"),
            names.empty() ? std::string("the file itself") : names.filename().string()));
    }

  private:
    RawScene& scene_;
    ObjectNames names_;
    std::size_t unlabelled_ = 0;
};

RawScene sceneOf(const PlyMesh& mesh, const LabelledFaces& faces, const fs::path& names) {
    RawScene scene;
    std::vector<std::vector<std::size_t>> of_object(faces.objects.size());
    for (std::size_t f = 0; f < faces.of_face.size(); ++f) of_object[faces.of_face[f]].push_back(f);
    const std::vector<std::size_t> first = firstIndices(mesh);
    ObjectList list(scene);
    for (std::size_t i = 0; i < of_object.size(); ++i) {
        const std::size_t part = addPlyPart(mesh, of_object[i], first, "", scene);
        if (scene.parts[part].triangles.empty()) continue;
        list.add(faces.objects[i], {part});
    }
    list.note(names);
    return scene;
}

Status checkCount(const LabelledFaces& faces, const fs::path& path) {
    constexpr std::size_t kMostObjects = 100'000;
    if (faces.objects.size() <= kMostObjects) return {};
    return fail(ErrorCode::BadInput,
                fmt::format("its labels define {} objects, but at most {} can be read; check that "
                            "they number objects, not faces",
                            faces.objects.size(), kMostObjects),
                path.string());
}

/// Notes that ARKitScenes' object boxes, which are beside a mesh without labels, are not read.
void noteBoxes(const fs::path& mesh, RawScene& scene) {
    constexpr std::string_view kEnding = "_3dod_mesh.ply";
    std::string name = mesh.filename().string();
    if (!name.ends_with(kEnding)) return;
    name.replace(name.size() - kEnding.size(), kEnding.size(), "_3dod_annotation.json");
    if (!hasFile(mesh.parent_path() / name)) return;
    scene.notes.push_back("the boxes of " + cleanText(name) +
                          " are not read; objects are found by their shape");
}

/// Notes integer properties that were not read, because they may be labels under an unknown name.
void noteUnreadNumbers(const PlyMesh& mesh, RawScene& scene) {
    if (mesh.unread_numbers.empty()) return;
    scene.notes.push_back(
        "whole numbers that were not read as labels: " + listOf(mesh.unread_numbers, 5) +
        "; call the property object_id if they number objects, label if classes");
}

}  // namespace

Result<RawScene> readLabelled(const LabelledFiles& files, const JobContext& job) {
    const Result<LabelNames> names = readLabelNames(files);
    if (!names) return tl::unexpected(names.error());
    const bool is_ply = lowerExtension(files.labelled) == ".ply";
    Result<PlyMesh> mesh =
        is_ply ? readPlyMesh(files.labelled) : readColoredMesh(files.labelled, *names, job);
    if (!mesh) return tl::unexpected(mesh.error());
    if (job.cancelled()) return fail(ErrorCode::Cancelled, "import was cancelled");
    if (files.kind == LabelFileKind::HabitatText && is_ply && mesh->face_objects.empty() &&
        mesh->colors.size() == mesh->positions.size()) {
        for (const Eigen::Vector3f& color : mesh->colors) {
            const auto found = names->of_color.find(packedColor(color));
            mesh->position_objects.push_back(found == names->of_color.end() ? -1 : found->second);
        }
    }
    const bool other = !files.textured.empty() && files.textured != files.labelled;
    bool same_vertices = false;
    if (other && is_ply && lowerExtension(files.textured) == ".ply") {
        Result<PlyMesh> textured = readPlyMesh(files.textured);
        if (!textured) return tl::unexpected(textured.error());
        same_vertices = textured->positions.size() == mesh->positions.size();
        if (same_vertices) mesh->colors = std::move(textured->colors);
    }
    if (!names->segments.empty() && names->segments.size() != mesh->positions.size()) {
        return fail(ErrorCode::BadInput,
                    fmt::format("it lists segments of {} vertices, but the mesh has {}; the two "
                                "files do not belong together",
                                names->segments.size(), mesh->positions.size()),
                    files.segments.string());
    }
    mesh->face_classes_are_nyu40 |= files.nyu40;
    mesh->position_classes_are_nyu40 |= files.nyu40;
    const std::optional<LabelledFaces> faces = labelFaces(*mesh, *names);
    if (!faces) {
        return fail(ErrorCode::BadInput,
                    "the labelled mesh has no object numbers (object_id, label); download it again "
                    "together with the file with the object names",
                    files.labelled.string());
    }
    if (Status few = checkCount(*faces, files.labelled); !few) return tl::unexpected(few.error());
    RawScene scene = sceneOf(*mesh, *faces, files.names);
    if (other && !same_vertices) {
        Result<RawScene> textured = readModel(files.textured, job);
        if (!textured) return textured;
        scene = transferLabels(std::move(scene), std::move(*textured), job);
        scene.file_up_axis = UpAxis();  // these datasets use z up in glTF as well
    } else if (!is_ply) {
        scene.notes.push_back(
            "the mesh with the room's colours is not beside the labelled mesh; objects have flat "
            "colours");
    }
    if (job.cancelled()) return fail(ErrorCode::Cancelled, "import was cancelled");
    return scene;
}

Result<RawScene> readPly(const fs::path& path, const JobContext& job) {
    const Result<PlyMesh> mesh = readPlyMesh(path);
    if (!mesh) return tl::unexpected(mesh.error());
    if (job.cancelled()) return fail(ErrorCode::Cancelled, "import was cancelled", path.string());
    LabelNames names;
    std::optional<fs::path> list = findNameList(path);
    std::string list_fault;
    if (list) {
        auto read = readNameList(*list);
        if (read) {
            names.categories = std::move(*read);
        } else {
            list_fault = "the names in " + cleanText(list->filename().string()) +
                         " were not read: " + read.error().message;
            list.reset();
        }
    }
    const std::optional<LabelledFaces> faces = labelFaces(*mesh, names);
    if (!faces || faces->objects.size() < 2) {
        RawScene scene = sceneOfPly(*mesh);
        noteBoxes(path, scene);
        noteUnreadNumbers(*mesh, scene);
        return scene;
    }
    if (Status few = checkCount(*faces, path); !few) return tl::unexpected(few.error());
    RawScene scene = sceneOf(*mesh, *faces, list.value_or(fs::path()));
    if (!list_fault.empty()) scene.warnings.push_back(list_fault);
    if (!list && !faces->classes_are_nyu40) {
        scene.notes.push_back(
            "the file has numbers of objects or classes without names; name them in " +
            cleanText(path.stem().string()) + ".labels.json ({\"3\": \"chair\"}) beside it");
    }
    return scene;
}

}  // namespace dollytrack::semantics
