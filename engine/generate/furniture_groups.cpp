#include "engine/generate/furnisher.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dollytrack::generate {
namespace {

using Eigen::Vector2d;
using enum FurnitureRole;

constexpr double kPi = std::numbers::pi;
constexpr double kChairGap = 3.0;  // cm between a chair and its table

/// Adds a piece beside another, with their backs in line.
void addBeside(Furnisher& f, const PlacedPiece& other, FurnitureRole role, double side) {
    const CatalogPiece* piece = f.pick(role);
    if (!piece) return;
    PlacedPiece placed = other;
    placed.piece = piece;
    placed.role = role;
    placed.at += side * (0.5 * (other.piece->width + piece->width) + 4.0) * acrossAt(other.angle) -
                 0.5 * (other.piece->depth - piece->depth) * forwardAt(other.angle);
    f.layout.add(placed);
}

/// Adds a piece in front of another. It faces the same way, or the other piece if turned by pi.
bool addBefore(Furnisher& f, const PlacedPiece& other, FurnitureRole role, double gap,
               double turn) {
    const CatalogPiece* piece = f.pick(role);
    if (!piece) return false;
    PlacedPiece placed;
    placed.piece = piece;
    placed.role = role;
    placed.angle = other.angle + turn;
    placed.at =
        other.at + (0.5 * (other.piece->depth + piece->depth) + gap) * forwardAt(other.angle);
    return f.layout.add(placed);
}

/// Adds a seat at an end of a low table, facing it.
void addSeatAtEnd(Furnisher& f, const PlacedPiece& table, FurnitureRole role, double side) {
    const CatalogPiece* piece = f.pick(role);
    if (!piece) return;
    PlacedPiece placed;
    placed.piece = piece;
    placed.role = role;
    placed.angle = table.angle + side * 0.5 * kPi;
    placed.at = table.at +
                side * (0.5 * (table.piece->width + piece->depth) + 40.0) * acrossAt(table.angle);
    f.layout.add(placed);
}

/// Adds a TV stand at the wall that a seat faces, as directly opposite as space permits.
void addTelevisionStand(Furnisher& f, const PlacedPiece& seat) {
    const int wall = (static_cast<int>(std::lround(seat.angle / (0.5 * kPi))) + 2) % 4;
    const double opposite = wall % 2 == 0 ? seat.at.x() : seat.at.y();
    for (int i = 0; i < 12; ++i) {
        const CatalogPiece* stand = f.pick(TvStand);
        if (!stand) return;
        const double along = opposite + f.random.uniform(-1.0, 1.0) * 12.0 * i;
        if (f.layout.add(f.layout.atWall(*stand, TvStand, {wall, along}, 2.0))) return;
    }
}

void addChairsAround(Furnisher& f, const PlacedPiece& table) {
    const CatalogPiece* chair = f.pick(DiningChair);
    if (!chair) return;
    const auto add = [&](const Vector2d& at, double angle) {
        PlacedPiece placed;
        placed.piece = chair;
        placed.role = DiningChair;
        placed.at = at;
        placed.angle = angle + f.random.uniform(-0.05, 0.05);
        f.layout.add(placed);
    };
    const Vector2d across = acrossAt(table.angle);
    const Vector2d down = forwardAt(table.angle);
    const double width = table.piece->width;
    const int along = std::max(1, static_cast<int>(width / (chair->width + 12.0)));
    const double out = 0.5 * (table.piece->depth + chair->depth) + kChairGap;
    for (const double side : {-1.0, 1.0}) {
        for (int i = 0; i < along; ++i) {
            // At angle 0 a chair faces down the page, so those on the lower side are turned by pi.
            add(table.at + ((i + 0.5) / along - 0.5) * width * across + side * out * down,
                table.angle + (side > 0.0 ? kPi : 0.0));
        }
    }
    const bool square = std::abs(width - table.piece->depth) < 15.0;
    if (width < 130.0 && !square) return;
    const double end = 0.5 * (width + chair->depth) + kChairGap;
    for (const double side : {-1.0, 1.0}) {
        add(table.at + side * end * across, table.angle + side * 0.5 * kPi);
    }
}

}  // namespace

void addBedGroup(Furnisher& f) {
    const auto index = addAtWall(f, Bed, 60);
    if (!index) return;
    const PlacedPiece bed = f.layout.pieces()[*index];
    for (const double side : {-1.0, 1.0}) addBeside(f, bed, NightStand, side);
}

void addSofaGroup(Furnisher& f) {
    const auto index = addAtWall(f, Sofa, 60);
    if (!index) return;
    const PlacedPiece sofa = f.layout.pieces()[*index];
    for (int i = 0; i < 6; ++i) {
        if (!addBefore(f, sofa, CoffeeTable, f.random.uniform(35.0, 50.0), 0.0)) continue;
        const PlacedPiece table = f.layout.pieces().back();
        for (const double side : {-1.0, 1.0}) addSeatAtEnd(f, table, Armchair, side);
        break;
    }
    addTelevisionStand(f, sofa);
}

void addDeskGroup(Furnisher& f) {
    const auto index = addAtWall(f, Desk, 40);
    if (!index) return;
    const PlacedPiece desk = f.layout.pieces()[*index];
    for (int i = 0; i < 8; ++i) {
        if (addBefore(f, desk, OfficeChair, f.random.uniform(4.0, 15.0), kPi)) return;
    }
}

void addDiningGroup(Furnisher& f) {
    for (int i = 0; i < 60; ++i) {
        const CatalogPiece* piece = f.pick(DiningTable);
        if (!piece) return;
        PlacedPiece table;
        table.piece = piece;
        table.role = DiningTable;
        table.angle = f.tossCoin() ? 0.0 : 0.5 * kPi;
        const double x = f.random.uniform(0.3, 0.7) * f.layout.length();
        const double y = f.random.uniform(0.3, 0.7) * f.layout.width();
        table.at = {x, y};
        if (!f.layout.add(table)) continue;
        addChairsAround(f, table);
        addCeilingLamp(f, table.at);
        return;
    }
}

}  // namespace dollytrack::generate
