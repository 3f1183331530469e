#include "render/rig/rig_clearance.h"

#include <fmt/format.h>

namespace dollytrack::render {
namespace {

/// Counts the frames in which a camera touches something and keeps the first.
struct Touching {
    int count = 0;
    int frame = 0;  // frame number in the trajectory
    int object_id = 0;

    void add(int source_frame, int object) {
        if (count++ > 0) return;
        frame = source_frame;
        object_id = object;
    }
};

std::string nameOf(const Scene& scene, int object_id) {
    return scene.object(object_id).name;
}

}  // namespace

std::vector<std::string> rigWarnings(const FrameContext& context) {
    const DatasetContents& contents = context.contents;
    const double radius = contents.camera.camera_radius_m;
    std::vector<std::string> warnings;
    for (const RigCamera& camera : contents.rig) {
        if (carrierFromCamera(camera).position.isZero(0.0)) continue;
        Touching behind, near;
        for (std::size_t i = 0; i < contents.frames.size(); ++i) {
            const DatasetFrame& frame = contents.frames[i];
            const auto rays = context.moving.raysAt(static_cast<int>(i));
            const Eigen::Vector3d& from = frame.camera.pose.position;
            const Eigen::Vector3d place = poseOnRig(camera, frame.camera.pose).position;
            const RayHit hit = rays->cast(from, place - from, 1.0);
            if (hit.object_id != 0) {
                behind.add(frame.source_frame, hit.object_id);
                continue;
            }
            const ClosestPoint closest = rays->closest(place, radius);
            if (closest.object_id != 0) near.add(frame.source_frame, closest.object_id);
        }
        const auto all = contents.frames.size();
        if (behind.count > 0) {
            warnings.push_back(
                fmt::format("camera '{}' of the rig is inside or behind an object in {} of {} "
                            "frames, first in frame {}: '{}'; only {:g} m around the planned "
                            "camera are kept free: move it closer, or raise camera_radius_m",
                            camera.name, behind.count, all, behind.frame,
                            nameOf(contents.scene, behind.object_id), radius));
        }
        if (near.count > 0) {
            warnings.push_back(
                fmt::format("camera '{}' of the rig is closer than {:g} m to an object in {} of {} "
                            "frames, first in frame {}: '{}'",
                            camera.name, radius, near.count, all, near.frame,
                            nameOf(contents.scene, near.object_id)));
        }
    }
    return warnings;
}

}  // namespace dollytrack::render
