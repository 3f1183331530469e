#include "engine/io/files/bounded_json.h"
#include "engine/io/files/number_lines.h"
#include "engine/io/trajectories/pose_list.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace dollytrack {
namespace {

Eigen::Vector3d vectorFrom(const nlohmann::json& value) {
    return {value.at(0).get<double>(), value.at(1).get<double>(), value.at(2).get<double>()};
}

}  // namespace

// The camera lists of 3D-FRONT and Dollytrack (camera.json): y up, metres. Without times, the views
// are independent; with times, a motion ends where the room changes.
Result<PoseList> readFront3d(const PoseFile& file) {
    PoseList list;
    std::size_t view = 0;
    const auto where = [&] { return fmt::format("{}: [{}]", file.path.string(), view); };
    const Result<nlohmann::json> views = parseBoundedJson(file.text, file.path.string());
    if (!views) return tl::unexpected(views.error());
    try {
        nlohmann::json room;
        for (const nlohmann::json& one : *views) {
            const Eigen::Vector3d position = vectorFrom(one.at("pos"));
            const Eigen::Vector3d forward = vectorFrom(one.at("target")) - position;
            const Eigen::Vector3d up =
                one.contains("up") ? vectorFrom(one["up"]) : Eigen::Vector3d(0, 1, 0);
            auto rotation = rotationAlong(forward, up, where());
            if (!rotation) return tl::unexpected(std::move(rotation.error()));
            FilePose pose{position, *rotation, std::nullopt};
            if (one.contains("time")) pose.time_s = one["time"].get<double>();
            const nlohmann::json in_room = one.value("room", nlohmann::json());
            const bool carried = !pose.time_s || (view > 0 && in_room != room);
            if (view > 0) pose.motion = list.poses.back().motion + (carried ? 1 : 0);
            room = in_room;
            if (view == 0 && one.contains("fov")) list.hfov_deg = one["fov"].get<double>();
            list.poses.push_back(pose);
            ++view;
        }
    } catch (const nlohmann::json::exception& error) {
        return fail(
            ErrorCode::BadInput,
            fmt::format("The file is not a list of {{pos, target, fov}} ({}).", plainReason(error)),
            where());
    }
    if (list.poses.empty()) {
        return fail(ErrorCode::BadInput, "The file has no views.", file.path.string());
    }
    return list;
}

}  // namespace dollytrack
