#include "engine/generate/furnisher.h"

#include <algorithm>

namespace dollytrack::generate {
namespace {

constexpr double kDoorClear = 90.0;    // cm of free floor before a door
constexpr double kWindowClear = 15.0;  // cm before a window, free at the window's height
constexpr double kSill = 95.0;
constexpr double kFromCorner = 15.0;

/// The box before an opening that must stay free.
UprightBox before(const PlacedPiece& at_wall, double depth, double low, double high) {
    UprightBox clear;
    clear.angle = at_wall.angle;
    clear.half = {0.5 * at_wall.piece->width, 0.5 * depth};
    clear.centre = at_wall.at + 0.5 * (depth - at_wall.piece->depth) * forwardAt(at_wall.angle);
    clear.low = low;
    clear.high = high;
    return clear;
}

/// Moves an opening to the middle of the wall's thickness; the wall lies outside the room.
PlacedPiece inWall(PlacedPiece at_wall, double elevation) {
    at_wall.at -= 0.5 * (at_wall.piece->depth + kWallThickness) * forwardAt(at_wall.angle);
    at_wall.elevation = elevation;
    at_wall.support = PlacedPiece::Support::Opening;
    return at_wall;
}

void addDoor(Furnisher& f, int wall) {
    const CatalogPiece* door = f.pick(FurnitureRole::Door);
    if (!door) return;
    double along = 0.5 * door->width + kFromCorner;
    if (f.tossCoin()) along = f.layout.wallLength(wall) - along;
    const PlacedPiece placed = f.layout.atWall(*door, FurnitureRole::Door, {wall, along}, 0.0);
    const UprightBox clear = before(placed, kDoorClear, 0.0, door->height);
    f.layout.addOpening(inWall(placed, 0.0), clear);
    f.layout.reach(clear.centre);
}

void addWindows(Furnisher& f, int wall) {
    const CatalogPiece* window = f.pick(FurnitureRole::Window);
    if (!window) return;
    const double room = f.layout.wallLength(wall);
    const int count = room > 600.0 ? 2 : 1;
    const double sill = std::min(kSill, f.layout.height() - window->height - 25.0);
    if (sill < 30.0 || window->width > 0.8 * room / count) return;
    for (int i = 0; i < count; ++i) {
        const double along = room * (i + 1) / (count + 1);
        const PlacedPiece placed =
            f.layout.atWall(*window, FurnitureRole::Window, {wall, along}, 0.0);
        f.layout.addOpening(inWall(placed, sill),
                            before(placed, kWindowClear, sill, sill + window->height));
    }
}

}  // namespace

void addDoorAndWindows(Furnisher& furnisher) {
    const int door_wall = furnisher.anyWall();
    addDoor(furnisher, door_wall);
    for (int turn = 1; turn < 4; ++turn) {
        const bool opposite = turn == 2;
        if (opposite || furnisher.tossCoin()) addWindows(furnisher, (door_wall + turn) % 4);
    }
}

}  // namespace dollytrack::generate
