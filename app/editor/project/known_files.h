#pragma once

#include <filesystem>
#include <map>
#include <mutex>
#include <string>

namespace dollytrack::editor {

/// What project files held when this editor read or wrote them last, so that it notices what
/// another program has written since. Any thread.
class KnownFiles {
  public:
    void remember(const std::filesystem::path& file, const std::string& sha256);
    /// SHA-256 of its content; empty: neither read nor written here.
    [[nodiscard]] std::string contentOf(const std::filesystem::path& file) const;
    /// Whether the file holds something else now. Not when it is gone, nor when it was never known.
    [[nodiscard]] bool changedElsewhere(const std::filesystem::path& file) const;

  private:
    mutable std::mutex mutex_;
    std::map<std::filesystem::path, std::string> contents_;
};

}  // namespace dollytrack::editor
