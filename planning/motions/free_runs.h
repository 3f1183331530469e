#pragma once

#include "engine/camera/trajectory.h"
#include "engine/jobs/job.h"

#include <Eigen/Core>

#include <cstddef>
#include <span>
#include <vector>

namespace dollytrack::planning {

struct MappedScene;
class MotionCheck;

/// Which frames, and moves from a frame to the next, of one path are free.
struct FreeParts {
    std::vector<char> frames;
    std::vector<char> moves;  // one less than frames
};

/// Incomplete if cancelled.
FreeParts findFreeParts(const MotionCheck& check, std::span<const TrajectoryFrame> frames,
                        const JobContext& job);

/// Successive frames joined by free moves.
struct FreeRun {
    std::size_t first = 0;
    std::size_t last = 0;
    int component = 0;  // of free space
    // Positions of both frames. They differ from the given ones only if no frame of the path is
    // free: then one frame is moved to the nearest free position.
    Eigen::Vector3d start = Eigen::Vector3d::Zero();
    Eigen::Vector3d end = Eigen::Vector3d::Zero();

    [[nodiscard]] std::size_t size() const { return last - first + 1; }
};

/// The runs of one path that a repair keeps, in their order: those in the component of free space
/// where most of the free frames are, and those of another component that holds at least a tenth of
/// the path. If no frame is free, the frame nearest to free space, moved there; empty if that is
/// farther than a metre. Empty if cancelled.
std::vector<FreeRun> findRunsToKeep(const MappedScene& scene, const MotionCheck& check,
                                    std::span<const TrajectoryFrame> frames, const FreeParts& parts,
                                    const JobContext& job);

}  // namespace dollytrack::planning
