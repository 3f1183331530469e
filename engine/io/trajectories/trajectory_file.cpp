#include "engine/io/trajectories/trajectory_file.h"

#include "engine/io/files/number_lines.h"
#include "engine/io/files/text_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace dollytrack {
namespace {

constexpr std::array kFormats = {
    TrajectoryFormat{"tum", "TUM RGB-D: timestamp tx ty tz qx qy qz qw", FileWorld::ZUp, readTum},
    TrajectoryFormat{"kitti", "KITTI odometry: 3x4 matrices, with times.txt beside the file",
                     FileWorld::Camera, readKitti},
    TrajectoryFormat{"colmap", "COLMAP: images.txt, with cameras.txt beside the file",
                     FileWorld::ZUp, readColmap},
    TrajectoryFormat{"transforms", "transforms.json of nerfstudio and instant-ngp", FileWorld::ZUp,
                     readTransforms},
    TrajectoryFormat{"3d-front", "camera lists of 3D-FRONT, and Dollytrack's camera.json",
                     FileWorld::YUp, readFront3d},
    TrajectoryFormat{"hypersim", "Hypersim: camera_keyframe_positions.hdf5 and _orientations.hdf5",
                     FileWorld::Scene, readHypersim},
    TrajectoryFormat{"scenenet", "SceneNet RGB-D: eye and look-at, shutter open and closed",
                     FileWorld::YUp, readSceneNet},
    TrajectoryFormat{"tartanair", "TartanAir: tx ty tz qx qy qz qw in NED", FileWorld::Ned,
                     readTartanAir},
    TrajectoryFormat{"sweethome3d", "Sweet Home 3D: the views stored in .sh3d or Home.xml",
                     FileWorld::Scene, readSweetHome},
};

constexpr std::array<std::pair<const char*, FileWorld>, 5> kWorlds = {{
    {"scene", FileWorld::Scene},
    {"y-up", FileWorld::YUp},
    {"z-up", FileWorld::ZUp},
    {"ned", FileWorld::Ned},
    {"camera", FileWorld::Camera},
}};

const TrajectoryFormat* formatNamed(std::string_view name) {
    const auto* at = std::find_if(kFormats.begin(), kFormats.end(),
                                  [&](const auto& format) { return name == format.name; });
    return at == kFormats.end() ? nullptr : at;
}

template <class Table, class NameOf>
std::string listOf(const Table& table, NameOf&& name_of) {
    std::string list;
    for (const auto& row : table) list += (list.empty() ? "" : ", ") + std::string(name_of(row));
    return list;
}

/// Lines of seven numbers are TartanAir's if the last four are a unit quaternion, otherwise
/// SceneNet's.
std::string_view byNumbers(const std::vector<std::string_view>& words,
                           const std::filesystem::path& path) {
    if (words.size() == 8) return "tum";
    if (words.size() == 12) return "kitti";
    if (words.size() != 7) return "";
    double square = 0.0;
    for (std::size_t i = 3; i < 7; ++i) {
        const double value = parseNumber(words[i], path, 0).value_or(0.0);
        square += value * value;
    }
    return std::abs(std::sqrt(square) - 1.0) < 1e-2 ? "tartanair" : "scenenet";
}

/// The format by the file name; null if it is not specific.
const TrajectoryFormat* byName(const std::filesystem::path& path) {
    std::error_code error;
    if (std::filesystem::is_directory(path, error)) {
        if (std::filesystem::exists(path / "images.txt", error)) return formatNamed("colmap");
        const bool key_frames =
            std::filesystem::exists(path / "camera_keyframe_positions.hdf5", error);
        return key_frames ? formatNamed("hypersim") : nullptr;
    }
    const std::string extension = path.extension().string();
    if (extension == ".hdf5" || extension == ".h5") return formatNamed("hypersim");
    if (extension == ".sh3d") return formatNamed("sweethome3d");
    return path.filename() == "images.txt" ? formatNamed("colmap") : nullptr;
}

/// The format by the file's content; null if it is unknown.
const TrajectoryFormat* byContent(const PoseFile& file) {
    const std::size_t first = file.text.find_first_not_of(" \t\r\n");
    if (first == std::string::npos) return nullptr;
    if (file.text[first] == '[') return formatNamed("3d-front");
    if (file.text[first] == '{') return formatNamed("transforms");
    if (file.text[first] == '<') return formatNamed("sweethome3d");
    if (file.text.find("#first three elements") != std::string::npos) {
        return formatNamed("scenenet");
    }
    for (const std::string_view line : splitLines(file.text)) {
        const auto words = splitWords(line);
        if (words.empty() || words.front().front() == '#') continue;
        return formatNamed(byNumbers(words, file.path));
    }
    return nullptr;
}

/// Reads the file with the given format; null: detects it.
Result<PoseList> readPoses(PoseFile file, const TrajectoryFormat*& format, bool has_options) {
    if (!format) format = byName(file.path);
    if (format && format->read == readHypersim) return format->read(file);
    std::error_code error;
    if (format && format->read == readColmap && std::filesystem::is_directory(file.path, error)) {
        file.path /= "images.txt";
    }
    const bool folder = std::filesystem::is_directory(file.path, error);
    if (format || !folder) {
        Result<std::string> text = readText(file.path);
        if (!text) return tl::unexpected(std::move(text.error()));
        file.text = std::move(*text);
    }
    if (!format) format = byContent(file);
    if (format) return format->read(file);
    return fail(
        ErrorCode::BadInput,
        has_options
            ? "It is not a trajectory of a known format; give it with --trajectory-format (" +
                  trajectoryFormatNames() + ")."
            : "It is not a trajectory of a known format (" + trajectoryFormatNames() + ").",
        file.path.string());
}

/// Checks a frame's position, and its time against the previous frame's. Positions beyond kFarthest
/// indicate another format or unit.
Status checkFrame(const TrajectoryFrame& frame, const TrajectoryFrame* before, bool has_options,
                  const std::string& where) {
    constexpr double kFarthest = 1e6;  // m
    if (!(frame.pose.position.cwiseAbs().maxCoeff() <= kFarthest) ||
        !frame.pose.position.allFinite() || !frame.pose.rotation.coeffs().allFinite()) {
        return fail(ErrorCode::BadInput,
                    has_options ? "The position is not a number or more than 1000 km away; check "
                                  "its unit and --trajectory-world."
                                : "The position is not a number or more than 1000 km away.",
                    where);
    }
    if (before && !(frame.time_s > before->time_s)) {
        return fail(ErrorCode::BadInput, "The time is not later than the previous one.", where);
    }
    return {};
}

Eigen::Affine3d worldFromFile(FileWorld world, const TrajectoryReading& reading) {
    Eigen::Affine3d result = Eigen::Affine3d::Identity();
    switch (world) {
        case FileWorld::Scene:
            return reading.source_from_world.inverse();
        case FileWorld::YUp:
            return Eigen::Affine3d(reading.camera_json_from_world.inverse());
        case FileWorld::ZUp:
            break;
        case FileWorld::Ned:
            result.linear() << 1, 0, 0, 0, -1, 0, 0, 0, -1;
            break;
        case FileWorld::Camera:
            result.linear() << 1, 0, 0, 0, 0, 1, 0, -1, 0;
            break;
    }
    return result;
}

/// The camera's rotation by its forward and down directions, so that mirrored and scaled files also
/// give a rotation.
Pose placed(const FilePose& read, const Eigen::Affine3d& world_from_file) {
    const Eigen::Vector3d forward = (world_from_file.linear() * read.rotation.col(2)).normalized();
    const Eigen::Vector3d down = world_from_file.linear() * read.rotation.col(1);
    Eigen::Matrix3d rotation;
    rotation.col(0) = down.cross(forward).normalized();
    rotation.col(1) = forward.cross(rotation.col(0));
    rotation.col(2) = forward;
    return {world_from_file * read.position, Eigen::Quaterniond(rotation).normalized()};
}

}  // namespace

