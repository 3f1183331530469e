#pragma once

#include "engine/math/pose.h"
#include "engine/plan/capture.h"

#include <array>
#include <map>
#include <optional>
#include <vector>

namespace dollytrack::planning {

class MovedThings;
class ViewEstimator;

/// Remembers how targets show from poses, for trajectories that share most of their frames with
/// the ones looked at before: as one that is repaired, or smoothed a little differently. Whoever
/// keeps one clears it when the camera or the scene changes; when things have only moved,
/// forgetting is enough. For one thread.
class ViewMemo {
  public:
    struct Look {
        ObjectView view;  // its frame is not kept up to date
        Eigen::AlignedBox2d box;
    };
    struct Entry {
        std::vector<Look> looks;            // by rising object id
        std::map<int, ObjectView> closely;  // by object id
        unsigned used = 0;
    };

    /// Begins a trajectory; forgets what the last few had no use for.
    void begin();
    /// Null when the pose was not looked at. Valid until begin().
    [[nodiscard]] Entry* find(const Pose& pose);
    Entry& keep(const Pose& pose, std::vector<Look> looks);
    void clear() { entries_.clear(); }
    /// Forgets what might show otherwise in the views that are now.
    void forget(const MovedThings& moved, const ViewEstimator& now);

  private:
    static constexpr unsigned kKept = 4;          // trajectories
    static constexpr std::size_t kMany = 20'000;  // frames; beyond, only the last one's are kept
    std::map<std::array<double, 7>, Entry> entries_;
    unsigned now_ = 0;
};

}  // namespace dollytrack::planning
