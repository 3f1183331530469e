#include "engine/scene/room_bounds.h"

#include "engine/core/disjoint_sets.h"
#include "engine/scene/label_table.h"
#include "engine/scene/labels.h"

#include <algorithm>
#include <array>
#include <bitset>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <utility>

namespace dollytrack {
namespace {

constexpr double kNearby = 4.0;       // m: largest gap between objects of one building
constexpr double kTooWide = 2.2;      // times the rest's extent: a ground or sky
constexpr double kTooWideFlat = 1.6;  // the same for a flat object: a ground plane
// A building of one mesh, in contrast to a sky or a landscape: its bottom is at the feet of the
// objects in it, and it has the height of a few storeys.
constexpr double kSameLevel_m = 0.3;
constexpr double kHighestBuilding_m = 8.0;
constexpr double kHighestShare = 0.3;  // of the width; domes are higher
// Rooms beside the largest building: their least width and height, the least distance from a point
// to the surfaces around it, so that the point is in no object, and the least share of the
// horizontal directions from it in which a surface stands.
constexpr double kLeastRoom_m = 1.8;
constexpr double kLeastHeight_m = 1.9;
constexpr double kLeastDistance_m = 0.3;
constexpr double kClosed = 0.7;

struct Item {
    std::size_t object;
    Eigen::AlignedBox3d box;
};

/// Objects that are near each other, directly or through others, and the box around them.
struct Group {
    std::vector<std::size_t> objects;
    Eigen::AlignedBox3d bounds;
};

/// The groups of all items but the `first` ones; that with the most objects, or the longest
/// diagonal among equals, comes first.
std::vector<Group> groupsOf(const std::vector<Item>& items, std::size_t first) {
    DisjointSets sets(items.size());
    for (std::size_t i = first; i < items.size(); ++i) {
        for (std::size_t j = i + 1; j < items.size(); ++j) {
            if (items[i].box.exteriorDistance(items[j].box) > kNearby) continue;
            sets.joinTo(i, j);
        }
    }
    std::vector<Group> by_set(items.size());
    for (std::size_t i = first; i < items.size(); ++i) {
        Group& group = by_set[sets.find(i)];
        group.objects.push_back(items[i].object);
        group.bounds.extend(items[i].box);
    }
    std::erase_if(by_set, [](const Group& group) { return group.objects.empty(); });
    std::ranges::stable_sort(by_set, std::greater<>(), [](const Group& group) {
        return std::pair(group.objects.size(), group.bounds.diagonal().norm());
    });
    return by_set;
}

/// Whether an object is a building of one mesh that contains all the others, such as a hall with
/// few tables.
bool isBuildingAround(const Eigen::AlignedBox3d& box, const Eigen::AlignedBox3d& rest) {
    const Eigen::Vector3d size = box.sizes();
    const Eigen::Vector3d margin = Eigen::Vector3d::Constant(kSameLevel_m);
    return size.z() >= kLeastHeight_m && size.z() <= kHighestBuilding_m &&
           size.z() <= kHighestShare * size.head<2>().maxCoeff() &&
           std::abs(box.min().z() - rest.min().z()) <= kSameLevel_m &&
           Eigen::AlignedBox3d(box.min() - margin, box.max() + margin).contains(rest);
}

// Fewer objects are a sparse room, not a house on a plain or in front of a backdrop.
constexpr std::size_t kFewestObjects = 3;

/// Moves the backdrops to the front and returns their number; 0 and no change if the other objects
/// are no room without them.
std::size_t moveBackdropsFirst(const std::vector<Object>& objects, std::vector<Item>& items) {
    std::vector<Item> sorted = items;
    const auto rest = std::ranges::stable_partition(
        sorted, [&](const Item& item) { return isBackdrop(objects[item.object]); });
    const std::size_t count = sorted.size() - rest.size();
    if (count == 0 || rest.size() < kFewestObjects) return 0;
    const Eigen::Vector3d size = groupsOf(sorted, count).front().bounds.sizes();
    // The unit may be wrong, so that the room is small.
    if (size.minCoeff() < 0.5 * kLeastHeight_m) return 0;
    items = std::move(sorted);
    return count;
}

/// The items, the backdrops and then the widest first; the first ones may be skies, grounds and the
/// like.
struct SortedItems {
    std::vector<Item> items;
    std::size_t surrounding_count = 0;  // the first ones
};

SortedItems sortItems(const std::vector<Object>& objects, std::vector<Item> items_of_objects) {
    SortedItems sorted;
    std::vector<Item>& items = sorted.items;
    items = std::move(items_of_objects);
    const auto planSize = [](const Item& item) {
        return std::max(item.box.sizes().x(), item.box.sizes().y());
    };
    std::stable_sort(items.begin(), items.end(),
                     [&](const Item& a, const Item& b) { return planSize(a) > planSize(b); });
    const std::size_t backdrops = moveBackdropsFirst(objects, items);
    // The largest group without the k + 1 widest items.
    const auto restAfter = [&](std::size_t k) { return groupsOf(items, k + 1).front().bounds; };
    // Its horizontal extent; 0 if it is flat, such as a ground plane.
    const auto widthOf = [](const Eigen::AlignedBox3d& rest) {
        constexpr double kLowest_m = 0.5;
        const Eigen::Vector3d size = rest.sizes();
        return size.z() < kLowest_m ? 0.0 : std::max(size.x(), size.y());
    };
    // A sky may contain a ground that contains the house: removes each object that is huge compared
    // with all smaller ones, and all larger objects.
    std::size_t first = backdrops;
    constexpr std::size_t kMostHuge = 8;
    for (std::size_t k = first; k + 1 < items.size() && k < backdrops + kMostHuge; ++k) {
        if (planSize(items[k]) < 60.0) break;
        const double wide = widthOf(restAfter(k));
        if (wide > 0.0 && planSize(items[k]) > 3.0 * wide) first = k + 1;
    }
    // Then removes objects, the widest first, that are much wider than all the rest: they are
    // around the building.
    for (; first + 1 < items.size(); ++first) {
        if (items.size() - first - 1 < kFewestObjects) break;
        const Eigen::AlignedBox3d rest = restAfter(first);
        const double wide = widthOf(rest);
        const bool flat = items[first].box.sizes().z() < 0.05 * planSize(items[first]);
        const double limit = flat ? kTooWideFlat : kTooWide;
        if (wide < 4.0 || planSize(items[first]) <= limit * wide) break;
        if (isBuildingAround(items[first].box, rest)) break;
    }
    sorted.surrounding_count = first;
    return sorted;
}

/// The bounds of an object: of its vertices, because those of a turned box would reach beyond.
Eigen::AlignedBox3d boundsOfObject(const Scene& scene, const Object& object) {
    if (object.box.yaw == 0.0) return worldBounds(object.box);
    Eigen::AlignedBox3d bounds;
    for (std::uint32_t i = 0; i < object.vertex_count; ++i) {
        bounds.extend(scene.positions[object.first_vertex + i].cast<double>());
    }
    return bounds;
}

/// The horizontal directions from a point in which a surface stands.
class Horizon {
  public:
    explicit Horizon(Eigen::Vector3d from) : from_(std::move(from)) {}

