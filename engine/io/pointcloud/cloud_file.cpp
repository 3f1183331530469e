#include "engine/io/pointcloud/cloud_file.h"

#include "engine/io/pointcloud/pcd_points.h"
#include "engine/io/pointcloud/ply_points.h"
#include "engine/io/pointcloud/text_points.h"
#include "engine/io/scene_format.h"

#include <fstream>
#include <iterator>
#include <string>

namespace dollytrack::io {
namespace {

constexpr std::uintmax_t kLargestFile = std::uintmax_t{8} << 30U;  // bytes

}  // namespace

Result<PointCloud> readCloudFile(const std::filesystem::path& path) {
    const std::string extension = lowerExtension(path);
    if (extension == ".ply") return readPlyCloud(path);
    std::error_code error;
    if (std::filesystem::file_size(path, error) > kLargestFile || error) {
        return fail(ErrorCode::BadInput, "It cannot be read, or is larger than 8 GiB.",
                    path.string());
    }
    std::ifstream file(path, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    if (file.bad() || bytes.empty()) {
        return fail(ErrorCode::BadInput, "The point cloud cannot be read.", path.string());
    }
    return extension == ".pcd" ? readPcd(bytes, path.string())
                               : readTextPoints(bytes, path.string());
}

}  // namespace dollytrack::io
