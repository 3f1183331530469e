#include "engine/io/files/number_lines.h"
#include "engine/io/files/text_file.h"
#include "engine/io/trajectories/pose_list.h"

#include <fmt/format.h>

namespace dollytrack {

// KITTI odometry: row-major 3x4 matrices from camera i to the first camera; times in times.txt
// beside the file, if it exists.
Result<PoseList> readKitti(const PoseFile& file) {
    const auto lines = readNumberLines(file.path, file.text, 12, "the 3x4 matrix row by row");
    if (!lines) return tl::unexpected(lines.error());
    PoseList list;
    for (const NumberLine& line : *lines) {
        const Eigen::Matrix<double, 3, 4, Eigen::RowMajor> matrix =
            Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(line.values.data());
        const Eigen::Matrix3d written = matrix.leftCols<3>();
        auto rotation = rotationFrom(written, placeOf(file.path, line.line));
        if (!rotation) return tl::unexpected(std::move(rotation.error()));
        list.poses.push_back(
            {matrix.col(3), *rotation, std::nullopt, 0, line.line, (written - *rotation).norm()});
    }
    const std::filesystem::path times_path = file.path.parent_path() / "times.txt";
    std::error_code error;
    if (!std::filesystem::exists(times_path, error)) return list;
    const Result<std::string> text = readText(times_path);
    if (!text) return tl::unexpected(text.error());
    const auto times = readNumberLines(times_path, *text, 1, "seconds");
    if (!times) return tl::unexpected(times.error());
    if (times->size() != list.poses.size()) {
        return fail(
            ErrorCode::BadInput,
            fmt::format("There are {} times for {} poses.", times->size(), list.poses.size()),
            times_path.string());
    }
    for (std::size_t i = 0; i < times->size(); ++i) {
        list.poses[i].time_s = (*times)[i].values[0];
        // Checked here instead of in loadTrajectory(), because the error is in this second file.
        if (i > 0 && *list.poses[i].time_s <= *list.poses[i - 1].time_s) {
            return fail(ErrorCode::BadInput, "The time is not later than the previous one.",
                        placeOf(times_path, (*times)[i].line));
        }
    }
    return list;
}

}  // namespace dollytrack
