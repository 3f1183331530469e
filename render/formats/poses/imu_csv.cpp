#include "render/formats/poses/imu_csv.h"

#include "engine/camera/imu_track.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>

namespace dollytrack::render {

std::string imuCsvText(const DatasetContents& contents) {
    std::string text =
        "#timestamp [ns],w_RS_S_x [rad s^-1],w_RS_S_y [rad s^-1],w_RS_S_z [rad s^-1],"
        "a_RS_S_x [m s^-2],a_RS_S_y [m s^-2],a_RS_S_z [m s^-2]\n";
    const auto& frames = contents.frames;
    const auto path_of = [&](std::size_t i) {
        return contents.camera_motion.pathOf(static_cast<std::size_t>(frames[i].source_frame));
    };
    for (std::size_t begin = 0, end = 0; begin < frames.size(); begin = end) {
        const PoseSpline* path = path_of(begin);
        for (end = begin + 1; end < frames.size() && path_of(end) == path;) ++end;
        if (path == nullptr || end - begin < 2) continue;
        for (const ImuSample& sample :
             imuTrack(*path, contents.imu_rate_hz, frames[begin].camera.time_s,
                      frames[end - 1].camera.time_s)) {
            const Eigen::Vector3d& w = sample.rate_rps;
            const Eigen::Vector3d& f = sample.specific_force_mps2;
            fmt::format_to(
                std::back_inserter(text), "{},{:.12g},{:.12g},{:.12g},{:.12g},{:.12g},{:.12g}\n",
                static_cast<std::int64_t>(std::llround(sample.time_s * 1e9)), w.x() + 0.0,
                w.y() + 0.0, w.z() + 0.0, f.x() + 0.0, f.y() + 0.0, f.z() + 0.0);
        }
    }
    return text;
}

namespace {

constexpr std::array<const char*, 1> kImuCsvFiles = {"imu.csv"};

Result<std::vector<DatasetFile>> writeImuCsv(const DatasetContents& contents) {
    return std::vector<DatasetFile>{{kImuCsvFiles[0], imuCsvText(contents)}};
}

nlohmann::ordered_json imuCsvConvention(const DatasetContents& /*contents*/) {
    return {
        {"file", kImuCsvFiles[0]},
        {"format",
         "EuRoC's columns: time (ns), angular rate (rad/s) and specific force (m/s2; at rest "
         "9.80665 upwards) in the camera's axes, without noise and bias, along a C2 spline "
         "through all poses of each continuous motion, including frames that are not exported"}};
}

}  // namespace

const Format kImuFormat = {
    .name = "imu",
    .text = "inertial measurements along the motion, in imu.csv",
    .group = ContentGroup::Measurements,
    .standard = true,
    .files = kImuCsvFiles,
    .write = writeImuCsv,
    .convention = imuCsvConvention,
};

}  // namespace dollytrack::render
