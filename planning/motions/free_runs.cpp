#include "planning/motions/free_runs.h"

#include "engine/jobs/parallel.h"
#include "planning/collision/mapped_scene.h"
#include "planning/collision/swept_sphere.h"
#include "planning/free_space/free_space.h"
#include "planning/motions/motion_check.h"

#include <algorithm>
#include <limits>
#include <map>

namespace dollytrack::planning {
namespace {

// A component of free space with a smaller share of the frames of a path was entered by mistake.
constexpr double kLeastShare = 0.1;
// A path that nowhere comes this near to free space, m, cannot be repaired.
constexpr double kNearest = 1.0;
// Frames of a path without any free frame that are compared for their distance from free space.
constexpr std::size_t kFramesCompared = 100;

int componentOf(const MotionCheck& check, std::span<const TrajectoryFrame> frames,
                const FreeRun& run) {
    for (std::size_t i = run.first; i <= run.last; ++i) {
        const int component = check.componentOf(frames[i].pose.position);
        if (component >= 0) return component;
    }
    return -1;
}

/// Shortens runs at ends where the camera all but touches a surface: no proven move leaves there.
void shorten(const SweptSphere& sphere, std::span<const TrajectoryFrame> frames,
             const JobContext& job, std::vector<FreeRun>& runs) {
    const auto isStuck = [&](std::size_t i) {
        const Eigen::Vector3d& position = frames[i].pose.position;
        return !job.cancelled() && !sphere.segment(position, position).free;
    };
    std::erase_if(runs, [&](FreeRun& run) {
        while (run.first > 0 && run.first < run.last && isStuck(run.first)) ++run.first;
        while (run.last + 1 < frames.size() && run.last > run.first && isStuck(run.last)) {
            --run.last;
        }
        run.start = frames[run.first].pose.position;
        run.end = frames[run.last].pose.position;
        return run.first == run.last && isStuck(run.first);
    });
}

/// The frame nearest to free space, moved there.
std::vector<FreeRun> nearestRun(const MappedScene& scene, std::span<const TrajectoryFrame> frames,
                                const JobContext& job) {
    const std::size_t stride = frames.size() / kFramesCompared + 1;
    std::vector<FreeRun> nearest((frames.size() + stride - 1) / stride);
    std::vector<double> squared(nearest.size(), kNearest * kNearest);
    parallelFor(nearest.size(), [&](std::size_t k) {
        const std::size_t i = k * stride;
        const Eigen::Vector3d& wish = frames[i].pose.position;
        for (const Room& room : scene.free_space->rooms()) {
            for (const Eigen::Vector3f& cell : scene.sphere->cells(room.component)) {
                if (job.cancelled()) return;
                const Eigen::Vector3d place = cell.cast<double>();
                const double distance2 = (place - wish).squaredNorm();
                if (distance2 >= squared[k] || !scene.sphere->fits(place)) continue;
                squared[k] = distance2;
                nearest[k] = {i, i, room.component, place, place};
            }
        }
    });
    if (job.cancelled()) return {};
    const auto best = std::min_element(squared.begin(), squared.end());
    if (best == squared.end() || *best >= kNearest * kNearest) return {};
    return {nearest[static_cast<std::size_t>(best - squared.begin())]};
}

}  // namespace

FreeParts findFreeParts(const MotionCheck& check, std::span<const TrajectoryFrame> frames,
                        const JobContext& job) {
    FreeParts parts;
    parts.frames.assign(frames.size(), 0);
    parts.moves.assign(frames.size() - 1, 0);
    parallelFor(frames.size(), [&](std::size_t i) {
        if (job.cancelled()) return;
        const Eigen::Vector3d& here = frames[i].pose.position;
        parts.frames[i] = check.isFree(here) ? 1 : 0;
        if (i + 1 == frames.size()) return;
        parts.moves[i] = check.isFree(here, frames[i + 1].pose.position) ? 1 : 0;
    });
    return parts;
}

std::vector<FreeRun> findRunsToKeep(const MappedScene& scene, const MotionCheck& check,
                                    std::span<const TrajectoryFrame> frames, const FreeParts& parts,
                                    const JobContext& job) {
    std::vector<FreeRun> runs;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        if (!parts.frames[i]) continue;
        if (i > 0 && parts.frames[i - 1] && parts.moves[i - 1]) {
            runs.back().last = i;
            runs.back().end = frames[i].pose.position;
        } else {
            runs.push_back({i, i, 0, frames[i].pose.position, frames[i].pose.position});
        }
    }
    // A free path is kept wherever it is.
    if (runs.size() == 1 && runs.front().size() == frames.size()) return runs;
    shorten(*scene.sphere, frames, job, runs);
    std::map<int, std::size_t> sizes;  // frames, by component
    for (FreeRun& run : runs) {
        if (job.cancelled()) return {};
        run.component = componentOf(check, frames, run);
        if (run.component >= 0) sizes[run.component] += run.size();
    }
    if (sizes.empty()) return nearestRun(scene, frames, job);
    const int main = std::max_element(sizes.begin(), sizes.end(), [](const auto& a, const auto& b) {
                         return a.second < b.second;
                     })->first;
    std::erase_if(runs, [&](const FreeRun& run) {
        return run.component < 0 ||
               (run.component != main && static_cast<double>(sizes[run.component]) <
                                             kLeastShare * static_cast<double>(frames.size()));
    });
    return runs;
}

}  // namespace dollytrack::planning
