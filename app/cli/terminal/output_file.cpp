#include "app/cli/terminal/output_file.h"

#include "engine/io/files/durable_file.h"

#include <unistd.h>

#include <cerrno>
#include <filesystem>

namespace dollytrack::cli {

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

}  // namespace dollytrack::cli
