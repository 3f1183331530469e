#include "engine/generate/furnisher.h"

#include <algorithm>
#include <limits>

namespace dollytrack::generate {
namespace {

constexpr int kChoices = 3;
constexpr int kFurnishingTries = 8;

/// How many equal pieces of a role a room may contain; unlimited for furniture, which often
/// comes in pairs and rows.
int mostAlike(FurnitureRole role, int most_small) {
    using enum FurnitureRole;
    switch (role) {
        case FloorLamp:
        case FloorPlant:
        case WallItem:
        case FloorItem:
        case WorkFloorItem:
            return 1;
        case TableLamp:
        case DeskItem:
        case LivingRoomItem:
        case KitchenItem:
        case BedroomItem:
        case ShelfItem:
            return most_small;
        default:
            return std::numeric_limits<int>::max();
    }
}

/// Whether two pieces count as equal: decorations by name, because libraries contain several
/// models of clocks, bins and the like; other pieces only if they are the same.
bool areAlike(const CatalogPiece& a, const CatalogPiece& b, FurnitureRole role) {
    using enum FurnitureRole;
    const bool by_name = role == WallItem || role == FloorItem || role == WorkFloorItem;
    return &a == &b || (by_name && a.name == b.name);
}

}  // namespace

const CatalogPiece* Furnisher::pick(FurnitureRole role) const {
    const auto& pieces = pool.piecesOf(role);
    if (pieces.empty()) return nullptr;
    const auto timesUsed = [&](const CatalogPiece* piece) {
        return static_cast<int>(std::count_if(
            layout.pieces().begin(), layout.pieces().end(),
            [&](const auto& placed) { return areAlike(*placed.piece, *piece, role); }));
    };
    const int most = mostAlike(role, most_alike);
    // isUsable() reads the model, so it is called for chosen pieces only; a library is large.
    for (int attempt = 0; attempt < kFurnishingTries; ++attempt) {
        const CatalogPiece* best = nullptr;
        for (int i = 0; i < kChoices; ++i) {
            const auto* piece = pieces[random.below(static_cast<std::uint32_t>(pieces.size()))];
            if (!best || timesUsed(piece) < timesUsed(best)) best = piece;
        }
        if (timesUsed(best) < most && pool.isUsable(*best, job)) return best;
    }
    const auto usable = std::find_if(pieces.begin(), pieces.end(), [&](const auto* piece) {
        return timesUsed(piece) < most && pool.isUsable(*piece, job);
    });
    return usable == pieces.end() ? nullptr : *usable;
}

}  // namespace dollytrack::generate
