#pragma once

#include "engine/core/result.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace dollytrack::semantics {

/// The file beside NAME.ply that names its label numbers: NAME.labels.json, .csv or .txt, or
/// NAME_labels.json and so on; nullopt if there is none.
[[nodiscard]] std::optional<std::filesystem::path> findNameList(const std::filesystem::path& ply);

/// Reads the names of label numbers: JSON {"3": "chair"}, {"chair": 3} or a list of
/// {"id": 3, "name": "chair"}, also under "objects", "classes" or "labels"; otherwise lines
/// "3,chair". Error: BadInput, also if it contains no name.
[[nodiscard]] Result<std::map<std::int64_t, std::string>> readNameList(
    const std::filesystem::path& file);

}  // namespace dollytrack::semantics
