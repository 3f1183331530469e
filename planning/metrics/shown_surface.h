#pragma once

#include "engine/camera/trajectory.h"
#include "engine/core/result.h"
#include "engine/jobs/job.h"

#include <array>
#include <map>
#include <memory>
#include <vector>

namespace dollytrack::planning {

class ViewEstimator;

/// What the images of a trajectory show as a whole; see TrajectoryMetrics for the two rates.
struct ShownSurface {
    double repeat_rate = 0.0;
    double object_pixels = 0.0;
};

/// The patches of surface that each frame shows, numbered from 0: what tells repeats apart, for
/// any choice of the frames.
class FrameSurfaces {
  public:
    /// How many of the frames, taken in this order, show nothing new; see TrajectoryMetrics.
    [[nodiscard]] int repeats(const std::vector<std::size_t>& frames) const;
    /// The same of all.
    [[nodiscard]] int repeats() const;

    /// Mean share of the rays that meet targets.
    [[nodiscard]] double objectPixels() const;
    [[nodiscard]] std::size_t frames() const { return shown_.size(); }

    /// What one pose shows.
    struct Shown {
        std::vector<int> patches;  // each once
        int on_targets = 0;        // rays
    };

  private:
    friend class SurfaceLooks;
    std::vector<std::shared_ptr<const Shown>> shown_;  // by frame
    int patches_ = 0;
    int rays_ = 1;  // a frame
};

/// Looks at surfaces through frames, by a grid of rays each, and remembers what poses show: the key
/// frames of a trajectory stay where they are whatever its rate. For one scene that does not
/// change.
class SurfaceLooks {
  public:
    /// Glance: a quarter of the rays and patches of twice the size, for about the same answers.
    enum class Detail { Full, Glance };
    explicit SurfaceLooks(const ViewEstimator& views, Detail detail = Detail::Full);
    ~SurfaceLooks();
    SurfaceLooks(const SurfaceLooks&) = delete;
    SurfaceLooks& operator=(const SurfaceLooks&) = delete;

    /// Error: Cancelled.
    Result<FrameSurfaces> look(const Trajectory& trajectory, const JobContext& job);

  private:
    class Numbers;
    const ViewEstimator& views_;
    Detail detail_;
    std::unique_ptr<Numbers> numbers_;  // of patches
    std::map<std::array<double, 7>, std::shared_ptr<const FrameSurfaces::Shown>> shown_;
};

/// By a grid of rays through every frame. Error: Cancelled.
Result<ShownSurface> measureShownSurface(const ViewEstimator& views, const Trajectory& trajectory,
                                         const JobContext& job);

}  // namespace dollytrack::planning
