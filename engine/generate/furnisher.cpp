#include "engine/generate/furnisher.h"

#include <algorithm>

namespace dollytrack::generate {
namespace {

constexpr int kChoices = 3;
constexpr int kTries = 8;

}  // namespace

const CatalogPiece* Furnisher::pick(FurnitureRole role) const {
    const auto& pieces = pool.piecesOf(role);
    if (pieces.empty()) return nullptr;
    const auto timesUsed = [&](const CatalogPiece* piece) {
        return std::count_if(layout.pieces().begin(), layout.pieces().end(),
                             [&](const auto& placed) { return placed.piece == piece; });
    };
    // Only what is chosen is read: a library is large.
    for (int attempt = 0; attempt < kTries; ++attempt) {
        const CatalogPiece* best = nullptr;
        for (int i = 0; i < kChoices; ++i) {
            const auto* piece = pieces[random.below(static_cast<std::uint32_t>(pieces.size()))];
            if (!best || timesUsed(piece) < timesUsed(best)) best = piece;
        }
        if (pool.isUsable(*best, job)) return best;
    }
    const auto usable = std::find_if(pieces.begin(), pieces.end(),
                                     [&](const auto* piece) { return pool.isUsable(*piece, job); });
    return usable == pieces.end() ? nullptr : *usable;
}

}  // namespace dollytrack::generate
