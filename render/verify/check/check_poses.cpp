// Reads every pose file as its readers do and compares with the poses of dataset.json.
#include "engine/io/files/bounded_json.h"
#include "engine/io/files/text_file.h"
#include "engine/io/trajectories/pose_list.h"
#include "render/verify/check/check_list.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string_view>

namespace dollytrack::verify {
namespace {

/// Metres and radians; files have nine decimals.
constexpr double kPosesTolerance = 1e-6;
constexpr double kTimeTolerance_s = 1e-6;

/// World frame of a file, for a dataset with at least one frame.
using FileFromWorld = Eigen::Isometry3d (*)(const StoredDataset& dataset);

Eigen::Isometry3d sameWorld(const StoredDataset& /*dataset*/) {
    return Eigen::Isometry3d::Identity();
}

/// y up; dataset.json has the transform.
Eigen::Isometry3d cameraJsonWorld(const StoredDataset& dataset) {
    Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
    const auto& rows = dataset.card.at("camera_json_from_world");
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 4; ++column) {
            result.matrix()(row, column) = rows.at(row).at(column).get<double>();
        }
    }
    return result;
}

Eigen::Isometry3d firstCamera(const StoredDataset& dataset) {
    return dataset.frames.front().pose.worldFromCamera().inverse();
}

/// North-east-down: x, -y, -z of the world.
Eigen::Isometry3d northEastDown(const StoredDataset& /*dataset*/) {
    Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
    result.linear() << 1, 0, 0, 0, -1, 0, 0, 0, -1;
    return result;
}

struct PoseFormat {
    const char* name;  // as in dataset.json's formats
    const char* file;
    Result<PoseList> (*read)(const PoseFile& file);
    FileFromWorld file_from_world;
};

constexpr std::array kPoseFormats = {
    PoseFormat{"camera_json", "camera.json", readFront3d, cameraJsonWorld},
    PoseFormat{"tum", "groundtruth.txt", readTum, sameWorld},
    PoseFormat{"kitti", "poses.txt", readKitti, firstCamera},
    PoseFormat{"colmap", "sparse/0/images.txt", readColmap, sameWorld},
    PoseFormat{"nerfstudio", "transforms.json", readTransforms, sameWorld},
    PoseFormat{"instant_ngp", "transforms_ngp.json", readTransforms, sameWorld},
    PoseFormat{"tartanair", "pose_left.txt", readTartanAir, northEastDown},
};

std::string positionText(const Eigen::Vector3d& p) {
    return fmt::format("({:.7f}, {:.7f}, {:.7f})", p.x(), p.y(), p.z());
}

void comparePose(const PoseFormat& format, const FilePose& read, const StoredFrame& frame,
                 int index, const Eigen::Isometry3d& file_from_world, Findings& findings) {
    const std::string file =
        read.line > 0 ? fmt::format("{}:{}", format.file, read.line) : std::string(format.file);
    const Eigen::Isometry3d expected = file_from_world * frame.pose.worldFromCamera();
    if (!((read.position - expected.translation()).norm() <= kPosesTolerance)) {
        findings.add({file,
                      index,
                      {},
                      "position " + positionText(read.position),
                      positionText(expected.translation())});
    }
    // Distance between two rotation matrices: their angle, if small. What a matrix in the file
    // differs from a rotation counts, too.
    const double turned =
        ((read.rotation - expected.linear()).norm() + read.rotation_error) / std::sqrt(2.0);
    if (!(turned <= kPosesTolerance)) {
        findings.add({file,
                      index,
                      {},
                      fmt::format("a rotation {:.3g} rad off", turned),
                      "that of dataset.json"});
    }
    if (read.time_s && !(std::abs(*read.time_s - frame.time_s) <= kTimeTolerance_s)) {
        findings.add({file,
                      index,
                      {},
                      fmt::format("time {:.7f} s", *read.time_s),
                      fmt::format("{:.7f} s", frame.time_s)});
    }
}

void compareFile(const StoredDataset& dataset, const PoseFormat& format, Findings& findings) {
    const auto wrong = [&](std::string found, std::string expected) {
        findings.add({format.file, {}, {}, std::move(found), std::move(expected)});
    };
    PoseFile file{dataset.folder / format.file, {}};
    Result<std::string> text = readText(file.path);
    if (!text) return wrong(text.error().message, "poses");
    file.text = std::move(*text);
    const Result<PoseList> list = format.read(file);
    if (!list) return wrong(describe(list.error()), "poses");
    if (list->poses.size() != dataset.frames.size()) {
        return wrong(fmt::format("{} poses", list->poses.size()),
                     fmt::format("{}", dataset.frames.size()));
    }
    if (list->hfov_deg && std::abs(*list->hfov_deg - dataset.hfov_deg) > 1e-6) {
        wrong(fmt::format("{:.6f} deg of view", *list->hfov_deg),
              fmt::format("{:.6f}", dataset.hfov_deg));
    }
    const Eigen::Isometry3d file_from_world = format.file_from_world(dataset);
    for (std::size_t i = 0; i < dataset.frames.size(); ++i) {
        comparePose(format, list->poses[i], dataset.frames[i], static_cast<int>(i), file_from_world,
                    findings);
    }
}

}  // namespace

CheckWork beginPoses(const Subject& subject, Findings& findings) {
    const StoredDataset& dataset = subject.dataset;
    if (dataset.frames.empty()) return {};
    for (const PoseFormat& format : kPoseFormats) {
        if (!dataset.has(format.name)) continue;
        try {
            compareFile(dataset, format, findings);
        } catch (const nlohmann::json::exception& error) {
            findings.add({"dataset.json", {}, {}, plainReason(error), "camera_json_from_world"});
        }
    }
    return {};
}

CheckWork beginMotion(const Subject& subject, Findings& findings) {
    const auto& frames = subject.dataset.frames;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const auto wrong = [&](std::string found, std::string expected) {
            findings.add(
                {"dataset.json", static_cast<int>(i), {}, std::move(found), std::move(expected)});
        };
        const StoredFrame& frame = frames[i];
        if (i > 0 && !(frame.time_s > frames[i - 1].time_s)) {
            wrong(fmt::format("time {:.9g} s", frame.time_s),
                  fmt::format("after {:.9g} s", frames[i - 1].time_s));
        }
        if (i > 0 && frame.source_frame <= frames[i - 1].source_frame) {
            wrong(fmt::format("trajectory_frame {}", frame.source_frame),
                  fmt::format("after {}", frames[i - 1].source_frame));
        }
        if (!(std::abs(frame.quaternion_length - 1.0) <= kPosesTolerance)) {
            wrong(fmt::format("a quaternion of length {:.9g}", frame.quaternion_length), "1");
        }
    }
    return {};
}

}  // namespace dollytrack::verify
