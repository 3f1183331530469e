#include "engine/generate/room_layout.h"

#include <algorithm>
#include <numbers>

namespace dollytrack::generate {
namespace {

using Eigen::Vector2d;

constexpr double kGap = 0.5;          // cm between pieces
constexpr double kEdge = 0.2;         // cm between pieces and walls or ceiling
constexpr double kPassUnder = 200.0;  // cm: pieces at this elevation do not obstruct the floor
constexpr double kFlat = 20.0;        // cm: nor do wall-mounted pieces of this depth

bool isInTheWay(const PlacedPiece& piece) {
    if (piece.supporter >= 0 || piece.elevation >= kPassUnder) return false;
    return piece.support != PlacedPiece::Support::Wall || piece.piece->depth > kFlat;
}

}  // namespace

double angleAt(int wall) {
    return wall * 0.5 * std::numbers::pi;
}

UprightBox PlacedPiece::box() const {
    return {
        at, {0.5 * piece->width, 0.5 * piece->depth}, angle, elevation, elevation + piece->height};
}

RoomLayout::RoomLayout(double length, double width, double height)
    : length_(length), width_(width), height_(height), floor_(length, width) {}

int RoomLayout::furnished() const {
    return static_cast<int>(std::count_if(pieces_.begin(), pieces_.end(), [](const auto& piece) {
        return piece.support != PlacedPiece::Support::Opening;
    }));
}

PlacedPiece RoomLayout::atWall(const CatalogPiece& piece, FurnitureRole role,
                               const WallPlace& place, double gap) const {
    PlacedPiece placed;
    placed.piece = &piece;
    placed.role = role;
    placed.angle = angleAt(place.wall);
    switch (place.wall) {
        case 0:
            placed.at = {place.along, 0.0};
            break;
        case 1:
            placed.at = {length_, place.along};
            break;
        case 2:
            placed.at = {place.along, width_};
            break;
        default:
            placed.at = {0.0, place.along};
    }
    placed.at += (0.5 * piece.depth + gap) * forwardAt(placed.angle);
    return placed;
}

bool RoomLayout::isInside(const UprightBox& box) const {
    const double reach_x = reachAlong(box, Vector2d::UnitX());
    const double reach_y = reachAlong(box, Vector2d::UnitY());
    return box.centre.x() - reach_x >= kEdge && box.centre.x() + reach_x <= length_ - kEdge &&
           box.centre.y() - reach_y >= kEdge && box.centre.y() + reach_y <= width_ - kEdge &&
           box.low >= 0.0 && box.high <= height_ - kEdge;
}

bool RoomLayout::fits(const PlacedPiece& piece) const {
    const UprightBox box = piece.box();
    if (!isInside(box)) return false;
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
        if (static_cast<int>(i) == piece.supporter) continue;
        if (pieces_[i].support == PlacedPiece::Support::Opening) continue;
        if (near(box, pieces_[i].box(), kGap)) return false;
    }
    if (piece.supporter >= 0) return true;
    return std::none_of(reserved_.begin(), reserved_.end(),
                        [&](const UprightBox& kept) { return near(box, kept, 0.0); });
}

bool RoomLayout::add(const PlacedPiece& piece) {
    if (!fits(piece)) return false;
    if (isInTheWay(piece)) {
        if (!floor_.staysConnectedWith(piece.box())) return false;
        floor_.block(piece.box());
    }
    pieces_.push_back(piece);
    return true;
}

void RoomLayout::addOpening(const PlacedPiece& piece, const UprightBox& clear) {
    pieces_.push_back(piece);
    reserved_.push_back(clear);
}

}  // namespace dollytrack::generate
