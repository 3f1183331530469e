#pragma once

#include "engine/io/sandbox/input_record.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dollytrack::io {

/// Something a kept reading depends on, by content: what lies beneath the scene's folder holds
/// wherever that folder lies.
struct CachedInput {
    InputUse::Kind kind = InputUse::File;
    std::uint32_t root = 0;  // index into InputRoots
    std::string path;        // from the root; empty: the root itself
    std::string digest;      // SHA-256 of a file, of the names of a listing
};

/// Where inputs may lie: the scene's folder, then SceneFormat::more_inputs (folders or files).
using InputRoots = std::vector<std::filesystem::path>;

[[nodiscard]] InputRoots inputRoots(const std::filesystem::path& scene,
                                    const std::vector<std::filesystem::path>& more_inputs);

/// By content what an importer says it depended on; the scene file itself is left out
/// (its content names the entry), but has to have this digest still. Nothing when a file was
/// written to since, or lies beneath none of the roots.
[[nodiscard]] std::optional<std::vector<CachedInput>> cachedInputs(
    const std::filesystem::path& scene, const std::string& scene_sha256, const InputRoots& roots,
    const std::vector<InputUse>& inputs);

/// Whether all of it is still as it was.
[[nodiscard]] bool areUnchanged(const InputRoots& roots, const std::vector<CachedInput>& inputs);

[[nodiscard]] std::string cachedInputsText(const std::vector<CachedInput>& inputs);
[[nodiscard]] std::optional<std::vector<CachedInput>> parseCachedInputs(std::string_view text);

}  // namespace dollytrack::io
