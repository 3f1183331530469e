#include "render/rig/rig_labels.h"

#include "render/draw/shading_normal.h"

#include <limits>

namespace dollytrack::render {
namespace {

/// Casts the rays of one image row.
class RowOfRays {
  public:
    RowOfRays(const LensModel& lens, const Pose& pose, const RayCaster& rays, double near_m)
        : lens_(lens), pose_(pose), rays_(rays), near_m_(near_m) {}

    struct Seen {
        int x = 0;
        Eigen::Vector3d origin, direction;
        RayHit hit;
    };

    const std::vector<Seen>& cast(int y) {
        seen_.clear();
        for (int x = 0; x < lens_.width(); ++x) {
            const std::optional<LensRay> ray = lens_.ray(x + 0.5, y + 0.5);
            if (!ray) continue;
            seen_.push_back({x, pose_.toWorld(ray->origin), pose_.rotation * ray->direction, {}});
        }
        if (lens_.lens() == Lens::Orthographic) {
            for (Seen& one : seen_) {
                one.hit = rays_.cast(one.origin, one.direction,
                                     std::numeric_limits<double>::infinity(), near_m_);
            }
            return seen_;
        }
        bundle_.clear();
        for (const Seen& one : seen_) bundle_.push_back({one.direction});
        rays_.castBundle(pose_.position, bundle_, near_m_, hits_);
        for (std::size_t i = 0; i < seen_.size(); ++i) seen_[i].hit = hits_[i];
        return seen_;
    }

  private:
    const LensModel& lens_;
    const Pose& pose_;
    const RayCaster& rays_;
    double near_m_;
    std::vector<Seen> seen_;
    std::vector<RayCaster::BundleRay> bundle_;
    std::vector<RayHit> hits_;
};

}  // namespace

LensImages castLens(const LensModel& lens, const Pose& pose, const FrameContext& context,
                    int frame) {
    const auto pixels =
        static_cast<std::size_t>(lens.width()) * static_cast<std::size_t>(lens.height());
    LensImages images;
    images.depth_m.assign(pixels, 0.0F);
    images.instance.assign(pixels, 0);
    images.normals_in_world.assign(pixels, Eigen::Vector3f::Zero());
    const std::shared_ptr<const RayCaster> rays = context.moving.raysAt(frame);
    const std::vector<Eigen::Isometry3d> to_rest = context.moving.toRest(frame);
    RowOfRays row(lens, pose, *rays, context.contents.camera.near_m);
    for (int y = 0; y < lens.height(); ++y) {
        const std::size_t first = static_cast<std::size_t>(y) * lens.width();
        for (const RowOfRays::Seen& one : row.cast(y)) {
            if (one.hit.object_id == 0) continue;
            const std::size_t pixel = first + static_cast<std::size_t>(one.x);
            images.instance[pixel] = static_cast<std::uint16_t>(one.hit.object_id);
            images.depth_m[pixel] = static_cast<float>(one.hit.distance);
            images.normals_in_world[pixel] =
                shadingNormal(context.contents.scene, to_rest, one.hit, one.origin, one.direction)
                    .cast<float>();
        }
    }
    return images;
}

}  // namespace dollytrack::render