    /// Adds the part of a triangle that is at the point's height.
    void add(const std::array<Eigen::Vector3d, 3>& corners) {
        std::array<Eigen::Vector2d, 2> ends;
        unsigned cuts = 0;
        for (unsigned i = 0; i < 3 && cuts < 2; ++i) {
            const Eigen::Vector3d a = corners[i] - from_;
            const Eigen::Vector3d b = corners[(i + 1) % 3] - from_;
            if ((a.z() < 0.0) == (b.z() < 0.0)) continue;
            ends[cuts++] = (a + a.z() / (a.z() - b.z()) * (b - a)).head<2>();
        }
        if (cuts < 2) return;
        const Eigen::Vector2d along = ends[1] - ends[0];
        const double part =
            std::clamp(-ends[0].dot(along) / std::max(along.squaredNorm(), 1e-12), 0.0, 1.0);
        nearest_m_ = std::min(nearest_m_, (ends[0] + part * along).norm());
        // The cut spans the smaller of the two angles between its ends.
        const auto azimuth = [](const Eigen::Vector2d& at) { return std::atan2(at.y(), at.x()); };
        const double turn =
            std::remainder(azimuth(ends[1]) - azimuth(ends[0]), 2.0 * std::numbers::pi);
        const double begin = azimuth(ends[turn < 0.0 ? 1 : 0]);
        constexpr double kStep = 2.0 * std::numbers::pi / kDirections;
        const auto first = static_cast<int>(std::ceil(begin / kStep));
        const auto last = static_cast<int>(std::floor((begin + std::abs(turn)) / kStep));
        for (int i = first; i <= last; ++i) seen_.set((i + kDirections) % kDirections);
    }

    /// Whether the point is in the open, and surfaces stand around it.
    [[nodiscard]] bool isEnclosed() const {
        return nearest_m_ >= kLeastDistance_m &&
               static_cast<double>(seen_.count()) >= kClosed * kDirections;
    }

