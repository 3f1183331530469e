#pragma once

#include "engine/plan/viewpoint.h"
#include "planning/viewpoints/moved_objects.h"

#include <array>
#include <map>
#include <vector>

namespace dollytrack::planning {

class ViewEstimator;
enum class Objective;

/// Cache of the objects that poses show, so that moving one point does not resample all others. The
/// owner clears it when the scene, its targets or the camera change.
class VisibilityCache {
  public:
    struct Entry {
        std::vector<ShownObject> known;  // given in advance, not sampled
        std::vector<ShownObject> shown;  // objects captured well, including `known`
        std::vector<int> looked_at;      // ids of the sampled objects
    };
    [[nodiscard]] const Entry* find(const PositionPoint& point) const;
    void keep(const Pose& pose, Entry entry);
    void clear() { entries_.clear(); }
    /// Drops the entries that moved objects may have changed. `now` estimates views in the scene
    /// after the move.
    void forget(const MovedObjects& moved, const ViewEstimator& now);

  private:
    std::map<std::array<double, 7>, Entry> entries_;  // by position and rotation
};

/// CaptureGet of the paper's Algorithm 1: completes, for each position point, the lists of objects
/// that it captures and captures well. An object of another point counts only if its box is at
/// least 60 % as large as in that point's view, so that key frames shared by objects do not show
/// them much smaller. `memo` may be null.
void findCaptured(const ViewEstimator& views, std::vector<PositionPoint>& position_points,
                  VisibilityCache* memo = nullptr);

/// A small set of position points that captures everything any of them captures, by greedy set
/// cover; objects captured well count most. Order: all fixed points, then the chosen ones by what
/// they add, then all room views, then all surface views. Each object counts with its weight (at
/// index id - 1), or 1 if `weights` is empty. Returns indices.
std::vector<int> chooseKeyFrames(const std::vector<PositionPoint>& position_points,
                                 const std::vector<double>& weights = {});

/// As above, for a given objective: with Objective::Surface, captured objects are ignored.
std::vector<int> chooseKeyFrames(const std::vector<PositionPoint>& position_points,
                                 const std::vector<double>& weights, Objective objective);

}  // namespace dollytrack::planning