std::string trajectoryFormatNames() {
    return listOf(kFormats, [](const auto& format) { return format.name; });
}

std::span<const TrajectoryFormat> trajectoryFormats() {
    return kFormats;
}

Result<LoadedTrajectory> loadTrajectory(const std::filesystem::path& path,
                                        const TrajectoryReading& reading) {
    const TrajectoryFormat* format = formatNamed(reading.format);
    if (!reading.format.empty() && !format) {
        return fail(
            ErrorCode::Usage,
            "The trajectory format is unknown; the formats are " + trajectoryFormatNames() + ".",
            reading.format);
    }
    std::optional<FileWorld> world;
    if (!reading.world.empty()) {
        const auto* at = std::find_if(kWorlds.begin(), kWorlds.end(),
                                      [&](const auto& row) { return reading.world == row.first; });
        if (at == kWorlds.end()) {
            return fail(ErrorCode::Usage,
                        "The world convention is unknown; the conventions are " +
                            listOf(kWorlds, [](const auto& row) { return row.first; }) + ".",
                        reading.world);
        }
        world = at->second;
    }
    const Result<PoseList> read = readPoses({path, {}}, format, reading.has_options);
    if (!read) return tl::unexpected(read.error());
    LoadedTrajectory loaded;
    loaded.format = format->name;
    loaded.hfov_deg = read->hfov_deg;
    loaded.timed = std::all_of(read->poses.begin(), read->poses.end(),
                               [](const FilePose& pose) { return pose.time_s.has_value(); });
    const Eigen::Affine3d world_from_file = worldFromFile(world.value_or(format->world), reading);
    for (const FilePose& pose : read->poses) {
        TrajectoryFrame frame;
        const auto count = static_cast<double>(loaded.trajectory.frames.size());
        frame.time_s = loaded.timed ? *pose.time_s : count * reading.interval_s;
        frame.pose = placed(pose, world_from_file);
        frame.target_in_world = frame.pose.position + frame.pose.forward();
        frame.path = pose.motion;
        const auto& frames = loaded.trajectory.frames;
        const std::string where = pose.line > 0
                                      ? placeOf(path, pose.line)
                                      : fmt::format("{}: [{}]", path.string(), frames.size());
        const TrajectoryFrame* before = frames.empty() ? nullptr : &frames.back();
        const Status fits = checkFrame(frame, before, reading.has_options, where);
        if (!fits) return tl::unexpected(fits.error());
        loaded.trajectory.frames.push_back(frame);
    }
    loaded.trajectory.frame_interval_s =
        medianStep_s(loaded.trajectory.frames).value_or(reading.interval_s);
    return loaded;
}

}  // namespace dollytrack
