#include "engine/generate/furnisher.h"

#include <algorithm>

namespace dollytrack::generate {
namespace {

using enum FurnitureRole;

constexpr double kBehind = 1.0;        // cm between furniture and its wall
constexpr double kBetweenUnits = 0.6;  // cm; more than the layout's smallest gap
constexpr double kUpperUnits = 148.0;  // cm: elevation of cupboards
constexpr int kMostUnits = 14;

/// Adds a cupboard above a unit, at most 1 cm wider than it.
void addUpperUnit(Furnisher& f, const CatalogPiece& below, const WallPlace& place) {
    const CatalogPiece* upper = f.pick(KitchenUpper);
    if (!upper || upper->width > below.width + 1.0) return;
    PlacedPiece above = f.layout.atWall(*upper, KitchenUpper, place, 0.3);
    above.support = PlacedPiece::Support::Wall;
    above.elevation = kUpperUnits;
    f.layout.add(above);
}

/// Adds units side by side along a wall, from the position `from`.
void addUnits(Furnisher& f, int wall, double from) {
    const double room = f.layout.wallLength(wall);
    double at = from;
    for (int i = 0; i < kMostUnits && at < room - 30.0; ++i) {
        const bool tall = f.random.below(9) == 0;
        const FurnitureRole role = tall ? KitchenTall : KitchenBase;
        const CatalogPiece* piece = f.pick(role);
        if (!piece) return;
        const WallPlace place{wall, at + 0.5 * piece->width};
        if (!f.layout.add(f.layout.atWall(*piece, role, place, kBehind))) {
            at += 10.0;
            continue;
        }
        if (!tall) addUpperUnit(f, *piece, place);
        at += piece->width + kBetweenUnits;
    }
}

}  // namespace

std::optional<std::size_t> addAtWall(Furnisher& f, FurnitureRole role, int tries) {
    for (int i = 0; i < tries; ++i) {
        const CatalogPiece* piece = f.pick(role);
        if (!piece) return std::nullopt;
        const int wall = f.anyWall();
        const double room = f.layout.wallLength(wall) - piece->width;
        if (room < 4.0) continue;
        double along = 0.5 * piece->width + f.random.uniform(2.0, room - 2.0);
        // One piece in three stands in a corner.
        if (f.random.below(3) == 0) along = 0.5 * piece->width + 2.0;
        if (f.layout.add(f.layout.atWall(*piece, role, {wall, along}, kBehind))) {
            return f.layout.pieces().size() - 1;
        }
    }
    return std::nullopt;
}

void addKitchen(Furnisher& f) {
    const int wall = f.anyWall();
    const double corner = 75.0;  // cm kept free for the first wall's units
    addUnits(f, wall, 2.0);
    addUnits(f, (wall + 1) % 4, corner);
    const auto& pieces = f.layout.pieces();
    const bool any_tall = std::any_of(pieces.begin(), pieces.end(),
                                      [](const auto& p) { return p.role == KitchenTall; });
    if (!any_tall) addAtWall(f, KitchenTall, 40);
}

}  // namespace dollytrack::generate
