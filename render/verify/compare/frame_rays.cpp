#include "render/verify/compare/frame_rays.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dollytrack::verify {
namespace {

constexpr double kRay_px = 1e-3;  // rounding of ray directions in single precision

/// Whether rays around a pixel's centre reach the surface that the pixel shows.
class RayVisibility {
  public:
    /// @param id  object that the pixel shows; 0 if unknown
    RayVisibility(int id, double metres) : id_(id), metres_(metres) {}

    void add(const RayHit& hit) {
        if (hit.object_id == 0 || hit.object_id == id_ || hit.distance >= metres_) {
            reaches_ = true;
        } else if (first_ == kNone) {
            first_ = hit.triangle;
        } else if (first_ != hit.triangle) {
            on_edge_ = true;
        }
    }
    /// Along the edge of two triangles rasterisation may leave a crack and show a surface that no
    /// ray hits.
    [[nodiscard]] bool mayPass() const { return reaches_ || on_edge_; }

  private:
    int id_;
    double metres_;
    static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
    std::uint32_t first_ = kNone;
    bool reaches_ = false, on_edge_ = false;
};

}  // namespace

/// A copy of the scene's geometry with moved objects.
struct FrameRays::MovedScene {
    Scene scene;
    std::unique_ptr<RayCaster> rays;
};

std::unique_ptr<FrameRays::MovedScene> FrameRays::moved(const Subject& subject,
                                                        const StoredFrame& frame) {
    if (frame.moving.empty()) return nullptr;
    auto moved = std::make_unique<MovedScene>();
    Scene& scene = moved->scene;
    scene.positions = subject.scene->positions;
    scene.triangles = subject.scene->triangles;
    scene.objects = subject.scene->objects;
    std::vector<int> ids;
    for (const MovedObject& one : frame.moving) {
        if (one.object_id < 1 || one.object_id > static_cast<int>(scene.objects.size())) continue;
        const Object& object = scene.object(one.object_id);
        for (std::uint32_t i = 0; i < object.vertex_count; ++i) {
            Eigen::Vector3f& corner = scene.positions[object.first_vertex + i];
            corner = (one.now_from_rest * corner.cast<double>()).cast<float>();
        }
        ids.push_back(one.object_id);
    }
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    moved->rays = std::make_unique<RayCaster>(scene, *subject.rays, ids);
    return moved;
}

FrameRays::FrameRays(const Subject& subject, const StoredFrame& frame, const Pose& camera)
    : moved_(moved(subject, frame)),
      scene_(moved_ ? moved_->scene : *subject.scene),
      rays_(moved_ ? *moved_->rays : *subject.rays),
      dataset_(subject.dataset),
      pose_(camera) {}

FrameRays::~FrameRays() = default;

Eigen::Vector3d FrameRays::alongWorld(double x, double y) const {
    return pose_.rotation * dataset_.lens.unproject(x, y);
}

void FrameRays::castRow(int y, std::vector<RayHit>& hits) {
    bundle_.clear();
    for (int x = 0; x < dataset_.lens.width; ++x) {
        bundle_.push_back({alongWorld(x + 0.5, y + 0.5)});
    }
    rays_.castBundle(pose_.position, bundle_, dataset_.near_m, hits);
}

void FrameRays::castTo(std::span<const Eigen::Vector3d> places, std::vector<RayHit>& hits) {
    bundle_.clear();
    for (const Eigen::Vector3d& place : places) {
        bundle_.push_back({(place - pose_.position) / pose_.toCamera(place).z()});
    }
    rays_.castBundle(pose_.position, bundle_, dataset_.near_m, hits);
}

double FrameRays::planeDepth(std::uint32_t triangle, double x, double y) const {
    const Triangle& corners = scene_.triangles[triangle];
    const Eigen::Vector3d a = scene_.positions[corners[0]].cast<double>();
    const Eigen::Vector3d normal = (scene_.positions[corners[1]].cast<double>() - a)
                                       .cross(scene_.positions[corners[2]].cast<double>() - a);
    return normal.dot(a - pose_.position) / normal.dot(alongWorld(x, y));
}

/// Whether a triangle's plane has this depth at a pixel's centre. Rasterisation is off by up to
/// kNudge_px on surfaces up to kSteep; depth of steeper ones was found by ray casts.
bool FrameRays::isDepthOn(std::uint32_t triangle, int x, int y, double metres, double slack) const {
    constexpr double kMostSlope = 5.0;  // m per px: a steeper plane is seen edge-on
    const double at_centre = planeDepth(triangle, x + 0.5, y + 0.5);
    const double slope = std::abs(planeDepth(triangle, x + 0.501, y + 0.5) - at_centre) * 1e3 +
                         std::abs(planeDepth(triangle, x + 0.5, y + 0.501) - at_centre) * 1e3;
    return std::abs(metres - at_centre) <=
           slack + kNudge_px * std::min(slope, kSteep) + kRay_px * std::min(slope, kMostSlope);
}

/// Whether an object (0: any) has a surface this near to a point. Several objects may share a
/// surface.
bool FrameRays::isNear(int id, const Eigen::Vector3d& point, double radius_m) const {
    const ClosestPoint near =
        id == 0 ? rays_.closest(point, radius_m) : rays_.closestOn(id, point, radius_m);
    return near.object_id != 0;
}

/// Whether the point shown is as near to a surface as rasterisation places it. On surfaces seen
/// edge-on the depth along the ray may be off much more.
bool FrameRays::isBeside(int x, int y, int id, double metres, double slack) const {
    const Eigen::Vector3d along = alongWorld(x + 0.5, y + 0.5);
    return isNear(id, pose_.position + metres * along, (slack + kDrawn_m) * along.norm());
}

bool FrameRays::mayShow(int x, int y, int id, double metres, double rounding_m) const {
    if (id > static_cast<int>(scene_.objects.size())) return false;
    const double slack = rounding_m + kDrawing * (1.0 + metres);
    RayVisibility visibility(id, metres - slack);
    for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
            const Eigen::Vector3d along =
                alongWorld(x + 0.5 + kNudge_px * dx, y + 0.5 + kNudge_px * dy);
            const RayHit hit = rays_.cast(pose_.position, along, kFarthest, dataset_.near_m);
            visibility.add(hit);
            if (id == 0 || hit.object_id == 0) {
                if (id == hit.object_id) return true;
                continue;
            }
            if (hit.object_id == id && isDepthOn(hit.triangle, x, y, metres, slack)) return true;
            // Of two coincident objects either may be drawn.
            if (hit.distance < metres - slack) continue;
            const Eigen::Vector3d start = pose_.position + (metres - slack) * along;
            if (rays_.meetsObject(id, start, along, 2.0 * slack)) return true;
        }
    }
    if (id == 0) return false;
    return visibility.mayPass() && isBeside(x, y, id, metres, slack);
}

bool FrameRays::mayShowDepth(int x, int y, double metres, double rounding_m) const {
    if (metres <= 0.0) return mayShow(x, y, 0, metres, rounding_m);
    const double slack = rounding_m + kDrawing * (1.0 + metres);
    RayVisibility visibility(0, metres - slack);
    for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
            const Eigen::Vector3d along =
                alongWorld(x + 0.5 + kNudge_px * dx, y + 0.5 + kNudge_px * dy);
            const RayHit hit = rays_.cast(pose_.position, along, kFarthest, dataset_.near_m);
            visibility.add(hit);
            if (hit.object_id != 0 && isDepthOn(hit.triangle, x, y, metres, slack)) return true;
        }
    }
    return visibility.mayPass() && isBeside(x, y, 0, metres, slack);
}

}  // namespace dollytrack::verify
