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

/// The content of the label files beside a mesh.
struct LabelNames {
    std::map<std::int64_t, std::string> categories;   // class name by object number; clean text
    std::map<std::uint32_t, std::int64_t> of_color;   // object number by colour 0xRRGGBB
    std::vector<std::int64_t> segments;               // segment number of each vertex
    std::map<std::int64_t, std::int64_t> of_segment;  // object number by segment
};

/// The kinds of label files.
enum class LabelFileKind {
    ReplicaInfo,        // info_semantic.json
    HabitatText,        // NAME.semantic.txt
    MatterportHouse,    // NAME.house
    ScanNetSegments,    // NAME.aggregation.json and NAME_vh_clean_2.0.010000.segs.json
    ScanNetPpSegments,  // segments_anno.json and segments.json
    RScanGroups,        // semseg.v2.json
};

/// A labelled mesh and its label files.
struct LabelledFiles {
    std::filesystem::path labelled;  // the mesh with label numbers or colours
    std::filesystem::path textured;  // the mesh with the room's colours, if it is another one
    std::optional<LabelFileKind> kind;
    std::filesystem::path names;     // empty: the numbers have no names
    std::filesystem::path segments;  // for the kinds with segments
    bool nyu40 = false;              // whether the class numbers are NYU40's (ScanNet)
};

/// Finds the files of a labelled mesh by the file names of Replica, HM3D, Matterport3D, ScanNet,
/// ScanNet++ and 3RScan; nullopt for a mesh without such files.
[[nodiscard]] std::optional<LabelledFiles> findLabelledFiles(const std::filesystem::path& mesh);

/// Reads the label files. Error: BadInput.
[[nodiscard]] Result<LabelNames> readLabelNames(const LabelledFiles& files);

}  // namespace dollytrack::semantics
