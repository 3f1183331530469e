#include "engine/generate/surface_stacker.h"

#include "engine/generate/carrier_surface.h"

#include <algorithm>
#include <map>
#include <vector>

namespace dollytrack::generate {
namespace {

using Eigen::Vector2d;
using enum FurnitureRole;

constexpr int kTriesPerThing = 40;
constexpr double kRim = 0.5;    // cm to the edge of the supporting piece
constexpr double kTurn = 0.35;  // radians: largest random rotation of an object

bool carries(FurnitureRole role) {
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

FurnitureRole thingsFor(FurnitureRole carrier, bool kitchen, bool desk, Random& random) {
    switch (carrier) {
        case NightStand:
            return random.below(3) == 0 ? TableLamp : BedroomThing;
        case Dresser:
        case Wardrobe:
            return random.below(5) == 0 ? TableLamp : BedroomThing;
        case Desk:
            return random.below(8) == 0 ? TableLamp : DeskThing;
        case KitchenBase:
        case KitchenTall:
        case KitchenUpper:
            return KitchenThing;
        case DiningTable:
            return random.below(4) == 0 && !kitchen ? LivingThing : KitchenThing;
        case CoffeeTable:
        case TvStand:
            return LivingThing;
        default:
            if (random.below(3) > 0) return ShelfThing;
            return desk ? DeskThing : LivingThing;
    }
}

class Stacker {
  public:
    explicit Stacker(Furnisher& furnisher) : f_(furnisher) {
        for (std::size_t i = 0; i < f_.layout.pieces().size(); ++i) {
            const PlacedPiece& piece = f_.layout.pieces()[i];
            if (piece.role == KitchenBase) kitchen_ = true;
            if (piece.role == Desk) desk_ = true;
            if (carries(piece.role)) carriers_.push_back(static_cast<int>(i));
        }
    }

    void putTelevisions() {
        for (const int carrier : carriers_) {
            if (at(carrier).role != TvStand) continue;
            for (int i = 0; i < 6; ++i) {
                const CatalogPiece* piece = f_.pick(Television);
                if (!piece) return;
                if (put(*piece, Television, carrier, Vector2d::Zero(), 0.0)) break;
            }
        }
    }

    void stackUpTo(int objects) {
        if (carriers_.empty()) return;
        const int tries = kTriesPerThing * (objects - f_.layout.furnished());
        for (int i = 0; i < tries && !f_.job.cancelled(); ++i) {
            if (f_.layout.furnished() >= objects) return;
            putSomewhere(carriers_[f_.random.below(static_cast<std::uint32_t>(carriers_.size()))]);
        }
    }

  private:
    [[nodiscard]] const PlacedPiece& at(int index) const {
        return f_.layout.pieces()[static_cast<std::size_t>(index)];
    }

    const CarrierSurface* surfaceOf(int carrier) {
        auto found = surfaces_.find(carrier);
        if (found == surfaces_.end()) {
            const auto* model = f_.pool.modelOf(*at(carrier).piece, f_.job);
            if (!model) return nullptr;
            found = surfaces_.emplace(carrier, CarrierSurface(*model, at(carrier))).first;
        }
        return &found->second;
    }

    void putSomewhere(int carrier) {
        const PlacedPiece on = at(carrier);
        const FurnitureRole role = thingsFor(on.role, kitchen_, desk_, f_.random);
        const CatalogPiece* piece = f_.pick(role);
        if (!piece) return;
        const double slack_x = 0.5 * (on.piece->width - piece->width) - kRim;
        const double slack_y = 0.5 * (on.piece->depth - piece->depth) - kRim;
        if (slack_x < 0.0 || slack_y < 0.0) return;
        const double x = f_.random.uniform(-slack_x, slack_x);
        const double y = f_.random.uniform(-slack_y, slack_y);
        put(*piece, role, carrier, {x, y}, f_.random.uniform(-kTurn, kTurn));
    }

    /// Places an object at `offset` (along the axes of the supporting piece), if it fits.
    bool put(const CatalogPiece& piece, FurnitureRole role, int carrier, const Vector2d& offset,
             double turn) {
        const CarrierSurface* surface = surfaceOf(carrier);
        if (!surface) return false;
        const PlacedPiece on = at(carrier);
        PlacedPiece thing;
        thing.piece = &piece;
        thing.role = role;
        thing.hold = PlacedPiece::Hold::Piece;
        thing.supporter = carrier;
        thing.angle = on.angle + turn;
        thing.at = on.at + offset.x() * acrossAt(on.angle) + offset.y() * forwardAt(on.angle);
        const auto rest = surface->restFor(thing, f_.random);
        if (!rest) return false;
        thing.elevation = rest->height;
        if (isInTheWay(thing.box()) || (rest->way && isTaken(*rest->way, carrier))) return false;
        if (!f_.layout.add(thing)) return false;
        if (rest->way) ways_.push_back(*rest->way);
        return true;
    }

    /// Whether a box would block the free access to an object in a shelf, and so hide it.
    [[nodiscard]] bool isInTheWay(const UprightBox& box) const {
        return std::any_of(ways_.begin(), ways_.end(),
                           [&](const UprightBox& way) { return near(box, way, 0.0); });
    }

    [[nodiscard]] bool isTaken(const UprightBox& way, int carrier) const {
        const auto& pieces = f_.layout.pieces();
        return std::any_of(pieces.begin(), pieces.end(), [&](const PlacedPiece& piece) {
            return piece.supporter == carrier && near(piece.box(), way, 0.0);
        });
    }

    Furnisher& f_;
    std::vector<int> carriers_;
    std::map<int, CarrierSurface> surfaces_;
    std::vector<UprightBox> ways_;  // free access to the objects in shelves
    bool kitchen_ = false;
    bool desk_ = false;
};

}  // namespace

void stackThings(int objects, Furnisher& furnisher) {
    Stacker stacker(furnisher);
    stacker.putTelevisions();
    stacker.stackUpTo(objects);
    // If that is not enough, a third equal object is allowed.
    furnisher.most_alike = 3;
    stacker.stackUpTo(objects);
}

}  // namespace dollytrack::generate
