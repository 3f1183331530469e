#include "engine/generate/surface_stacker.h"

#include "engine/generate/support_surface.h"

#include <algorithm>
#include <map>
#include <vector>

namespace dollytrack::generate {
namespace {

using Eigen::Vector2d;
using enum FurnitureRole;

constexpr int kTriesPerItem = 40;
constexpr double kRim = 0.5;    // cm to the edge of the supporting piece
constexpr double kTurn = 0.35;  // radians: largest random rotation of an object

bool supportsItems(FurnitureRole role) {
    switch (role) {
        case NightStand:
        case Wardrobe:
        case Dresser:
        case CoffeeTable:
        case TvStand:
        case Bookcase:
        case Cabinet:
        case Desk:
        case DiningTable:
        case KitchenBase:
        case KitchenTall:
        case KitchenUpper:
            return true;
        default:
            return false;
    }
}

FurnitureRole itemRoleFor(FurnitureRole supporter, bool kitchen, bool desk, Random& random) {
    switch (supporter) {
        case NightStand:
            return random.below(3) == 0 ? TableLamp : BedroomItem;
        case Dresser:
        case Wardrobe:
            return random.below(5) == 0 ? TableLamp : BedroomItem;
        case Desk:
            return random.below(8) == 0 ? TableLamp : DeskItem;
        case KitchenBase:
        case KitchenTall:
        case KitchenUpper:
            return KitchenItem;
        case DiningTable:
            return random.below(4) == 0 && !kitchen ? LivingRoomItem : KitchenItem;
        case CoffeeTable:
        case TvStand:
            return LivingRoomItem;
        default:
            if (random.below(3) > 0) return ShelfItem;
            return desk ? DeskItem : LivingRoomItem;
    }
}

class Stacker {
  public:
    explicit Stacker(Furnisher& furnisher) : f_(furnisher) {
        for (std::size_t i = 0; i < f_.layout.pieces().size(); ++i) {
            const PlacedPiece& piece = f_.layout.pieces()[i];
            if (piece.role == KitchenBase) kitchen_ = true;
            if (piece.role == Desk) desk_ = true;
            if (supportsItems(piece.role)) supporters_.push_back(static_cast<int>(i));
        }
    }

    void putTelevisions() {
        for (const int supporter : supporters_) {
            if (at(supporter).role != TvStand) continue;
            for (int i = 0; i < 6; ++i) {
                const CatalogPiece* piece = f_.pick(Television);
                if (!piece) return;
                if (put(*piece, Television, supporter, Vector2d::Zero(), 0.0)) break;
            }
        }
    }

    void stackUpTo(int objects) {
        if (supporters_.empty()) return;
        const int tries = kTriesPerItem * (objects - f_.layout.furnished());
        for (int i = 0; i < tries && !f_.job.cancelled(); ++i) {
            if (f_.layout.furnished() >= objects) return;
            putSomewhere(
                supporters_[f_.random.below(static_cast<std::uint32_t>(supporters_.size()))]);
        }
    }

  private:
    [[nodiscard]] const PlacedPiece& at(int index) const { return f_.layout.pieces()[index]; }

    const SupportSurface* surfaceOf(int supporter) {
        auto found = surfaces_.find(supporter);
        if (found == surfaces_.end()) {
            const auto* model = f_.pool.modelOf(*at(supporter).piece, f_.job);
            if (!model) return nullptr;
            found = surfaces_.emplace(supporter, SupportSurface(*model, at(supporter))).first;
        }
        return &found->second;
    }

    void putSomewhere(int supporter) {
        const PlacedPiece on = at(supporter);
        const FurnitureRole role = itemRoleFor(on.role, kitchen_, desk_, f_.random);
        const CatalogPiece* piece = f_.pick(role);
        if (!piece) return;
        const double slack_x = 0.5 * (on.piece->width - piece->width) - kRim;
        const double slack_y = 0.5 * (on.piece->depth - piece->depth) - kRim;
        if (slack_x < 0.0 || slack_y < 0.0) return;
        const double x = f_.random.uniform(-slack_x, slack_x);
        const double y = f_.random.uniform(-slack_y, slack_y);
        put(*piece, role, supporter, {x, y}, f_.random.uniform(-kTurn, kTurn));
    }

    /// Places an object at `offset` (along the axes of the supporting piece), if it fits.
    bool put(const CatalogPiece& piece, FurnitureRole role, int supporter, const Vector2d& offset,
             double turn) {
        const SupportSurface* surface = surfaceOf(supporter);
        if (!surface) return false;
        const PlacedPiece on = at(supporter);
        PlacedPiece item;
        item.piece = &piece;
        item.role = role;
        item.support = PlacedPiece::Support::Piece;
        item.supporter = supporter;
        item.angle = on.angle + turn;
        item.at = on.at + offset.x() * acrossAt(on.angle) + offset.y() * forwardAt(on.angle);
        const auto placement = surface->placementFor(item, f_.random);
        if (!placement) return false;
        item.elevation = placement->height;
        if (isInTheWay(item.box()) || (placement->access && isTaken(*placement->access, supporter)))
            return false;
        if (!f_.layout.add(item)) return false;
        if (placement->access) access_boxes_.push_back(*placement->access);
        return true;
    }

    /// Whether a box would block the free access to an object in a shelf, and so hide it.
    [[nodiscard]] bool isInTheWay(const UprightBox& box) const {
        return std::any_of(access_boxes_.begin(), access_boxes_.end(),
                           [&](const UprightBox& access) { return near(box, access, 0.0); });
    }

    [[nodiscard]] bool isTaken(const UprightBox& access, int supporter) const {
        const auto& pieces = f_.layout.pieces();
        return std::any_of(pieces.begin(), pieces.end(), [&](const PlacedPiece& piece) {
            return piece.supporter == supporter && near(piece.box(), access, 0.0);
        });
    }

    Furnisher& f_;
    std::vector<int> supporters_;
    std::map<int, SupportSurface> surfaces_;
    std::vector<UprightBox> access_boxes_;  // free access to the objects in shelves
    bool kitchen_ = false;
    bool desk_ = false;
};

}  // namespace

void stackItems(int objects, Furnisher& furnisher) {
    Stacker stacker(furnisher);
    stacker.putTelevisions();
    stacker.stackUpTo(objects);
    // If that is not enough, a third equal object is allowed.
    furnisher.most_alike = 3;
    stacker.stackUpTo(objects);
}

}  // namespace dollytrack::generate
