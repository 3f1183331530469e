#include "render/scene/motion_hash.h"

#include "engine/io/files/sha256.h"
#include "render/scene/exact_text.h"

#include <fmt/format.h>

namespace dollytrack::render {

std::string trajectoryHash(const Trajectory& trajectory) {
    std::string text;
    const auto add = [&](const std::vector<TrajectoryFrame>& frames) {
        for (const TrajectoryFrame& frame : frames) {
            text += fmt::format("{} {} {} {}", frame.time_s, frame.path, frame.component,
                                frame.position_point) +
                    exactText(frame.pose.position) + exactText(frame.pose.rotation.coeffs()) +
                    exactText(frame.target_in_world) + "\n";
        }
    };
    add(trajectory.frames);
    if (!trajectory.left_out.empty()) text += "left out\n";
    add(trajectory.left_out);
    return sha256Of(std::string_view(text));
}

std::string motionsHash(const std::vector<ObjectMotion>& motions) {
    std::string text;
    for (const ObjectMotion& motion : motions) {
        text += fmt::format("{}:", motion.object_id);
        for (const Eigen::Isometry3d& one : motion.by_frame) {
            text += exactText(one.translation()) +
                    exactText(Eigen::Quaterniond(one.rotation()).coeffs());
        }
    }
    return sha256Of(std::string_view(text));
}

}  // namespace dollytrack::render
