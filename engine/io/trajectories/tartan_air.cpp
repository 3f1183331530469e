#include "engine/io/files/number_lines.h"
#include "engine/io/trajectories/pose_list.h"

namespace dollytrack {

// TartanAir, pose_left.txt: one pose per line, without times. Camera axes x forward, y right, z
// down.
Result<PoseList> readTartanAir(const PoseFile& file) {
    const auto lines = readNumberLines(file.path, file.text, 7, "tx ty tz qx qy qz qw");
    if (!lines) return tl::unexpected(lines.error());
    Eigen::Matrix3d body_from_camera;
    body_from_camera << 0, 0, 1, 1, 0, 0, 0, 1, 0;
    PoseList list;
    for (const NumberLine& line : *lines) {
        const auto& v = line.values;
        auto rotation = rotationFrom(v[6], v[3], v[4], v[5], placeOf(file.path, line.line));
        if (!rotation) return tl::unexpected(std::move(rotation.error()));
        list.poses.push_back(
            {{v[0], v[1], v[2]}, *rotation * body_from_camera, std::nullopt, 0, line.line});
    }
    return list;
}

}  // namespace dollytrack
