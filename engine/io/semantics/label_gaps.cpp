#include "engine/io/semantics/label_gaps.h"

#include "engine/core/clean_text.h"
#include "engine/core/name_pattern.h"
#include "engine/io/files/confined_folder.h"

#include <fmt/format.h>

#include <array>
#include <optional>

namespace dollytrack::semantics {
namespace {

namespace fs = std::filesystem;

std::string shown(const fs::path& file) {
    return cleanText(file.filename().string());
}

/// A warning if exactly one of two files exists; otherwise empty.
std::string gapBetween(const fs::path& first, const fs::path& second, const char* without) {
    const bool has_first = hasFile(first);
    if (has_first == hasFile(second)) return {};
    return fmt::format("{} exists, but {} is missing, so that {}; download it to the same folder",
                       shown(has_first ? first : second), shown(has_first ? second : first),
                       without);
}

constexpr const char* kNoObjects = "its objects were not read";
constexpr const char* kNoNames = "its objects have no names";

std::string scanNetGap(const fs::path& mesh) {
    const std::string name = mesh.filename().string();
    auto scan = withoutEnding(name, "_vh_clean_2.labels.ply");
    if (!scan) scan = withoutEnding(name, "_vh_clean_2.ply");
    if (!scan) return {};
    const fs::path folder = mesh.parent_path();
    fs::path groups = folder / (*scan + ".aggregation.json");
    const fs::path other = folder / (*scan + "_vh_clean.aggregation.json");
    if (!hasFile(groups) && hasFile(other)) groups = other;
    return gapBetween(groups, folder / (*scan + "_vh_clean_2.0.010000.segs.json"), kNoObjects);
}

std::string scanNetPpGap(const fs::path& mesh) {
    if (!mesh.filename().string().starts_with("mesh_aligned")) return {};
    return gapBetween(mesh.parent_path() / "segments_anno.json",
                      mesh.parent_path() / "segments.json", kNoObjects);
}

/// Replica: labelled mesh and names are in "habitat", below the folder of mesh.ply.
std::string replicaGap(const fs::path& mesh) {
    const bool labelled = mesh.filename() == "mesh_semantic.ply";
    if (!labelled && mesh.filename() != "mesh.ply") return {};
    for (const fs::path& folder : {mesh.parent_path(), mesh.parent_path() / "habitat"}) {
        const fs::path names = folder / "info_semantic.json";
        const fs::path numbers = folder / "mesh_semantic.ply";
        const bool both = hasFile(names) && hasFile(numbers);
        if (labelled && folder == mesh.parent_path() && !both) {
            return gapBetween(names, numbers, kNoNames);
        }
        if (labelled) continue;
        if (both) {
            return fmt::format("this mesh has no labels; open {} to get Replica's objects",
                               cleanText(numbers.lexically_relative(mesh.parent_path()).string()));
        }
        if (std::string gap = gapBetween(names, numbers, kNoObjects); !gap.empty()) return gap;
    }
    return {};
}

/// HM3D and Matterport3D: X.semantic.glb with X.semantic.txt, X.house with X_semantic.ply.
std::string habitatGap(const fs::path& mesh) {
    const std::string name = mesh.filename().string();
    std::optional<std::string> scene;
    for (const char* ending :
         {".semantic.glb", ".basis.glb", "_semantic.ply", ".semantic.ply", ".glb"}) {
        if (!scene) scene = withoutEnding(name, ending);
    }
    if (!scene || scene->empty()) return {};
    const fs::path folder = mesh.parent_path();
    const fs::path text = folder / (*scene + ".semantic.txt");
    if (!hasFile(folder / (*scene + ".semantic.ply"))) {
        std::string gap = gapBetween(text, folder / (*scene + ".semantic.glb"), kNoObjects);
        if (!gap.empty()) return gap;
    }
    // The file name of a mesh without classes does not tell Matterport3D's from others.
    const fs::path numbers = folder / (*scene + "_semantic.ply");
    if (hasFile(text) || hasFile(numbers)) return {};
    return gapBetween(folder / (*scene + ".house"), numbers, kNoObjects);
}

}  // namespace

std::string missingLabelFile(const fs::path& mesh) {
    for (const auto find : {scanNetGap, scanNetPpGap, replicaGap, habitatGap}) {
        if (std::string gap = find(mesh); !gap.empty()) return gap;
    }
    return {};
}

}  // namespace dollytrack::semantics
