#include "engine/generate/furnisher.h"

#include <cmath>
#include <numbers>

namespace dollytrack::generate {
namespace {

constexpr int kPlacementTries = 12;
constexpr double kEyeHeight = 155.0;  // cm: height of the centres of objects on walls
constexpr double kSwitchSize = 20.0;
constexpr double kLampHeadroom_cm = 165.0;  // free height under a lamp
constexpr double kFixed = 0.3;              // gap between an object and its wall or ceiling

/// Elevation of an object on a wall: the library's for switches and for objects that hang high;
/// other objects are centred at eye height.
double hangingHeight(const CatalogPiece& piece, double room_height) {
    const bool own = piece.width < kSwitchSize || piece.elevation > 180.0;
    if (own) return std::min(piece.elevation, room_height - piece.height - 5.0);
    return kEyeHeight - 0.5 * piece.height;
}

}  // namespace

void addCeilingLamp(Furnisher& f, const Eigen::Vector2d& at) {
    for (int i = 0; i < kPlacementTries; ++i) {
        const CatalogPiece* piece = f.pick(FurnitureRole::CeilingLamp);
        if (!piece) return;
        PlacedPiece placed;
        placed.piece = piece;
        placed.role = FurnitureRole::CeilingLamp;
        placed.at = at;
        placed.support = PlacedPiece::Support::Ceiling;
        placed.elevation = f.layout.height() - piece->height - kFixed;
        if (placed.elevation > kLampHeadroom_cm && f.layout.add(placed)) return;
    }
}

void addWallItem(Furnisher& f) {
    for (int i = 0; i < kPlacementTries; ++i) {
        const CatalogPiece* piece = f.pick(FurnitureRole::WallItem);
        if (!piece) return;
        const int wall = f.anyWall();
        const double room = f.layout.wallLength(wall) - piece->width;
        if (room < 20.0) continue;
        const double along = 0.5 * piece->width + f.random.uniform(10.0, room - 10.0);
        PlacedPiece placed =
            f.layout.atWall(*piece, FurnitureRole::WallItem, {wall, along}, kFixed);
        placed.support = PlacedPiece::Support::Wall;
        placed.elevation = hangingHeight(*piece, f.layout.height());
        if (f.layout.add(placed)) return;
    }
}

void addFloorItem(Furnisher& f, FurnitureRole role) {
    for (int i = 0; i < kPlacementTries; ++i) {
        const CatalogPiece* piece = f.pick(role);
        if (!piece) return;
        // Near a wall (within half a metre) and with its back to it, not in the middle of the room.
        const int wall = f.anyWall();
        const double along = f.random.uniform(0.0, f.layout.wallLength(wall));
        const double slack = 0.5 * (std::hypot(piece->width, piece->depth) - piece->depth);
        PlacedPiece placed =
            f.layout.atWall(*piece, role, {wall, along}, slack + f.random.uniform(1.0, 20.0));
        placed.angle += f.random.uniform(-0.6, 0.6);
        if (f.layout.add(placed)) return;
    }
}

}  // namespace dollytrack::generate
