#include "engine/io/files/confined_folder.h"
#include "engine/io/files/file_source.h"

#include <algorithm>

namespace dollytrack {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMostFileBytes = std::uint64_t{512} << 20;

class FolderSource : public FileSource {
  public:
    explicit FolderSource(const fs::path& folder) : files_(folder) {}

    [[nodiscard]] Result<std::optional<std::vector<std::uint8_t>>> read(
        const std::string& name) const override {
        const std::optional<std::string> safe = safeRelativeName(name);
        if (!safe) return std::optional<std::vector<std::uint8_t>>{};
        if (!files_.has(*safe)) return std::optional<std::vector<std::uint8_t>>{};
        const Result<InputFile> file = files_.open(*safe);
        if (!file) return tl::unexpected(file.error());
        if (file->size() > kMostFileBytes) {
            return fail(ErrorCode::BadInput, "the file is larger than 512 MiB",
                        (files_.path() / *safe).string());
        }
        std::vector<std::uint8_t> bytes(file->size());
        if (file->read(0, bytes.data(), bytes.size()) != bytes.size()) {
            return fail(ErrorCode::BadInput, "the file cannot be read to its end",
                        (files_.path() / *safe).string());
        }
        return std::optional(std::move(bytes));
    }

  private:
    ConfinedFolder files_;
};

}  // namespace

std::optional<std::string> safeRelativeName(const std::string& name) {
    std::string slashes = name;
    std::replace(slashes.begin(), slashes.end(), '\\', '/');
    if (slashes.empty() || slashes.front() == '/' || slashes.find('\0') != std::string::npos ||
        (slashes.size() > 1 && slashes[1] == ':')) {
        return std::nullopt;
    }
    const fs::path normal = fs::path(slashes).lexically_normal();
    if (normal.empty() || *normal.begin() == ".." || normal == ".") return std::nullopt;
    return normal.generic_string();
}

std::unique_ptr<FileSource> openFolder(const fs::path& folder) {
    return std::make_unique<FolderSource>(folder);
}

}  // namespace dollytrack
