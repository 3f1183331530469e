#include "engine/io/datasets/front3d_reader.h"

#include "engine/core/text_lists.h"
#include "engine/io/datasets/front3d_architecture.h"
#include "engine/io/datasets/front3d_furniture.h"
#include "engine/io/datasets/front3d_scene.h"
#include "engine/io/datasets/model_info.h"
#include "engine/io/datasets/model_library.h"
#include "engine/io/files/bounded_json.h"
#include "engine/io/files/file_type.h"
#include "engine/io/settings/import_labels.h"

#include <algorithm>
#include <array>
#include <set>

namespace dollytrack {
namespace {

/// Notes the content of rooms that is not used.
void noteRooms(const Front3dScene& source, const nlohmann::json& document, RawScene& scene) {
    if (!source.rooms.empty()) {
        scene.notes.push_back(counted(source.rooms.size(), "room: ", "rooms: ") +
                              listOf(source.rooms, 100));
    }
    std::set<std::string> known;
    for (const Front3dFurniture& piece : source.furniture) known.insert(piece.uid);
    std::set<std::string> meshes;
    for (const nlohmann::json& mesh : listIn(document, "mesh")) meshes.insert(textIn(mesh, "uid"));
    std::size_t nothing = 0;
    std::size_t moved = 0;
    for (const Front3dChild& child : source.children) {
        if (known.contains(child.ref)) continue;
        if (meshes.contains(child.ref)) {
            moved += child.moved;
        } else {
            ++nothing;
        }
    }
    const auto note = [&](std::size_t count, const char* one, const char* many) {
        if (count > 0) scene.notes.push_back(counted(count, one, many));
    };
    note(nothing, "entry of the rooms names neither furniture nor mesh",
         "entries of the rooms name neither furniture nor mesh");
    note(
        moved,
        "mesh has a placement, which is not applied: meshes are already in the house's coordinates",
        "meshes have placements, which are not applied: meshes are already in the house's "
        "coordinates");
    note(source.moved_rooms, "room has a placement of its own, which is not applied",
         "rooms have placements of their own, which are not applied");
    if (source.bad_children > 0) {
        scene.warnings.push_back(counted(
            source.bad_children, "entry of the rooms has an invalid placement; it was left out",
            "entries of the rooms have invalid placements; they were left out"));
    }
}

std::vector<std::filesystem::path> pictureFolders(const std::filesystem::path& scene,
                                                  const ImportOptions& options) {
    return foldersFor(scene, options.model_folders, {"3D-FRONT-texture"});
}

std::vector<std::filesystem::path> front3dModelFolders(const std::filesystem::path& scene,
                                                       const ImportOptions& options) {
    return foldersFor(scene, options.model_folders,
                      {"3D-FUTURE-model", "3D-FUTURE-model-part1", "3D-FUTURE-model-part2",
                       "3D-FUTURE-model-part3", "3D-FUTURE-model-part4"});
}

}  // namespace

bool likeFront3d(std::string_view head) {
    if (firstLetter(head) != '{') return false;
    static constexpr std::array<std::string_view, 8> kKeys = {
        "\"uid\"",          "\"jobid\"",     "\"design_version\"", "\"code_version\"",
        "\"north_vector\"", "\"furniture\"", "\"mesh\"",           "\"scene\""};
    return std::any_of(kKeys.begin(), kKeys.end(), [&](std::string_view key) {
        return head.find(key) != std::string_view::npos;
    });
}

Result<RawScene> readFront3dScene(const std::filesystem::path& path, const ImportOptions& options,
                                  const JobContext& job) {
    const Result<LabelTable> labels = labelsOf(options);
    if (!labels) return tl::unexpected(labels.error());
    const Result<nlohmann::json> document = readBoundedJson(path);
    if (!document) return tl::unexpected(document.error());
    const Result<Front3dScene> source = parseFront3d(*document, path.string());
    if (!source) return tl::unexpected(source.error());

    RawScene scene;
    scene.file_unit_m = 1.0;
    scene.file_up_axis = 'y';
    scene.nodes.push_back({"", -1, 0});
    noteRooms(*source, *document, scene);
    addFront3dArchitecture(*document, *labels, pictureFolders(path, options), scene);
    if (job.cancelled()) return fail(ErrorCode::Cancelled, "import was cancelled", path.string());
    const std::vector<std::filesystem::path> folders = front3dModelFolders(path, options);
    if (Status added = addFront3dFurniture(*source, *labels, folders, path.string(), job, scene);
        !added) {
        return tl::unexpected(added.error());
    }
    if (scene.materials.empty()) scene.materials.emplace_back();
    if (scene.objects.empty()) {
        std::string message = "The 3D-FRONT scene contains nothing that can be drawn";
        for (const std::string& warning : scene.warnings) message += "; " + warning;
        return fail(ErrorCode::BadInput, message + ".", path.string());
    }
    return scene;
}

std::vector<std::filesystem::path> front3dInputs(const std::filesystem::path& path,
                                                 const ImportOptions& options) {
    const std::vector<std::filesystem::path> models = front3dModelFolders(path, options);
    std::vector<std::filesystem::path> inputs = pictureFolders(path, options);
    inputs.insert(inputs.end(), models.begin(), models.end());
    const std::vector<std::filesystem::path> beside = modelInfoBeside(models);
    inputs.insert(inputs.end(), beside.begin(), beside.end());
    return inputs;
}

}  // namespace dollytrack
