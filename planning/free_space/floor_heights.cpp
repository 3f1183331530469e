#include "planning/free_space/floor_heights.h"

#include "engine/geometry/ray_caster.h"
#include "engine/jobs/parallel.h"
#include "engine/scene/labels.h"
#include "planning/free_space/free_space.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dollytrack::planning {
namespace {

constexpr double kLevel = 0.5;  // least |z| of the normal: stairs and ramps count, walls do not
constexpr int kMostSurfaces = 256;
constexpr double kApart_m = 0.001;

enum class Ground { None, Floor, Wall };

Ground groundAt(const Scene& scene, const RayHit& hit) {
    const Object& object = scene.object(hit.object_id);
    if (!object.structure || object.nyu40 == kNyuDoor || object.nyu40 == kNyuWindow) {
        return Ground::None;
    }
    const Triangle& t = scene.triangles[hit.triangle];
    const Eigen::Vector3f& a = scene.positions[t[0]];
    const Eigen::Vector3f normal =
        (scene.positions[t[1]] - a).cross(scene.positions[t[2]] - a).normalized();
    if (std::abs(normal.z()) <= kLevel) return Ground::None;
    const bool wall = object.nyu40 == kNyuWall || object.nyu40 == kNyuCeiling;
    return wall ? Ground::Wall : Ground::Floor;
}

}  // namespace

FloorHeights::FloorHeights(const Scene& scene, const RayCaster& rays, const FreeSpace& free_space,
                           double camera_radius_m)
    : origin_(free_space.bounds().min().head<2>()), cell_m_(free_space.resolution_m()) {
    const Eigen::Vector3d size = free_space.bounds().sizes();
    columns_x_ = static_cast<int>(std::lround(size.x() / cell_m_));
    columns_y_ = static_cast<int>(std::lround(size.y() / cell_m_));
    for (const Room& room : free_space.rooms()) {
        // Centre of the lowest cell where the sphere fits, minus the sphere's radius.
        rooms_.push_back({room.box, room.box.min().z() + 0.5 * cell_m_ - camera_radius_m});
    }
    floors_.resize(static_cast<std::size_t>(columns_x_) * static_cast<std::size_t>(columns_y_));
    const double top = free_space.bounds().max().z();
    const double depth = size.z() + 1.0;
    parallelRanges(floors_.size(), 256, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const auto x = static_cast<double>(i % static_cast<std::size_t>(columns_x_));
            const auto y = static_cast<double>(i / static_cast<std::size_t>(columns_x_));
            const Eigen::Vector3d from(origin_.x() + (x + 0.5) * cell_m_,
                                       origin_.y() + (y + 0.5) * cell_m_, top);
            const bool in_a_room =
                std::any_of(rooms_.begin(), rooms_.end(), [&](const RoomFloor& room) {
                    const Eigen::Vector2d at = from.head<2>();
                    return (at.array() >= room.box.min().head<2>().array() - cell_m_).all() &&
                           (at.array() <= room.box.max().head<2>().array() + cell_m_).all();
                });
            if (!in_a_room) continue;
            double reached = 0.0;
            std::vector<float> of_walls;
            for (int k = 0; k < kMostSurfaces; ++k) {
                const RayHit hit = rays.cast(from, -Eigen::Vector3d::UnitZ(), depth, reached);
                if (hit.object_id == 0) break;
                const Ground ground = groundAt(scene, hit);
                const auto height = static_cast<float>(top - hit.distance);
                if (ground == Ground::Floor) floors_[i].push_back(height);
                if (ground == Ground::Wall) of_walls.push_back(height);
                reached = hit.distance + kApart_m;
            }
            if (floors_[i].empty()) floors_[i] = std::move(of_walls);
            std::reverse(floors_[i].begin(), floors_[i].end());
        }
    });
}

bool FloorHeights::hasAny() const {
    return std::ranges::any_of(floors_, [](const auto& column) { return !column.empty(); });
}

double FloorHeights::roomFloor(const Eigen::Vector3d& place) const {
    double height = std::numeric_limits<double>::lowest();
    for (const RoomFloor& room : rooms_) {
        const bool above = place.z() >= room.height &&
                           (place.head<2>().array() >= room.box.min().head<2>().array()).all() &&
                           (place.head<2>().array() <= room.box.max().head<2>().array()).all();
        if (above) height = std::max(height, room.height);
    }
    return height == std::numeric_limits<double>::lowest() ? rooms_.front().height : height;
}

FloorHeights::Span FloorHeights::below(const Eigen::AlignedBox3d& places) const {
    const auto column = [&](double at, double origin, int count) {
        return std::clamp(static_cast<int>(std::floor((at - origin) / cell_m_)), 0, count - 1);
    };
    const int x0 = column(places.min().x(), origin_.x(), columns_x_);
    const int x1 = column(places.max().x(), origin_.x(), columns_x_);
    const int y0 = column(places.min().y(), origin_.y(), columns_y_);
    const int y1 = column(places.max().y(), origin_.y(), columns_y_);
    const auto low = static_cast<float>(places.min().z());
    const auto high = static_cast<float>(places.max().z());
    Span span{std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest()};
    for (int y = y0; y <= y1; ++y) {
        for (int x = x0; x <= x1; ++x) {
            const std::vector<float>& floors =
                floors_[static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_x_) +
                        static_cast<std::size_t>(x)];
            const auto above_low = std::upper_bound(floors.begin(), floors.end(), low);
            const auto above_high = std::upper_bound(above_low, floors.end(), high);
            if (above_high == floors.begin()) continue;
            // From the floor below the lowest position to the one below the highest.
            const auto first = above_low == floors.begin() ? above_low : above_low - 1;
            span.lowest = std::min(span.lowest, static_cast<double>(*first));
            span.highest = std::max(span.highest, static_cast<double>(*(above_high - 1)));
        }
    }
    if (span.lowest > span.highest) {
        span.lowest = span.highest = roomFloor(places.min());
    }
    return span;
}

}  // namespace dollytrack::planning
