#pragma once

#include "render/verify/check.h"

#include <memory>
#include <span>
#include <vector>

namespace dollytrack::verify {

/// A camera among the scene's triangles as they are in one frame. Of one thread.
class FrameRays {
  public:
    /// `camera` is the frame's own or the other one of a stereo pair. The subject has a scene.
    FrameRays(const Subject& subject, const StoredFrame& frame, const Pose& camera);
    ~FrameRays();
    FrameRays(const FrameRays&) = delete;
    FrameRays& operator=(const FrameRays&) = delete;

    /// What the rays through the pixel centres of row y meet; distances are planar depths.
    void castRow(int y, std::vector<RayHit>& hits);

    /// What the rays to these places, world, meet first; distances are planar depths.
    void castTo(std::span<const Eigen::Vector3d> places, std::vector<RayHit>& hits);

    /// Whether the pixel may show this object at this depth, or nothing (id 0). Drawing rounds
    /// corners to fractions of a pixel, so that it may see past an edge what the ray through the
    /// centre does not, and the other way round.
    [[nodiscard]] bool mayShow(int x, int y, int id, double metres, double rounding_m) const;

    /// The same, whatever object it is.
    [[nodiscard]] bool mayShowDepth(int x, int y, double metres, double rounding_m) const;

    /// From the camera's centre to the nearest surface, m.
    [[nodiscard]] double clearance() const { return rays_.closest(pose_.position).distance; }

    /// The triangles as they are in the frame.
    [[nodiscard]] const RayCaster& rays() const { return rays_; }
    [[nodiscard]] const Scene& scene() const { return scene_; }

    static constexpr double kFarthest = 65.5355;  // what a depth image can hold, m
    static constexpr double kDrawing = 5e-5;      // single precision, a metre
    // Drawing keeps corners at 256ths of a pixel, and computes them in single precision.
    static constexpr double kNudge_px = 0.01;
    // Depth of steeper surfaces (m a px) is not drawn but found by rays.
    static constexpr double kSteep = 0.05;
    // What drawing may place a surface beside its true depth, m.
    static constexpr double kDrawn_m = kNudge_px * kSteep;

  private:
    struct MovedScene;
    [[nodiscard]] static std::unique_ptr<MovedScene> moved(const Subject& subject,
                                                           const StoredFrame& frame);
    [[nodiscard]] Eigen::Vector3d alongWorld(double x, double y) const;
    [[nodiscard]] double planeDepth(std::uint32_t triangle, double x, double y) const;
    [[nodiscard]] bool isNear(int id, const Eigen::Vector3d& point, double radius_m) const;
    [[nodiscard]] bool isBeside(int x, int y, int id, double metres, double slack) const;
    [[nodiscard]] bool isDepthOn(std::uint32_t triangle, int x, int y, double metres,
                                 double slack) const;

    std::unique_ptr<MovedScene> moved_;  // null for the scene at rest
    const Scene& scene_;
    const RayCaster& rays_;
    const StoredDataset& dataset_;
    Pose pose_;
    std::vector<RayCaster::BundleRay> bundle_;
};

}  // namespace dollytrack::verify
