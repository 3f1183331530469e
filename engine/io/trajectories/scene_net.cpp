#include "engine/io/files/number_lines.h"
#include "engine/io/trajectories/pose_list.h"

#include <algorithm>

namespace dollytrack {
namespace {

/// The line where the poses begin: their header after a scene description, otherwise line 1.
int firstLine(std::string_view text) {
    int number = 0;
    for (const std::string_view line : splitLines(text)) {
        ++number;
        if (line.starts_with("#first three elements")) return number;
    }
    return 1;
}

}  // namespace

// SceneNet RGB-D: two lines per frame, the poses at shutter open and close. The ground truth is
// their mean. World y up.
Result<PoseList> readSceneNet(const PoseFile& file) {
    const auto lines =
        readNumberLines(file.path, file.text, 7, "time eye xyz look-at xyz", firstLine(file.text));
    if (!lines) return tl::unexpected(lines.error());
    if (lines->size() % 2 != 0) {
        return fail(ErrorCode::BadInput,
                    "The last frame lacks its second line, the pose at shutter close.",
                    placeOf(file.path, lines->back().line));
    }
    PoseList list;
    for (std::size_t i = 0; i < lines->size(); i += 2) {
        Eigen::Matrix<double, 7, 1> open =
            Eigen::Map<const Eigen::Matrix<double, 7, 1>>((*lines)[i].values.data());
        open += Eigen::Map<const Eigen::Matrix<double, 7, 1>>((*lines)[i + 1].values.data());
        const Eigen::Matrix<double, 7, 1> middle = 0.5 * open;
        const Eigen::Vector3d eye = middle.segment<3>(1);
        const Eigen::Vector3d forward = middle.segment<3>(4) - eye;
        const int line = (*lines)[i].line;
        auto rotation = rotationAlong(forward, Eigen::Vector3d::UnitY(), placeOf(file.path, line));
        if (!rotation) return tl::unexpected(std::move(rotation.error()));
        list.poses.push_back({eye, *rotation, middle[0], 0, line});
    }
    // Some programs write the same time in every line; then the trajectory has no times.
    const bool rising = std::adjacent_find(list.poses.begin(), list.poses.end(),
                                           [](const FilePose& a, const FilePose& b) {
                                               return *b.time_s <= *a.time_s;
                                           }) == list.poses.end();
    if (!rising) {
        for (FilePose& pose : list.poses) pose.time_s.reset();
    }
    return list;
}

}  // namespace dollytrack
