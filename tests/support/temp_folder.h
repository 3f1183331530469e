#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace dollytrack::test {

/// A temporary folder, deleted by the destructor.
class TempFolder {
  public:
    TempFolder();
    ~TempFolder();
    TempFolder(const TempFolder&) = delete;
    TempFolder& operator=(const TempFolder&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    /// Writes a file in it, byte by byte, and returns its path.
    [[nodiscard]] std::filesystem::path write(const std::string& name, std::string_view text) const;

  private:
    std::filesystem::path path_;
};

}  // namespace dollytrack::test
