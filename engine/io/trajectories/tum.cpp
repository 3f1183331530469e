#include "engine/io/trajectories/number_lines.h"
#include "engine/io/trajectories/pose_list.h"

namespace dollytrack::io {

// TUM RGB-D, groundtruth.txt: the optical centre in the world, camera axes as ours.
Result<PoseList> readTum(const std::filesystem::path& path) {
    const auto lines = readNumberLines(path, 8, "timestamp tx ty tz qx qy qz qw");
    if (!lines) return tl::unexpected<Error>(lines.error());
    PoseList list;
    for (const NumberLine& line : *lines) {
        const auto& v = line.values;
        auto rotation = rotationFrom(v[7], v[4], v[5], v[6], placeOf(path, line.line));
        if (!rotation) return tl::unexpected<Error>(std::move(rotation.error()));
        if (!list.poses.empty() && v[0] <= *list.poses.back().time_s) {
            return fail(ErrorCode::BadInput, "The timestamp is not after the one before it.",
                        placeOf(path, line.line));
        }
        list.poses.push_back({{v[1], v[2], v[3]}, *rotation, v[0]});
    }
    return list;
}

}  // namespace dollytrack::io
