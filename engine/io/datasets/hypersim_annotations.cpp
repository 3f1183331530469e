#include "engine/io/datasets/hypersim_annotations.h"

#include "engine/core/clean_text.h"
#include "engine/core/text_lists.h"
#include "engine/io/files/confined_folder.h"
#include "engine/io/files/number_lines.h"
#include "engine/io/hdf5/hdf5_reader.h"
#include "engine/scene/labels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace dollytrack {
namespace {

namespace fs = std::filesystem;

constexpr const char* kObjects = "metadata_objects.csv";
constexpr const char* kScene = "metadata_scene.csv";
constexpr const char* kCameras = "metadata_cameras.csv";
constexpr std::uint64_t kMostAnnotationBytes = std::uint64_t{512} << 20U;
constexpr const char* kBox = "metadata_semantic_instance_bounding_box_object_aligned_2d_";

/// The lines after the header, without surrounding blanks and quotes.
Result<std::vector<std::string>> readColumn(const fs::path& path) {
    const Result<std::string> text = readNamedFile(path, kMostAnnotationBytes);
    if (!text) return tl::unexpected(text.error());
    std::vector<std::string> cells;
    bool header = true;
    for (std::string_view line : splitLines(*text)) {
        while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.remove_suffix(1);
        if (line.size() >= 2 && line.front() == '"' && line.back() == '"') {
            line = line.substr(1, line.size() - 2);
        }
        if (!header && !line.empty()) cells.emplace_back(line);
        header = false;
    }
    return cells;
}

/// One id per object: 1..highest; all other values become 0.
Result<std::vector<int>> readIds(const fs::path& path, std::size_t count, int highest) {
    const Result<Hdf5Numbers> read = readHdf5Numbers(path);
    if (!read) return tl::unexpected(read.error());
    if (read->values.size() != count) {
        return fail(ErrorCode::BadInput,
                    fmt::format("It has {} values for the {} objects of {}.", read->values.size(),
                                count, kObjects),
                    path.string());
    }
    std::vector<int> ids;
    for (const double value : read->values) {
        ids.push_back(value >= 1.0 && value <= highest ? static_cast<int>(value) : 0);
    }
    return ids;
}

/// metadata_scene.csv is in _detail, or beside the objects if the folders were flattened.
fs::path besideOrAbove(const fs::path& mesh_folder, const char* name) {
    for (const fs::path& folder : {mesh_folder.parent_path(), mesh_folder}) {
        if (hasFile(folder / name)) return folder / name;
    }
    return {};
}

Status readUnit(HypersimAnnotations& scene) {
    const fs::path path = besideOrAbove(scene.folder, kScene);
    if (path.empty()) return {};
    const Result<std::vector<std::string>> rows = readColumn(path);
    if (!rows) return tl::unexpected(rows.error());
    for (const std::string& row : *rows) {
        const std::vector<std::string_view> cells = splitWords(row);
        if (cells.size() != 2 || cells[0] != "meters_per_asset_unit") continue;
        const Result<double> unit = parseNumber(cells[1], path, 0);
        if (!unit || !(*unit > 0.0 && *unit < 1e6)) {
            return fail(ErrorCode::BadInput,
                        "meters_per_asset_unit must be a number above 0 and below 1e6.",
                        path.string());
        }
        scene.meters_per_unit = *unit;
    }
    return {};
}

Status readBoxes(HypersimAnnotations& scene) {
    const auto file = [&](const char* what) {
        return scene.folder / (std::string(kBox) + what + ".hdf5");
    };
    if (!hasFile(file("extents"))) return {};
    const Result<Hdf5Numbers> extents = readHdf5Numbers(file("extents"));
    const Result<Hdf5Numbers> positions = readHdf5Numbers(file("positions"));
    const Result<Hdf5Numbers> turns = readHdf5Numbers(file("orientations"));
    for (const Result<Hdf5Numbers>* read : {&extents, &positions, &turns}) {
        if (!*read) return tl::unexpected((*read).error());
    }
    const std::size_t count = extents->values.size() / 3;
    if (extents->values.size() != 3 * count || positions->values.size() != 3 * count ||
        turns->values.size() != 9 * count) {
        return fail(ErrorCode::BadInput,
                    "The boxes' extents, positions and orientations have different lengths.",
                    file("extents").string());
    }
    for (std::size_t i = 1; i < count; ++i) {  // one row per semantic instance
        HypersimBox box;
        box.size = Eigen::Map<const Eigen::Vector3d>(&extents->values[3 * i]);
        box.center = Eigen::Map<const Eigen::Vector3d>(&positions->values[3 * i]);
        box.world_from_object =
            Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(&turns->values[9 * i]);
        const bool good = box.size.allFinite() && box.center.allFinite() &&
                          box.world_from_object.allFinite() && box.size.maxCoeff() > 0.0;
        if (good) scene.boxes[static_cast<int>(i)] = box;
    }
    return {};
}

}  // namespace

