#include "engine/io/file_source.h"

#include <algorithm>
#include <fstream>

namespace dollytrack {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kMostFileBytes = std::uintmax_t{512} << 20;

class FolderSource : public FileSource {
  public:
    explicit FolderSource(fs::path folder) : folder_(std::move(folder)) {}

    [[nodiscard]] Result<std::optional<std::vector<std::uint8_t>>> read(
        const std::string& name) const override {
        const std::optional<std::string> safe = safeRelativeName(name);
        if (!safe) return std::optional<std::vector<std::uint8_t>>{};
        // Every folder on the way, too: a link there would lead out as well.
        fs::path path = folder_;
        std::error_code error;
        for (const fs::path& step : fs::path(*safe)) {
            path /= step;
            if (fs::is_symlink(fs::symlink_status(path, error))) {
                return std::optional<std::vector<std::uint8_t>>{};
            }
        }
        if (!fs::is_regular_file(path, error)) return std::optional<std::vector<std::uint8_t>>{};
        const auto size = fs::file_size(path, error);
        if (error || size > kMostFileBytes) {
            return fail(ErrorCode::BadInput, "the file is larger than 512 MiB", path.string());
        }
        std::vector<std::uint8_t> bytes(size);
        std::ifstream in(path, std::ios::binary);
        in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
        if (!in && size > 0) {
            return fail(ErrorCode::BadInput, "the file cannot be read; check its permissions",
                        path.string());
        }
        return std::optional(std::move(bytes));
    }

    [[nodiscard]] std::vector<std::string> names() const override {
        std::vector<std::string> found;
        std::error_code error;
        constexpr std::size_t kMostFiles = 100'000;
        for (fs::recursive_directory_iterator it(folder_, error), end; !error && it != end;
             it.increment(error)) {
            if (it->is_symlink(error) || !it->is_regular_file(error)) continue;
            found.push_back(fs::relative(it->path(), folder_, error).generic_string());
            if (found.size() >= kMostFiles) break;
        }
        std::sort(found.begin(), found.end());
        return found;
    }

  private:
    fs::path folder_;
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
    return std::make_unique<FolderSource>(folder.empty() ? fs::path(".") : folder);
}

}  // namespace dollytrack
