#include "render/formats/imu_csv.h"

#include "engine/camera/imu_track.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <iterator>

namespace dollytrack::render {

std::string imuCsvText(const DatasetContents& contents) {
    std::string text =
        "#timestamp [ns],w_RS_S_x [rad s^-1],w_RS_S_y [rad s^-1],w_RS_S_z [rad s^-1],"
        "a_RS_S_x [m s^-2],a_RS_S_y [m s^-2],a_RS_S_z [m s^-2]\n";
    const auto& frames = contents.frames;
    std::vector<TrajectoryFrame> motion;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        motion.push_back(frames[i].camera);
        const bool goes_on =
            i + 1 < frames.size() && frames[i + 1].camera.path == frames[i].camera.path;
        if (goes_on) continue;
        for (const ImuSample& sample : imuTrack(motion, contents.imu_rate_hz)) {
            const Eigen::Vector3d& w = sample.rate_rps;
            const Eigen::Vector3d& f = sample.specific_force_mps2;
            fmt::format_to(
                std::back_inserter(text), "{},{:.12g},{:.12g},{:.12g},{:.12g},{:.12g},{:.12g}\n",
                static_cast<std::int64_t>(std::llround(sample.time_s * 1e9)), w.x() + 0.0,
                w.y() + 0.0, w.z() + 0.0, f.x() + 0.0, f.y() + 0.0, f.z() + 0.0);
        }
        motion.clear();
    }
    return text;
}

}  // namespace dollytrack::render
