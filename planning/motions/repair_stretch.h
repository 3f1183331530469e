#pragma once

#include "engine/jobs/job.h"
#include "planning/motions/repair_path.h"

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace dollytrack::planning {

/// A part of a given path that is replaced, from frame `first` to frame `last`.
struct Stretch {
    std::size_t first = 0;
    std::size_t last = 0;
    // Positions of these two frames that stay. Without one of them, that end of the stretch goes to
    // the nearest free position.
    std::optional<Eigen::Vector3d> start, end;
    // A collision-free polyline; empty before findWay(), and if there is none.
    std::optional<std::vector<Eigen::Vector3d>> way = {};
    bool is_detour = false;  // much longer than the given motion
};

/// Finds the collision-free way that stays nearest to the given motion.
void findWay(const MappedScene& scene, std::span<const TrajectoryFrame> frames,
             const JobContext& job, Stretch& stretch);

/// The points of a stretch that has a way, relaxed towards the given motion and with rounded
/// corners; one for each frame, and more between them.
std::vector<PathPoint> pointsOf(const MappedScene& scene, std::span<const TrajectoryFrame> frames,
                                const Stretch& stretch, const JobContext& job);

}  // namespace dollytrack::planning
