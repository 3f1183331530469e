#pragma once

#include "engine/scene/scene.h"
#include "render/draw/view.h"

#include <Eigen/Geometry>

#include <span>
#include <vector>

namespace dollytrack::render {

/// What hides a room from a viewer above it, by object id: ceilings, and structure much larger
/// than the building (grounds, streets, skies).
[[nodiscard]] std::vector<bool> hidesRooms(const Scene& scene);

/// The rooms with the walls around them; balconies, panels behind windows and the like stay out.
[[nodiscard]] Eigen::AlignedBox3d buildingOf(const Scene& scene,
                                             std::span<const Eigen::AlignedBox3d> rooms);

/// Where the rooms' floors begin, m: what is below that the ground, a slab or a cellar has. A
/// room's box begins just above its floor. Hollows below the floor do not count; without rooms it
/// is the lowest large level surface of structure.
[[nodiscard]] double floorOf(const Scene& scene, std::span<const Eigen::AlignedBox3d> rooms);

/// Where the ceilings of the topmost storey begin, m: many files have walls and ceiling in one
/// piece, so that neither can be told by its object. Where rooms differ, the lower ones count.
[[nodiscard]] double ceilingOf(const Scene& scene, std::span<const Eigen::AlignedBox3d> rooms);

/// A storey as one looks into it from above. Heights in the world, m.
struct StoreyView {
    double floor_z = 0.0;         // where it begins
    double ceiling_z = 0.0;       // structure above is cut
    double left_away_from = 0.0;  // things that begin at this height or above stand over it
};

/// The storeys of a building, lowest first; at least one. Without rooms, only the objects' labels
/// tell which surfaces are floors.
[[nodiscard]] std::vector<StoreyView> storeysOf(const Scene& scene,
                                                std::span<const Eigen::AlignedBox3d> rooms);

/// hidesRooms() and the objects over a storey.
[[nodiscard]] std::vector<bool> hiddenFor(const Scene& scene, const StoreyView& storey);

/// The building, of the height of one storey.
[[nodiscard]] Eigen::AlignedBox3d withinStorey(const Eigen::AlignedBox3d& building,
                                               const StoreyView& storey);

/// Cuts walls along a plane that falls from the top of the far ones to the foot of those near the
/// viewer, who stands in the horizontal direction `aside` (at most unit: shorter looks from more
/// above and cuts less steeply). Floors and skirting stay; what lies above `ceiling_z` goes.
[[nodiscard]] StructureCut cutTowards(const Eigen::AlignedBox3d& building, double floor_z,
                                      double ceiling_z, const Eigen::Vector3d& aside);

/// Whether a picture leaves a surface of an object away at a place in the world: the object is
/// hidden, or this part of it cut.
[[nodiscard]] bool isLeftAway(const View& view, const Scene& scene, int object_id,
                              const Eigen::Vector3d& at);

}  // namespace dollytrack::render