fs::path findHypersimMesh(const fs::path& folder) {
    for (const fs::path& place : {folder / "_detail" / "mesh", folder / "mesh", folder}) {
        if (hasFile(place / kObjects)) return place;
    }
    return {};
}

Result<HypersimAnnotations> readHypersimAnnotations(const fs::path& mesh_folder) {
    HypersimAnnotations scene;
    scene.folder = mesh_folder;
    Result<std::vector<std::string>> objects = readColumn(mesh_folder / kObjects);
    if (!objects) return tl::unexpected(objects.error());
    scene.objects = std::move(*objects);
    Result<std::vector<int>> classes =
        readIds(mesh_folder / "mesh_objects_si.hdf5", scene.objects.size(), kNyu40Count);
    if (!classes) return tl::unexpected(classes.error());
    scene.nyu40 = std::move(*classes);
    Result<std::vector<int>> instances =
        readIds(mesh_folder / "mesh_objects_sii.hdf5", scene.objects.size(), 1'000'000'000);
    if (!instances) return tl::unexpected(instances.error());
    scene.instance = std::move(*instances);
    const fs::path cameras = besideOrAbove(mesh_folder, kCameras);
    if (!cameras.empty()) {
        const Result<std::vector<std::string>> names = readColumn(cameras);
        if (!names) return tl::unexpected(names.error());
        for (const std::string& name : *names) scene.cameras.push_back(cleanText(name));
    }
    if (Status unit = readUnit(scene); !unit) return tl::unexpected(unit.error());
    if (Status boxes = readBoxes(scene); !boxes) return tl::unexpected(boxes.error());
    return scene;
}

std::vector<fs::path> hypersimInputs(const fs::path& mesh_folder) {
    const fs::path above = mesh_folder.parent_path();
    return {mesh_folder, above / kScene, above / kCameras};
}

std::string describeHypersimFolder(const fs::path& folder) {
    const fs::path mesh_folder = findHypersimMesh(folder);
    if (mesh_folder.empty()) return {};
    const Result<HypersimAnnotations> read = readHypersimAnnotations(mesh_folder);
    if (!read) {
        return "this is a folder of Hypersim annotations, but they cannot be used (" +
               describe(read.error()) + ")";
    }
    const auto kindsOf = [](const std::vector<int>& ids) {
        std::set<int> kinds(ids.begin(), ids.end());
        kinds.erase(0);
        return kinds.size();
    };
    std::string text = fmt::format(
        "this folder has Hypersim annotations for {} ({} of NYU40, {}), {}{} and {}, but no "
        "geometry",
        counted(read->objects.size(), "mesh", "meshes"),
        counted(kindsOf(read->nyu40), "class", "classes"),
        counted(kindsOf(read->instance), "instance", "instances"),
        read->cameras.empty() ? "no camera" : counted(read->cameras.size(), "camera", "cameras"),
        read->cameras.empty() ? "" : " (" + listOf(read->cameras) + ")",
        read->meters_per_unit ? fmt::format("a unit of {:g} m", *read->meters_per_unit)
                              : "no unit");
    return text +
           "; put the scene's OBJ file, which Evermotion sells, beside it and name that file";
}

}  // namespace dollytrack
