#pragma once

#include "engine/scene/scene.h"
#include "render/view/view.h"

#include <Eigen/Geometry>

#include <span>
#include <vector>

namespace dollytrack::render {

/// Objects that hide rooms from a viewer above, by object id: ceilings, and structure more than 1.5
/// times as wide as the building (grounds, streets, skies).
[[nodiscard]] std::vector<bool> hidesRooms(const Scene& scene);

/// Box around the rooms and their walls (0.25 m). Balconies, panels behind windows and the like are
/// excluded. Without rooms: the scene's room bounds.
[[nodiscard]] Eigen::AlignedBox3d buildingOf(const Scene& scene,
                                             std::span<const Eigen::AlignedBox3d> rooms);

/// Height of the lowest room's floor, m; anything below belongs to the ground, a slab or a cellar.
/// A room's box begins just above its floor. Rooms with less than a fifth of the widest room's
/// floor area are ignored. Without rooms: the lowest large horizontal surface of structure.
[[nodiscard]] double floorOf(const Scene& scene, std::span<const Eigen::AlignedBox3d> rooms);

/// Height of the topmost storey's ceiling, m: the lowest ceiling among its rooms. Needed because
/// many files have walls and ceiling in one object, which cannot be hidden separately.
[[nodiscard]] double ceilingOf(const Scene& scene, std::span<const Eigen::AlignedBox3d> rooms);

/// A storey opened from above. Heights in the world frame, m.
struct StoreyView {
    double floor_z = 0.0;        // its floor
    double ceiling_z = 0.0;      // structure above is cut
    double hidden_from_z = 0.0;  // objects that begin at this height or above are hidden
};

/// The storeys of a building, lowest first; at least one. Without rooms, floors are found by object
/// labels only.
[[nodiscard]] std::vector<StoreyView> storeysOf(const Scene& scene,
                                                std::span<const Eigen::AlignedBox3d> rooms);

/// Objects hidden for a view into a storey, by object id: hidesRooms() and everything above the
/// storey.
[[nodiscard]] std::vector<bool> hiddenFor(const Scene& scene, const StoreyView& storey);

/// The building's box, clipped to one storey.
[[nodiscard]] Eigen::AlignedBox3d withinStorey(const Eigen::AlignedBox3d& building,
                                               const StoreyView& storey);

/// Cuts walls along a plane that falls from the top of the far walls to the foot of those near the
/// viewer. Floor and skirting up to 0.12 m above `floor_z` stay; structure above `ceiling_z` is
/// cut.
/// @param aside  horizontal direction towards the viewer, length at most 1; a shorter vector means
///     a steeper view from above and a flatter cut
[[nodiscard]] StructureCut cutTowards(const Eigen::AlignedBox3d& building, double floor_z,
                                      double ceiling_z, const Eigen::Vector3d& aside);

/// Whether the view leaves out an object's surface at a world position, because the object is
/// hidden or this part of it is cut.
[[nodiscard]] bool isCutAway(const View& view, const Scene& scene, int object_id,
                             const Eigen::Vector3d& at);

}  // namespace dollytrack::render
