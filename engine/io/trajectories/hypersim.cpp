#include "engine/io/files/number_lines.h"
#include "engine/io/hdf5/hdf5_reader.h"
#include "engine/io/trajectories/pose_list.h"

#include <fmt/format.h>

#include <array>

namespace dollytrack {
namespace {

constexpr const char* kPositions = "camera_keyframe_positions.hdf5";
constexpr const char* kOrientations = "camera_keyframe_orientations.hdf5";

}  // namespace

// Hypersim: positions and orientations of a camera's key frames in two files of a folder, in the
// units of the scene file; x right, y up, z back; one frame per second.
Result<PoseList> readHypersim(const PoseFile& file) {
    std::error_code error;
    const std::filesystem::path folder =
        std::filesystem::is_directory(file.path, error) ? file.path : file.path.parent_path();
    const Result<Hdf5Numbers> positions = readHdf5Numbers(folder / kPositions);
    if (!positions) return tl::unexpected(positions.error());
    const Result<Hdf5Numbers> orientations = readHdf5Numbers(folder / kOrientations);
    if (!orientations) return tl::unexpected(orientations.error());
    const std::uint64_t count = positions->size[0];
    if (positions->size != std::vector<std::uint64_t>{count, 3} || count == 0) {
        return fail(ErrorCode::BadInput, "Positions must be a table of N x 3 numbers.",
                    (folder / kPositions).string());
    }
    if (orientations->size != std::vector<std::uint64_t>{count, 3, 3}) {
        return fail(ErrorCode::BadInput,
                    fmt::format("Orientations must be a table of {} x 3 x 3 numbers.", count),
                    (folder / kOrientations).string());
    }
    PoseList list;
    for (std::size_t i = 0; i < count; ++i) {
        const std::string where = fmt::format("{}: row {}", (folder / kOrientations).string(), i);
        const Eigen::Matrix3d matrix =
            Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(
                &orientations->values[9 * i]);
        auto rotation = rotationFrom(matrix, where);
        if (!rotation) return tl::unexpected(std::move(rotation.error()));
        rotation->rightCols<2>() *= -1.0;
        list.poses.push_back({Eigen::Map<const Eigen::Vector3d>(&positions->values[3 * i]),
                              *rotation, static_cast<double>(i)});
    }
    return list;
}

}  // namespace dollytrack
