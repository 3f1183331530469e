#pragma once

#include <filesystem>
#include <map>
#include <mutex>
#include <string>

namespace dollytrack::editor {

/// The contents (hashes) of project files when this editor last read or wrote them, to detect
/// changes by other programs. Thread-safe.
class KnownFiles {
  public:
    void remember(const std::filesystem::path& file, const std::string& sha256);
    /// The recorded SHA-256; empty if the file was neither read nor written here.
    [[nodiscard]] std::string contentOf(const std::filesystem::path& file) const;
    /// Whether the file's content differs from the recorded one. False if the file is missing or
    /// unknown.
    [[nodiscard]] bool changedElsewhere(const std::filesystem::path& file) const;

  private:
    mutable std::mutex mutex_;
    std::map<std::filesystem::path, std::string> contents_;
};

}  // namespace dollytrack::editor
