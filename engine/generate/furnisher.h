#pragma once

#include "engine/core/random.h"
#include "engine/generate/furniture/furniture_pool.h"
#include "engine/generate/room_layout.h"
#include "engine/jobs/job.h"

#include <cstddef>
#include <optional>

namespace dollytrack::generate {

/// The data that all furnishing functions use.
struct Furnisher {
    FurniturePool& pool;
    Random& random;
    const JobContext& job;
    RoomLayout& layout;
    int most_alike = 2;  // largest number of equal small objects in the room

    /// Picks a piece of furniture for a role: out of a few random pieces, the one that occurs
    /// least often in the room. Null if none is usable or all have reached their largest number:
    /// one for decorations, `most_alike` for small objects, unlimited for furniture.
    const CatalogPiece* pick(FurnitureRole role) const;
    [[nodiscard]] bool tossCoin() const { return random.below(2) == 0; }
    int anyWall() const { return static_cast<int>(random.below(4)); }
};

/// Adds a door near a corner, keeps the floor before it free, and adds windows to other walls.
void addDoorAndWindows(Furnisher& furnisher);

/// Adds a piece of the role with its back to a random wall. Returns its index; null if it fits
/// nowhere in `tries` attempts.
std::optional<std::size_t> addAtWall(Furnisher& furnisher, FurnitureRole role, int tries = 25);

/// Adds kitchen units along two walls, cupboards above them, and at least one tall unit.
void addKitchen(Furnisher& furnisher);

/// Each adds a group of furniture; pieces that do not fit are left out.
void addBedGroup(Furnisher& furnisher);     // bed, night stands
void addSofaGroup(Furnisher& furnisher);    // sofa, low table, armchairs, TV stand opposite
void addDeskGroup(Furnisher& furnisher);    // desk, chair
void addDiningGroup(Furnisher& furnisher);  // table, chairs on all sides, lamp above

/// Each adds a decoration: at the ceiling, on a random wall, or on the floor near a wall.
void addCeilingLamp(Furnisher& furnisher, const Eigen::Vector2d& at);
void addWallItem(Furnisher& furnisher);
void addFloorItem(Furnisher& furnisher, FurnitureRole role);

}  // namespace dollytrack::generate
