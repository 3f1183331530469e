#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace dollytrack {

/// The executable file of a program in the folders of PATH. Relative folders are skipped: they
/// would run programs that lie beside a downloaded scene.
[[nodiscard]] std::optional<std::filesystem::path> findProgram(const std::string& name);

}  // namespace dollytrack
