#pragma once

#include "engine/io/files/input_record.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dollytrack {

/// An input that a cached reading depends on, identified by content. Paths are relative, so the
/// entry stays valid when the scene's folder is moved.
struct CachedInput {
    InputUse::Kind kind = InputUse::File;
    std::uint32_t root = 0;  // index into InputRoots
    std::string path;        // from the root; empty: the root itself
    std::string digest;      // SHA-256 of a file, or of the names of a listing
};

/// The places where inputs may lie: the scene's folder, then SceneFormat::more_inputs (folders or
/// files).
using InputRoots = std::vector<std::filesystem::path>;

[[nodiscard]] InputRoots inputRoots(const std::filesystem::path& scene,
                                    const std::vector<std::filesystem::path>& more_inputs);

/// Converts the inputs reported by an importer to cache entries. The scene file is left out,
/// because its content is part of the entry's name, but its digest must still be `scene_sha256`. No
/// value if a file was changed since it was read, or lies below none of the roots.
[[nodiscard]] std::optional<std::vector<CachedInput>> cachedInputs(
    const std::filesystem::path& scene, const std::string& scene_sha256, const InputRoots& roots,
    const std::vector<InputUse>& inputs);

/// Whether all inputs are unchanged.
[[nodiscard]] bool areUnchanged(const InputRoots& roots, const std::vector<CachedInput>& inputs);

[[nodiscard]] std::string cachedInputsText(const std::vector<CachedInput>& inputs);
[[nodiscard]] std::optional<std::vector<CachedInput>> parseCachedInputs(std::string_view text);

}  // namespace dollytrack
