#include "engine/io/pointcloud/files/cloud_file.h"

#include "engine/io/files/file_type.h"
#include "engine/io/files/input_file.h"
#include "engine/io/pointcloud/files/pcd_points.h"
#include "engine/io/pointcloud/files/ply_points.h"
#include "engine/io/pointcloud/files/text_points.h"

#include <string>

namespace dollytrack {
namespace {

constexpr std::uintmax_t kLargestFile = std::uintmax_t{8} << 30U;  // bytes

}  // namespace

Result<PointCloud> readCloudFile(const std::filesystem::path& path) {
    const std::string extension = lowerExtension(path);
    if (extension == ".ply") return readPlyCloud(path);
    const Result<std::string> bytes = readNamedFile(path, kLargestFile);
    if (!bytes) return tl::unexpected(bytes.error());
    return extension == ".pcd" ? readPcd(*bytes, path.string())
                               : readTextPoints(*bytes, path.string());
}

}  // namespace dollytrack
