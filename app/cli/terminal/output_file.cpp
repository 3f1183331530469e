#include "app/cli/terminal/output_file.h"

#include "engine/io/files/durable_file.h"

#include <unistd.h>

#include <cerrno>

namespace dollytrack::cli {

namespace fs = std::filesystem;

Status checkWritable(const std::string& path) {
    if (path.empty()) return {};
    std::error_code error;
    if (std::filesystem::is_directory(path, error)) {
        return tl::unexpected(writeError(EISDIR, path));
    }
    // Files are written beside the old one and renamed, so the folder must be writable. The dot
    // distinguishes a path that is no folder from a missing permission.
    const std::filesystem::path folder = std::filesystem::path(path).parent_path() / ".";
    if (::access(folder.c_str(), W_OK | X_OK) != 0) {
        return tl::unexpected(writeError(errno, path));
    }
    return {};
}

fs::path fileBeside(const fs::path& folder, const std::string& ending) {
    std::error_code error;
    fs::path plain = fs::absolute(folder / "", error).lexically_normal();
    plain = plain.parent_path();
    return plain.parent_path() / (plain.filename().string() + ending);
}

Result<GuardedFolder> openPageFolder(const fs::path& file, bool overwrite) {
    const std::string name = file.filename().string();
    std::error_code error;
    if (name.empty() || name == "." || name == ".." || fs::is_directory(file, error)) {
        return fail(ErrorCode::CannotWrite, "The path is a folder; give a file name for the page.",
                    file.string());
    }
    const fs::path parent = file.has_parent_path() ? file.parent_path() : fs::path(".");
    Result<GuardedFolder> folder = GuardedFolder::open(parent);
    if (!folder) return folder;
    if (const Status status = folder->checkFile(name); !status) {
        return tl::unexpected(status.error());
    }
    if (!overwrite && folder->has(name)) {
        return fail(ErrorCode::Usage, "The file already exists; pass --overwrite to replace it.",
                    file.string());
    }
    return folder;
}

}  // namespace dollytrack::cli