  private:
    static constexpr int kDirections = 64;
    Eigen::Vector3d from_;
    std::bitset<kDirections> seen_;
    double nearest_m_ = std::numeric_limits<double>::infinity();
};

/// Whether a group of objects is a room that is closed on at least three sides, with an object in
/// it.
bool enclosesRoom(const Scene& scene, const Group& group) {
    const Eigen::AlignedBox3d& bounds = group.bounds;
    const Eigen::Vector3d size = bounds.sizes();
    if (size.head<2>().minCoeff() < kLeastRoom_m || size.z() < kLeastHeight_m) return false;
    const Eigen::AlignedBox3d inner(bounds.min() + 0.1 * size, bounds.max() - 0.1 * size);
    const bool furnished = std::ranges::any_of(group.objects, [&](std::size_t object) {
        const Eigen::AlignedBox3d box = worldBounds(scene.objects[object].box);
        return (box.min().head<2>().array() > inner.min().head<2>().array()).all() &&
               (box.max().head<2>().array() < inner.max().head<2>().array()).all();
    });
    if (!furnished) return false;
    // From several points, because furniture stands in some of them. At three heights, because
    // trees and tables are open below.
    constexpr std::array kHeights = {0.2, 0.5, 0.75};
    constexpr std::array kPlaces = {0.2, 0.35, 0.5, 0.65, 0.8};
    std::array<std::vector<Horizon>, kHeights.size()> horizons;
    std::array<double, kHeights.size()> heights = {};
    for (std::size_t level = 0; level < kHeights.size(); ++level) {
        heights[level] = bounds.min().z() + kHeights[level] * size.z();
        for (const double y : kPlaces) {
            for (const double x : kPlaces) {
                horizons[level].emplace_back(Eigen::Vector3d(bounds.min().x() + x * size.x(),
                                                             bounds.min().y() + y * size.y(),
                                                             heights[level]));
            }
        }
    }
    for (const std::size_t index : group.objects) {
        const Object& object = scene.objects[index];
        for (std::uint32_t i = 0; i < object.triangle_count; ++i) {
            const Triangle& triangle = scene.triangles[object.first_triangle + i];
            const auto z = [&](unsigned k) { return scene.positions[triangle[k]].z(); };
            const double low = std::min({z(0), z(1), z(2)});
            const double high = std::max({z(0), z(1), z(2)});
            for (std::size_t level = 0; level < heights.size(); ++level) {
                if (high < heights[level] || low > heights[level]) continue;
                for (Horizon& horizon : horizons[level]) {
                    horizon.add({scene.positions[triangle[0]].cast<double>(),
                                 scene.positions[triangle[1]].cast<double>(),
                                 scene.positions[triangle[2]].cast<double>()});
                }
            }
        }
    }
    for (std::size_t point = 0; point < horizons[0].size(); ++point) {
        if (std::ranges::all_of(horizons, [&](const std::vector<Horizon>& level) {
                return level[point].isEnclosed();
            })) {
            return true;
        }
    }
    return false;
}

}  // namespace

bool isBackdrop(const Object& object) {
    return object.structure && object.nyu40 == kNyuOtherStructure && namesBackdrop(object.name);
}

Eigen::AlignedBox3d worldBounds(const OrientedBox& box) {
    Eigen::AlignedBox3d bounds;
    for (const Eigen::Vector3d& corner : box.corners()) bounds.extend(corner);
    return bounds;
}

Eigen::AlignedBox3d findRoomBounds(const std::vector<Object>& objects) {
    if (objects.empty()) return {};
    std::vector<Item> items;
    for (std::size_t i = 0; i < objects.size(); ++i) {
        items.push_back({i, worldBounds(objects[i].box)});
    }
    const SortedItems sorted = sortItems(objects, std::move(items));
    return groupsOf(sorted.items, sorted.surrounding_count).front().bounds;
}

Eigen::AlignedBox3d findRoomBounds(const Scene& scene, std::vector<std::string>& left_out) {
    if (scene.objects.empty()) return {};
    std::vector<Item> items;
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        items.push_back({i, boundsOfObject(scene, scene.objects[i])});
    }
    const SortedItems sorted = sortItems(scene.objects, std::move(items));
    const std::vector<Group> groups = groupsOf(sorted.items, sorted.surrounding_count);
    std::vector<bool> counts(scene.objects.size(), false);
    Eigen::AlignedBox3d bounds;
    for (const Group& group : groups) {
        if (!bounds.isEmpty() && !enclosesRoom(scene, group)) continue;
        bounds.extend(group.bounds);
        for (const std::size_t object : group.objects) counts[object] = true;
    }
    for (const Item& item : sorted.items) {
        if (!counts[item.object]) left_out.push_back(scene.objects[item.object].name);
    }
    return bounds;
}

}  // namespace dollytrack
