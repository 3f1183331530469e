#pragma once

#include "engine/core/random.h"
#include "engine/generate/furniture_pool.h"
#include "engine/generate/room_layout.h"
#include "engine/jobs/job.h"

#include <cstddef>
#include <optional>

namespace dollytrack::generate {

/// What all that furnishes a room works with.
struct Furnisher {
    FurniturePool& pool;
    Random& random;
    const JobContext& job;
    RoomLayout& layout;
    int most_alike = 2;  // so often may the same small thing be there

    /// Picks a piece of furniture for this role: of a few random ones the one that the room has
    /// fewest of. Null if none is usable, or if the room has enough of each: one of a decoration,
    /// `most_alike` of small objects.
    const CatalogPiece* pick(FurnitureRole role) const;
    [[nodiscard]] bool tossCoin() const { return random.below(2) == 0; }
    int anyWall() const { return static_cast<int>(random.below(4)); }
};

/// A door near a corner, with the floor before it kept clear, and windows in other walls.
void addDoorAndWindows(Furnisher& furnisher);

/// One piece of the role with its back to some wall; its index.
std::optional<std::size_t> addAtWall(Furnisher& furnisher, FurnitureRole role, int tries = 25);

/// Kitchen units side by side along two walls, with cupboards above, and something tall.
void addKitchen(Furnisher& furnisher);

/// Furniture that belongs together.
void addBedGroup(Furnisher& furnisher);     // with night stands
void addSofaGroup(Furnisher& furnisher);    // low table, armchairs, opposite a television's stand
void addDeskGroup(Furnisher& furnisher);    // with a chair
void addDiningGroup(Furnisher& furnisher);  // chairs all around, a lamp above

/// Things on walls, on the floor and at the ceiling.
void addCeilingLamp(Furnisher& furnisher, const Eigen::Vector2d& at);
void addWallThing(Furnisher& furnisher);
void addFloorThing(Furnisher& furnisher, FurnitureRole role);

}  // namespace dollytrack::generate
