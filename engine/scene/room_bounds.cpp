#include "engine/scene/room_bounds.h"

#include "engine/core/disjoint_sets.h"

#include <algorithm>

namespace dollytrack {
namespace {

constexpr double kNearby = 4.0;       // m: largest gap between objects of one building
constexpr double kTooWide = 2.0;      // times the rest's extent: a ground or sky
constexpr double kTooWideFlat = 1.6;  // the same for a flat object: a ground plane

struct Item {
    std::size_t object;
    Eigen::AlignedBox3d box;
};

/// The box around the largest group of objects; a group is a chain of nearby boxes.
Eigen::AlignedBox3d largestGroup(const std::vector<Item>& items, std::size_t first,
                                 std::vector<bool>* in_group = nullptr) {
    DisjointSets groups(items.size());
    for (std::size_t i = first; i < items.size(); ++i) {
        for (std::size_t j = i + 1; j < items.size(); ++j) {
            if (items[i].box.exteriorDistance(items[j].box) > kNearby) continue;
            groups.joinTo(i, j);
        }
    }
    std::vector<Eigen::AlignedBox3d> boxes(items.size());
    std::vector<std::size_t> sizes(items.size(), 0);
    for (std::size_t i = first; i < items.size(); ++i) {
        boxes[groups.find(i)].extend(items[i].box);
        ++sizes[groups.find(i)];
    }
    std::size_t best = first;
    for (std::size_t i = first; i < items.size(); ++i) {
        const auto rank = [&](std::size_t k) {
            return std::pair(sizes[k], sizes[k] ? boxes[k].diagonal().norm() : 0.0);
        };
        if (rank(i) > rank(best)) best = i;
    }
    if (in_group) {
        in_group->assign(items.size(), false);
        for (std::size_t i = first; i < items.size(); ++i) (*in_group)[i] = groups.find(i) == best;
    }
    return boxes[best];
}

}  // namespace

Eigen::AlignedBox3d worldBounds(const OrientedBox& box) {
    Eigen::AlignedBox3d bounds;
    for (const Eigen::Vector3d& corner : box.corners()) bounds.extend(corner);
    return bounds;
}

Eigen::AlignedBox3d findRoomBounds(const std::vector<Object>& objects,
                                   std::vector<std::string>* left_out) {
    std::vector<Item> items;
    for (std::size_t i = 0; i < objects.size(); ++i) {
        items.push_back({i, worldBounds(objects[i].box)});
    }
    if (items.empty()) return {};
    const auto planSize = [](const Item& item) {
        return std::max(item.box.sizes().x(), item.box.sizes().y());
    };
    std::stable_sort(items.begin(), items.end(),
                     [&](const Item& a, const Item& b) { return planSize(a) > planSize(b); });
    const auto restAfter = [&](std::size_t k) {
        const Eigen::AlignedBox3d rest = largestGroup(items, k + 1);
        return std::max(rest.sizes().x(), rest.sizes().y());
    };
    // A sky may contain a ground that contains the house: removes each object that is huge compared
    // with all smaller ones, and all larger objects.
    std::size_t first = 0;
    constexpr std::size_t kMostHuge = 8;
    for (std::size_t k = 0; k + 1 < items.size() && k < kMostHuge; ++k) {
        if (planSize(items[k]) < 60.0) break;
        const double wide = restAfter(k);
        if (wide > 0.0 && planSize(items[k]) > 3.0 * wide) first = k + 1;
    }
    // Then removes objects, the widest first, that are much wider than all the rest: they are
    // around the building.
    for (; first + 1 < items.size(); ++first) {
        // Few objects on a large floor are a sparse room, not a house on a plain.
        if (items.size() - first - 1 < 3) break;
        const double wide = restAfter(first);
        const bool flat = items[first].box.sizes().z() < 0.05 * planSize(items[first]);
        const double limit = flat ? kTooWideFlat : kTooWide;
        if (wide < 4.0 || planSize(items[first]) <= limit * wide) break;
    }
    std::vector<bool> in_group;
    const Eigen::AlignedBox3d bounds = largestGroup(items, first, &in_group);
    if (left_out) {
        for (std::size_t i = 0; i < items.size(); ++i) {
            if (i >= first && in_group[i]) continue;
            left_out->push_back(objects[items[i].object].name);
        }
    }
    return bounds;
}

}  // namespace dollytrack
