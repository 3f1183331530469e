#include "engine/io/semantics/label_files.h"

#include "engine/core/clean_text.h"
#include "engine/core/name_pattern.h"
#include "engine/io/files/bounded_json.h"
#include "engine/io/files/confined_folder.h"
#include "engine/io/files/input_file.h"
#include "engine/io/files/number_lines.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>

namespace dollytrack::semantics {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::uint64_t kMostNameBytes = std::uint64_t{256} << 20U;

constexpr double kMostNumber = 1e15;  // larger integers may have been rounded as doubles

std::optional<std::int64_t> wholeNumber(std::string_view text) {
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    if (!(std::abs(static_cast<double>(value)) < kMostNumber)) return std::nullopt;
    return value;
}

std::optional<std::int64_t> wholeNumber(const json& value) {
    const std::optional<double> number = numberIn(value);
    if (!number || !(std::abs(*number) < kMostNumber) || *number != std::floor(*number)) {
        return std::nullopt;
    }
    return static_cast<std::int64_t>(*number);
}

std::optional<std::int64_t> wholeNumber(const json& object, const char* key) {
    if (!object.is_object() || !object.contains(key)) return std::nullopt;
    return wholeNumber(object[key]);
}

/// Replica: {"objects": [{"id": 3, "class_name": "chair"}, ...]}.
Result<LabelNames> readReplica(const fs::path& path) {
    const Result<json> document = readBoundedJson(path);
    if (!document) return tl::unexpected(document.error());
    LabelNames names;
    for (const json& object : listIn(*document, "objects")) {
        if (const auto id = wholeNumber(object, "id")) {
            names.categories[*id] = textIn(object, "class_name");
        }
    }
    return names;
}

/// HM3D: a header line, then lines like 17,A1B2C3,"chair",0.
Result<LabelNames> readHabitatText(const fs::path& path) {
    const Result<std::string> text = readNamedFile(path, kMostNameBytes);
    if (!text) return tl::unexpected(text.error());
    LabelNames names;
    int number = 0;
    for (const std::string_view line : splitLines(*text)) {
        ++number;
        const auto first = line.find(',');
        const auto second = first == line.npos ? first : line.find(',', first + 1);
        if (second == line.npos) continue;  // header or empty line
        const auto id = wholeNumber(line.substr(0, first));
        const std::string_view hex = line.substr(first + 1, second - first - 1);
        std::uint32_t color = 0;
        const auto [end, error] = std::from_chars(hex.data(), hex.data() + hex.size(), color, 16);
        const auto open = line.find('"', second);
        const auto close = open == line.npos ? open : line.find('"', open + 1);
        if (!id || error != std::errc() || end != hex.data() + hex.size() || color > 0xFFFFFFU ||
            close == line.npos) {
            return fail(ErrorCode::BadInput,
                        "The line does not have the form NUMBER,RRGGBB,\"NAME\",...; download the "
                        "file again.",
                        placeOf(path, number));
        }
        names.categories[*id] = cleanText(line.substr(open + 1, close - open - 1));
        names.of_color[color] = *id;
    }
    return names;
}

/// Matterport3D: lines "C index mapping_index mapping_name mpcat40_index mpcat40_name ..." and
/// "O index region category ...".
Result<LabelNames> readHouse(const fs::path& path) {
    const Result<std::string> text = readNamedFile(path, kMostNameBytes);
    if (!text) return tl::unexpected(text.error());
    std::map<std::int64_t, std::string> categories;
    LabelNames names;
    for (const std::string_view line : splitLines(*text)) {
        const auto words = splitWords(line);
        if (words.size() >= 6 && words[0] == "C") {
            // The mpcat40 class or, if that is unspecific, the more specific mapping_name.
            const bool vague = words[5] == "objects" || words[5] == "misc";
            std::string name = cleanText(words[vague ? 3 : 5]);
            std::replace(name.begin(), name.end(), '#', ' ');
            std::replace(name.begin(), name.end(), '_', ' ');
            if (const auto index = wholeNumber(words[1])) categories[*index] = name;
        } else if (words.size() >= 4 && words[0] == "O") {
            const auto index = wholeNumber(words[1]);
            const auto category = wholeNumber(words[3]);
            if (index && category) {
                const auto found = categories.find(*category);
                names.categories[*index] = found == categories.end() ? "" : found->second;
            }
        }
    }
    return names;
}

/// ScanNet and ScanNet++: objects as lists of segments, and the segment of each vertex. 3RScan has
/// no file of `segments`: its vertices have the numbers of their objects.
Result<LabelNames> readSegments(const fs::path& groups, const fs::path& segments) {
    const Result<json> said = readBoundedJson(groups);
    if (!said) return tl::unexpected(said.error());
    LabelNames names;
    for (const json& group : listIn(*said, "segGroups")) {
        auto id = wholeNumber(group, "objectId");
        if (!id) id = wholeNumber(group, "id");
        if (!id) continue;
        names.categories[*id] = textIn(group, "label");
        for (const json& segment : listIn(group, "segments")) {
            if (const auto number = wholeNumber(segment)) names.of_segment[*number] = *id;
        }
    }
    if (segments.empty()) return names;
    const Result<json> vertices = readBoundedJson(segments);
    if (!vertices) return tl::unexpected(vertices.error());
    for (const json& segment : listIn(*vertices, "segIndices")) {
        names.segments.push_back(wholeNumber(segment).value_or(-1));
    }
    return names;
}

/// ScanNet: all file names begin with the scan's: scene0000_00_vh_clean_2.labels.ply.
std::optional<LabelledFiles> findScanNet(const fs::path& mesh) {
    const std::string name = mesh.filename().string();
    const fs::path folder = mesh.parent_path();
    auto scan = withoutEnding(name, "_vh_clean_2.labels.ply");
    if (!scan) scan = withoutEnding(name, "_vh_clean_2.ply");
    if (!scan) return std::nullopt;
    LabelledFiles files;
    files.nyu40 = true;
    const fs::path labels = folder / (*scan + "_vh_clean_2.labels.ply");
    const fs::path textured = folder / (*scan + "_vh_clean_2.ply");
    if (hasFile(labels)) files.labelled = labels;
    if (hasFile(textured)) files.textured = textured;
    const fs::path segments = folder / (*scan + "_vh_clean_2.0.010000.segs.json");
    for (const char* ending : {".aggregation.json", "_vh_clean.aggregation.json"}) {
        const fs::path groups = folder / (*scan + ending);
        if (!hasFile(groups) || !hasFile(segments)) continue;
        files.kind = LabelFileKind::ScanNetSegments;
        files.names = groups;
        files.segments = segments;
        break;
    }
    if (files.labelled.empty() && !files.kind) return std::nullopt;
    if (files.labelled.empty()) files.labelled = files.textured;
    return files;
}

std::optional<LabelledFiles> findScanNetPp(const fs::path& mesh) {
    if (!mesh.filename().string().starts_with("mesh_aligned")) return std::nullopt;
    const fs::path groups = mesh.parent_path() / "segments_anno.json";
    const fs::path segments = mesh.parent_path() / "segments.json";
    if (!hasFile(groups) || !hasFile(segments)) return std::nullopt;
    return LabelledFiles{mesh, {}, LabelFileKind::ScanNetPpSegments, groups, segments};
}

std::optional<LabelledFiles> find3RScan(const fs::path& mesh) {
    const std::string name = mesh.filename().string();
    if (!name.starts_with("labels.instances.") || !name.ends_with(".ply")) return std::nullopt;
    const fs::path groups = mesh.parent_path() / "semseg.v2.json";
    if (!hasFile(groups)) return std::nullopt;
    return LabelledFiles{mesh, {}, LabelFileKind::RScanGroups, groups, {}};
}

std::optional<LabelledFiles> findReplica(const fs::path& mesh) {
    if (mesh.filename() != "mesh_semantic.ply") return std::nullopt;
    const fs::path names = mesh.parent_path() / "info_semantic.json";
    if (!hasFile(names)) return std::nullopt;
    return LabelledFiles{mesh, {}, LabelFileKind::ReplicaInfo, names, {}};
}

/// HM3D: X.basis.glb, X.semantic.glb, X.semantic.txt. Matterport3D: X.glb, X_semantic.ply, X.house.
std::optional<LabelledFiles> findHabitat(const fs::path& mesh) {
    const std::string name = mesh.filename().string();
    const fs::path folder = mesh.parent_path();
    std::optional<std::string> scene;
    for (const char* ending :
         {".semantic.glb", ".basis.glb", "_semantic.ply", ".semantic.ply", ".glb"}) {
        if (!scene) scene = withoutEnding(name, ending);
    }
    if (!scene || scene->empty()) return std::nullopt;
    struct Row {
        const char* names;
        const char* mesh;
        LabelFileKind kind;
    };
    for (const Row& row : {Row{".semantic.txt", ".semantic.glb", LabelFileKind::HabitatText},
                           Row{".semantic.txt", ".semantic.ply", LabelFileKind::HabitatText},
                           Row{".house", "_semantic.ply", LabelFileKind::MatterportHouse}}) {
        LabelledFiles files;
        files.labelled = folder / (*scene + row.mesh);
        files.names = folder / (*scene + row.names);
        files.kind = row.kind;
        if (!hasFile(files.names) || !hasFile(files.labelled)) continue;
        for (const char* ending : {".glb", ".basis.glb"}) {
            const fs::path textured = folder / (*scene + ending);
            if (files.textured.empty() && hasFile(textured)) files.textured = textured;
        }
        return files;
    }
    return std::nullopt;
}

}  // namespace

std::optional<LabelledFiles> findLabelledFiles(const fs::path& mesh) {
    for (const auto find : {findScanNet, findScanNetPp, find3RScan, findReplica, findHabitat}) {
        if (auto files = find(mesh)) return files;
    }
    return std::nullopt;
}

Result<LabelNames> readLabelNames(const LabelledFiles& files) {
    if (!files.kind) return LabelNames{};
    switch (*files.kind) {
        case LabelFileKind::ReplicaInfo:
            return readReplica(files.names);
        case LabelFileKind::HabitatText:
            return readHabitatText(files.names);
        case LabelFileKind::MatterportHouse:
            return readHouse(files.names);
        case LabelFileKind::ScanNetSegments:
        case LabelFileKind::ScanNetPpSegments:
        case LabelFileKind::RScanGroups:
            return readSegments(files.names, files.segments);
    }
    return LabelNames{};
}

}  // namespace dollytrack::semantics
