#pragma once

#include "engine/plan/viewpoint.h"
#include "planning/viewpoints/moved_things.h"

#include <array>
#include <map>
#include <vector>

namespace dollytrack::planning {

class ViewEstimator;

/// Remembers what poses show, so that moving one point by hand does not look from all others again.
/// Whoever keeps one clears it when the views change: the scene, its targets, or the camera.
class ShownMemo {
  public:
    struct Entry {
        std::vector<ShownObject> known;  // beforehand: nothing was looked at for these
        std::vector<ShownObject> shown;  // those included
        std::vector<int> looked_at;      // ids that it rests on
    };
    [[nodiscard]] const Entry* find(const PositionPoint& point) const;
    void keep(const Pose& pose, Entry entry);
    void clear() { entries_.clear(); }
    /// Forgets what might show otherwise in the views that are now.
    void forget(const MovedThings& moved, const ViewEstimator& now);

  private:
    std::map<std::array<double, 7>, Entry> entries_;  // by position and rotation
};

/// CaptureGet of the paper's Algorithm 1: completes the lists of objects that each position point
/// captures and captures well, its own and every other. Another point's object counts only while
/// it shows nearly as large as in its own best view, so that sharing never trades fill away.
void findCaptured(const ViewEstimator& views, std::vector<PositionPoint>& position_points,
                  ShownMemo* memo = nullptr);

/// A small choice of position points that together capture all that all of them capture (greedy
/// set cover; well captured counts first), in order of what each adds. Fixed ones come first, all
/// of them; room views come last, in their own order. An object counts by its weight, of index id - 1; without weights all count alike.
std::vector<int> chooseKeyFrames(const std::vector<PositionPoint>& position_points,
                                 const std::vector<double>& weights = {});

}  // namespace dollytrack::planning
