#pragma once

#include "engine/math/pose.h"
#include "engine/plan/capture.h"

#include <array>
#include <map>
#include <optional>
#include <vector>

namespace dollytrack::planning {

class MovedObjects;
class ViewEstimator;

/// Cache of estimates of targets by pose, for trajectories that share most frames with earlier
/// ones, as in repair or after small edits. The owner clears it when the camera or the scene
/// changes; if objects only moved, forget() is enough. Not thread-safe.
class ViewCache {
  public:
    struct CoarseEstimate {
        ObjectView view;  // its frame index is not maintained
        Eigen::AlignedBox2d box;
    };
    struct Entry {
        std::vector<CoarseEstimate> coarse;  // by ascending object id
        std::map<int, ObjectView> exact;     // exact estimates, by object id
        unsigned used = 0;
    };

    /// Starts a new trajectory; drops the poses that the last few trajectories did not use.
    void begin();
    /// Null if the pose is unknown. Valid until begin().
    [[nodiscard]] Entry* find(const Pose& pose);
    Entry& keep(const Pose& pose, std::vector<CoarseEstimate> coarse);
    void clear() { entries_.clear(); }
    /// Drops entries that moved objects may have changed. `now` estimates views in the scene after
    /// the move.
    void forget(const MovedObjects& moved, const ViewEstimator& now);

  private:
    static constexpr unsigned kKept = 4;          // trajectories for which unused entries are kept
    static constexpr std::size_t kMany = 20'000;  // entries; beyond that, only those of the last
                                                  // trajectory are kept
    std::map<std::array<double, 7>, Entry> entries_;
    unsigned now_ = 0;
};

}  // namespace dollytrack::planning
