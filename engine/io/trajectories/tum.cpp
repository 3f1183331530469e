#include "engine/io/files/number_lines.h"
#include "engine/io/trajectories/pose_list.h"
#include "engine/io/trajectories/trajectory_file.h"

#include <fmt/format.h>

namespace dollytrack {

// TUM RGB-D, groundtruth.txt: the optical centre in the world; camera x right, y down, z forward.
Result<PoseList> readTum(const PoseFile& file) {
    const auto lines = readNumberLines(file.path, file.text, 8, "timestamp tx ty tz qx qy qz qw");
    if (!lines) return tl::unexpected(lines.error());
    PoseList list;
    for (const NumberLine& line : *lines) {
        const auto& v = line.values;
        auto rotation = rotationFrom(v[7], v[4], v[5], v[6], placeOf(file.path, line.line));
        if (!rotation) return tl::unexpected(std::move(rotation.error()));
        list.poses.push_back({{v[1], v[2], v[3]}, *rotation, v[0], 0, line.line});
    }
    return list;
}

std::string tumLine(double time_s, const Pose& pose) {
    std::string line = fmt::format("{:.6f}", time_s + 0.0);
    for (const double x : pose.position) line += fmt::format(" {:.9f}", x + 0.0);
    for (const double x : pose.rotation.coeffs()) line += fmt::format(" {:.9f}", x + 0.0);
    return line;
}

std::string tumText(const Trajectory& trajectory) {
    std::string text = "# timestamp tx ty tz qx qy qz qw\n";
    for (const TrajectoryFrame& frame : trajectory.frames) {
        text += tumLine(frame.time_s, frame.pose) + "\n";
    }
    return text;
}

}  // namespace dollytrack
