#include "engine/core/natural_order.h"
#include "engine/io/files/number_lines.h"
#include "engine/io/files/text_file.h"
#include "engine/io/trajectories/pose_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace dollytrack {
namespace {

/// Horizontal field of view of the first camera in cameras.txt beside images.txt.
std::optional<double> hfovBeside(const std::filesystem::path& images) {
    const Result<std::string> text = readText(images.parent_path() / "cameras.txt");
    if (!text) return std::nullopt;
    for (const std::string_view line : splitLines(*text)) {
        const auto words = splitWords(line);
        // CAMERA_ID MODEL WIDTH HEIGHT PARAMS[]; the first parameter of every model is f or fx.
        if (words.size() < 5 || words.front().front() == '#') continue;
        const auto width = parseNumber(words[2], images, 0);
        const auto focal = parseNumber(words[4], images, 0);
        if (!width || !focal || *focal <= 0.0) return std::nullopt;
        return 2.0 * std::atan(0.5 * *width / *focal) * 180.0 / std::numbers::pi;
    }
    return std::nullopt;
}

}  // namespace

// COLMAP, images.txt: camera_from_world, Hamilton quaternion with w first. Each image has a second
// line of points, which may be empty. Images are sorted by name in natural order (a2 before a10),
// the order of capture.
Result<PoseList> readColmap(const PoseFile& file) {
    const std::filesystem::path& path = file.path;
    std::vector<std::pair<std::string, FilePose>> images;
    bool points_follow = false;
    int number = 0;
    for (const std::string_view line : splitLines(file.text)) {
        ++number;
        if (!line.empty() && line.front() == '#') continue;
        if (std::exchange(points_follow, false)) continue;
        const auto words = splitWords(line);
        if (words.empty()) continue;
        if (words.size() < 10) {
            return fail(ErrorCode::BadInput,
                        fmt::format("There are {} values where 10 are needed (IMAGE_ID QW QX QY QZ "
                                    "TX TY TZ CAMERA_ID NAME); each image needs a second line for "
                                    "its points, even an empty one.",
                                    words.size()),
                        placeOf(path, number));
        }
        std::array<double, 7> v{};
        for (std::size_t i = 0; i < v.size(); ++i) {
            Result<double> value = parseNumber(words[i + 1], path, number);
            if (!value) return tl::unexpected(std::move(value.error()));
            v[i] = *value;
        }
        auto camera_from_world = rotationFrom(v[0], v[1], v[2], v[3], placeOf(path, number));
        if (!camera_from_world) return tl::unexpected(std::move(camera_from_world.error()));
        const Eigen::Matrix3d world_from_camera = camera_from_world->transpose();
        const Eigen::Vector3d translation(v[4], v[5], v[6]);
        const std::size_t name_at = words[9].data() - line.data();
        images.emplace_back(std::string(line.substr(name_at)),
                            FilePose{-(world_from_camera * translation), world_from_camera,
                                     std::nullopt, 0, number});
        points_follow = true;
    }
    if (images.empty()) {
        return fail(ErrorCode::BadInput, "The file has no images.", path.string());
    }
    std::stable_sort(images.begin(), images.end(),
                     [](const auto& a, const auto& b) { return comesBefore(a.first, b.first); });
    PoseList list;
    for (auto& [name, pose] : images) list.poses.push_back(pose);
    list.hfov_deg = hfovBeside(path);
    return list;
}

}  // namespace dollytrack
