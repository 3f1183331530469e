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

/// What the images of a trajectory show as a whole; see TrajectoryMetrics for both rates.
struct ShownSurface {
    double repeat_rate = 0.0;
    double object_pixels = 0.0;
};

/// The surface patches that each frame shows, numbered from 0, to count repeats for any subset of
/// the frames.
class FrameSurfaces {
  public:
    /// How many of these frames, in this order, show nothing new: new patches for fewer than 1 % of
    /// the rays.
    [[nodiscard]] int repeats(const std::vector<std::size_t>& frames) const;
    /// As above, for all frames.
    [[nodiscard]] int repeats() const;

    /// Mean share of the rays that hit targets, 0..1.
    [[nodiscard]] double objectPixels() const;
    [[nodiscard]] std::size_t frames() const { return shown_.size(); }

    /// Patches visible from one pose.
    struct Shown {
        std::vector<int> patches;  // without duplicates
        int on_targets = 0;        // number of rays
    };

  private:
    friend class SurfaceSampler;
    std::vector<std::shared_ptr<const Shown>> shown_;  // by frame
    int patches_ = 0;
    int rays_ = 1;  // per frame
};

/// Samples the surfaces visible in frames by a grid of rays each, and caches the result by pose:
/// key frames keep their poses at any frame rate. For one unchanging scene. Not thread-safe.
class SurfaceSampler {
  public:
    /// Fine: 32 x 24 rays and patches of 0.1 m. Coarse: 16 x 12 rays and patches of 0.2 m, with
    /// about the same results.
    enum class Detail { Fine, Coarse };
    explicit SurfaceSampler(const ViewEstimator& views, Detail detail = Detail::Fine);
    ~SurfaceSampler();
    SurfaceSampler(const SurfaceSampler&) = delete;
    SurfaceSampler& operator=(const SurfaceSampler&) = delete;

    /// Samples all frames of a trajectory at new poses. Error: Cancelled, which also clears the
    /// cache.
    Result<FrameSurfaces> sample(const Trajectory& trajectory, const JobContext& job);

  private:
    class Numbers;
    const ViewEstimator& views_;
    Detail detail_;
    std::unique_ptr<Numbers> numbers_;  // of patches
    std::map<std::array<double, 7>, std::shared_ptr<const FrameSurfaces::Shown>> shown_;
};

/// The repeat rate and the share of pixels on objects of a trajectory, sampled with Detail::Fine.
/// Error: Cancelled.
Result<ShownSurface> measureShownSurface(const ViewEstimator& views, const Trajectory& trajectory,
                                         const JobContext& job);

}  // namespace dollytrack::planning
