#pragma once

#include "engine/generate/floor_ways.h"
#include "engine/generate/furniture_role.h"
#include "engine/generate/upright_box.h"

#include <Eigen/Core>

#include <vector>

namespace dollytrack::generate {

/// Something placed, and what holds it.
struct PlacedPiece {
    enum class Hold { Floor, Wall, Ceiling, Piece, Opening };
    const CatalogPiece* piece = nullptr;
    FurnitureRole role = FurnitureRole::Door;
    Eigen::Vector2d at = Eigen::Vector2d::Zero();
    double angle = 0.0;
    double elevation = 0.0;
    Hold hold = Hold::Floor;
    int supporter = -1;  // index of the piece it stands on or in

    [[nodiscard]] UprightBox box() const;
};

/// A place along a wall: 0 top, 1 right, 2 bottom, 3 left of the page.
struct WallPlace {
    int wall = 0;
    double along = 0.0;  // cm, of the middle
};
/// The angle of what stands with its back to a wall.
double angleAt(int wall);

/// Thickness of the building's walls, cm: the deepest windows hardly stick out of them.
constexpr double kWallThickness = 24.0;

/// The room's contents, free of overlaps: nothing gets in that touches what is there, and nothing
/// that cuts the floor which a camera can be over into pieces.
class RoomLayout {
  public:
    /// cm.
    RoomLayout(double length, double width, double height);

    [[nodiscard]] double length() const { return length_; }
    [[nodiscard]] double width() const { return width_; }
    [[nodiscard]] double height() const { return height_; }
    [[nodiscard]] double wallLength(int wall) const { return wall % 2 == 0 ? length_ : width_; }
    [[nodiscard]] const std::vector<PlacedPiece>& pieces() const { return pieces_; }
    /// Pieces that are no doors and windows.
    [[nodiscard]] int furnished() const;

    /// A piece on the floor with its back `gap` before the wall.
    [[nodiscard]] PlacedPiece atWall(const CatalogPiece& piece, FurnitureRole role,
                                     const WallPlace& place, double gap) const;

    /// Adds the piece if it fits: inside the room, apart from all others and what is reserved. What
    /// has a supporter is only compared with the other pieces: whoever puts it there has compared
    /// the two more closely.
    bool add(const PlacedPiece& piece);
    /// Adds a door or a window into a wall and keeps a box before it clear.
    void addOpening(const PlacedPiece& piece, const UprightBox& clear);
    /// Where one comes in has to stay joined with the rest of the floor.
    void reach(const Eigen::Vector2d& point) { ways_.reach(point); }

  private:
    [[nodiscard]] bool isInside(const UprightBox& box) const;
    [[nodiscard]] bool fits(const PlacedPiece& piece) const;

    double length_;
    double width_;
    double height_;
    std::vector<PlacedPiece> pieces_;
    std::vector<UprightBox> reserved_;
    FloorWays ways_;
};

}  // namespace dollytrack::generate
