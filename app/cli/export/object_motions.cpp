#include "app/cli/export/object_motions.h"

#include "engine/document/object_track.h"

#include <algorithm>

namespace dollytrack::cli {
namespace {

/// The transform that moveObject() applies to an object whose box in the file has this centre.
Eigen::Isometry3d isometry(const Eigen::Vector3d& middle, const ObjectMove& move) {
    return Eigen::Translation3d(middle + move.offset_m) *
           Eigen::AngleAxisd(move.turn_rad, Eigen::Vector3d::UnitZ()) *
           Eigen::Translation3d(-middle);
}

}  // namespace

std::vector<render::ObjectMotion> objectMotions(const Scene& scene, const SceneEdits& edits,
                                                const Trajectory& trajectory) {
    std::vector<render::ObjectMotion> motions;
    for (const ObjectChange& change : edits.changes) {
        if (change.track.empty()) continue;
        const auto object = std::ranges::find(scene.objects, change.object.name, &Object::name);
        if (object == scene.objects.end()) continue;
        const ObjectMove now = change.move.value_or(ObjectMove{});
        const Eigen::Vector3d middle = object->box.center - now.offset_m;
        const Eigen::Isometry3d back = isometry(middle, now).inverse();
        render::ObjectMotion& motion = motions.emplace_back();
        motion.object_id = object->id;
        for (const TrajectoryFrame& frame : trajectory.frames) {
            motion.by_frame.push_back(isometry(middle, moveAt(change.track, frame.time_s)) * back);
        }
    }
    return motions;
}

}  // namespace dollytrack::cli
