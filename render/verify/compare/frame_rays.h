#pragma once

#include "render/verify/compare/check.h"

#include <memory>
#include <span>
#include <vector>

namespace dollytrack::verify {

/// Ray casts from a camera into the scene at one frame's time. For one thread.
class FrameRays {
  public:
    /// `camera` is the frame's camera or the right one of a stereo pair. The subject must have a
    /// scene.
    FrameRays(const Subject& subject, const StoredFrame& frame, const Pose& camera);
    ~FrameRays();
    FrameRays(const FrameRays&) = delete;
    FrameRays& operator=(const FrameRays&) = delete;

    /// Casts rays through the pixel centres of row y; distances are planar depths.
    void castRow(int y, std::vector<RayHit>& hits);

    /// Casts rays towards world points and beyond them; each hit is the first surface. Distances
    /// are planar depths.
    void castTo(std::span<const Eigen::Vector3d> places, std::vector<RayHit>& hits);

    /// Whether a pixel may legitimately show this object at this depth, or nothing (id 0).
    /// Rasterisation rounds vertices to fractions of a pixel, so at edges it may differ from the
    /// ray through the pixel's centre.
    /// @param rounding_m  largest rounding error of the depth
    [[nodiscard]] bool mayShow(int x, int y, int id, double metres, double rounding_m) const;

    /// The same for any object.
    [[nodiscard]] bool mayShowDepth(int x, int y, double metres, double rounding_m) const;

    /// Distance from the camera's centre to the nearest surface, m.
    [[nodiscard]] double clearance() const { return rays_.closest(pose_.position).distance; }

    /// Ray caster of the scene at the frame's time.
    [[nodiscard]] const RayCaster& rays() const { return rays_; }
    [[nodiscard]] const Scene& scene() const { return scene_; }

    static constexpr double kFarthest = 65.5355;  // m, limit of a depth image
    static constexpr double kDrawing = 5e-5;      // error of single precision, per metre of depth
    // Rasterisation snaps vertices to 1/256 px and computes in single precision.
    static constexpr double kNudge_px = 0.01;
    // Slope, m per px, above which depth comes from ray casts instead of rasterisation.
    static constexpr double kSteep = 0.05;
    // Largest depth error of rasterisation, m.
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

    std::unique_ptr<MovedScene> moved_;  // null if nothing moves
    const Scene& scene_;
    const RayCaster& rays_;
    const StoredDataset& dataset_;
    Pose pose_;
    std::vector<RayCaster::BundleRay> bundle_;
};

}  // namespace dollytrack::verify
