#pragma once

#include "engine/core/result.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace dollytrack::semantics {

/// The file beside a PLY that names its numbers: NAME.labels.json, .csv or .txt, or NAME_labels.*,
/// of NAME.ply; nothing without.
[[nodiscard]] std::optional<std::filesystem::path> findNameList(const std::filesystem::path& ply);

/// The names of numbers: JSON {"3": "chair"}, {"chair": 3} or a list of {"id": 3, "name": "chair"},
/// also under "objects", "classes" or "labels"; else lines "3,chair". Error: BadInput, where it
/// names none.
[[nodiscard]] Result<std::map<std::int64_t, std::string>> readNameList(
    const std::filesystem::path& file);

}  // namespace dollytrack::semantics
