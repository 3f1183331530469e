#pragma once

#include "engine/core/result.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack::semantics {

/// What the files beside a mesh say of the numbers and colours of its faces.
struct LabelNames {
    std::map<std::int64_t, std::string> categories;   // of each object's number; clean text
    std::map<std::uint32_t, std::int64_t> of_color;   // object of a colour 0xRRGGBB
    std::vector<std::int64_t> segments;               // segment of each vertex
    std::map<std::int64_t, std::int64_t> of_segment;  // object of a segment
};

/// The kinds of files that name a mesh's objects.
enum class LabelFileKind {
    ReplicaInfo,        // info_semantic.json
    HabitatText,        // NAME.semantic.txt
    MatterportHouse,    // NAME.house
    ScanNetSegments,    // NAME.aggregation.json and NAME_vh_clean_2.0.010000.segs.json
    ScanNetPpSegments,  // segments_anno.json and segments.json
};

/// A labelled mesh and the files that belong to it.
struct LabelledFiles {
    std::filesystem::path labelled;  // the mesh whose faces carry numbers or colours
    std::filesystem::path textured;  // the mesh with the room's colours, if it is another one
    std::optional<LabelFileKind> kind;
    std::filesystem::path names;     // empty: the mesh has numbers without names
    std::filesystem::path segments;  // of the two kinds that have them
    bool nyu40 = false;              // the mesh's class numbers are NYU40's (ScanNet)
};

/// The files that label a mesh by the naming of Replica, HM3D, Matterport3D, ScanNet and ScanNet++;
/// nothing for a mesh that none of them belongs to.
[[nodiscard]] std::optional<LabelledFiles> findLabelledFiles(const std::filesystem::path& mesh);

/// Reads the files that name objects. Error: BadInput.
[[nodiscard]] Result<LabelNames> readLabelNames(const LabelledFiles& files);

}  // namespace dollytrack::semantics
