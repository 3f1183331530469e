#include "render/scene/moving_objects.h"

#include <algorithm>
#include <utility>

namespace dollytrack::render {
namespace {

// Frames are processed nearly in order, each needing its neighbours.
constexpr std::size_t kRemembered = 24;

}  // namespace

MovingObjects::MovingObjects(const Scene& scene, const RayCaster& rays,
                             std::vector<ObjectMotion> motions)
    : scene_(scene), rays_(rays), motions_(std::move(motions)) {
    std::ranges::sort(motions_, {}, &ObjectMotion::object_id);
    if (motions_.empty()) return;
    moved_ = scene;
    moved_.textures.clear();
}

std::vector<Eigen::Isometry3d> MovingObjects::between(int from, int to) const {
    std::vector<Eigen::Isometry3d> all;
    if (motions_.empty()) return all;
    all.resize(scene_.objects.size() + 1, Eigen::Isometry3d::Identity());
    for (const ObjectMotion& motion : motions_) {
        all[motion.object_id] = motion.by_frame[to] * motion.by_frame[from].inverse();
    }
    return all;
}

std::vector<Eigen::Isometry3d> MovingObjects::toRest(int from) const {
    std::vector<Eigen::Isometry3d> all;
    if (motions_.empty()) return all;
    all.resize(scene_.objects.size() + 1, Eigen::Isometry3d::Identity());
    for (const ObjectMotion& motion : motions_) {
        all[motion.object_id] = motion.by_frame[from].inverse();
    }
    return all;
}

MovingObjects::Shape MovingObjects::shapeAt(const ObjectMotion& motion, int frame) const {
    const Object& object = scene_.object(motion.object_id);
    const Eigen::Isometry3d& now = motion.by_frame[frame];
    Shape shape;
    for (std::uint32_t v = object.first_vertex; v < object.first_vertex + object.vertex_count;
         ++v) {
        shape.positions.push_back((now * scene_.positions[v].cast<double>()).cast<float>());
        shape.normals.push_back((now.linear() * scene_.normals[v].cast<double>()).cast<float>());
    }
    return shape;
}

std::optional<MovedShape> MovingObjects::wholeShapeAt(int frame) const {
    if (motions_.empty()) return std::nullopt;
    MovedShape whole{scene_.positions, scene_.normals};
    for (const ObjectMotion& motion : motions_) {
        const Shape there = shapeAt(motion, frame);
        const auto first =
            static_cast<std::ptrdiff_t>(scene_.object(motion.object_id).first_vertex);
        std::ranges::copy(there.positions, whole.positions.begin() + first);
        std::ranges::copy(there.normals, whole.normals.begin() + first);
    }
    return whole;
}

std::shared_ptr<const RayCaster> MovingObjects::raysAt(int frame) const {
    // Not owned: the caller keeps the ray caster alive.
    if (motions_.empty()) return {std::shared_ptr<const RayCaster>(), &rays_};
    const std::lock_guard lock(mutex_);
    const auto known = cache_.find(frame);
    if (known != cache_.end()) return known->second;
    std::vector<int> ids;
    for (const ObjectMotion& motion : motions_) {
        const Shape shape = shapeAt(motion, frame);
        std::ranges::copy(shape.positions,
                          moved_.positions.begin() + scene_.object(motion.object_id).first_vertex);
        ids.push_back(motion.object_id);
    }
    if (cache_.size() >= kRemembered) {
        // The frame farthest away will be needed last.
        const auto furthest = std::ranges::max_element(
            cache_, {}, [&](const auto& entry) { return std::abs(entry.first - frame); });
        cache_.erase(furthest);
    }
    return cache_.emplace(frame, std::make_shared<const RayCaster>(moved_, rays_, ids))
        .first->second;
}

}  // namespace dollytrack::render
