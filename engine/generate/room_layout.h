#pragma once

#include "engine/generate/furniture/furniture_role.h"
#include "engine/generate/traversability_grid.h"
#include "engine/generate/upright_box.h"

#include <Eigen/Core>

#include <vector>

namespace dollytrack::generate {

/// A placed piece and its support.
struct PlacedPiece {
    enum class Support { Floor, Wall, Ceiling, Piece, Opening };
    const CatalogPiece* piece = nullptr;
    FurnitureRole role = FurnitureRole::Door;
    Eigen::Vector2d at = Eigen::Vector2d::Zero();
    double angle = 0.0;
    double elevation = 0.0;
    Support support = Support::Floor;
    int supporter = -1;  // index of the piece it stands on or in; -1: none

    [[nodiscard]] UprightBox box() const;
};

/// A position along a wall.
struct WallPlace {
    int wall = 0;        // 0 top, 1 right, 2 bottom, 3 left of the page
    double along = 0.0;  // cm, of the piece's centre
};
/// The angle of a piece with its back to a wall.
double angleAt(int wall);

/// Thickness of the walls, cm; about the depth of the deepest windows.
constexpr double kWallThickness = 24.0;

/// The pieces in a room. No piece is added that touches another one (except the piece it stands on;
/// doors and windows are not compared), or that disconnects the floor area in which a camera fits.
class RoomLayout {
  public:
    /// Size of the room, cm.
    RoomLayout(double length, double width, double height);

    [[nodiscard]] double length() const { return length_; }
    [[nodiscard]] double width() const { return width_; }
    [[nodiscard]] double height() const { return height_; }
    [[nodiscard]] double wallLength(int wall) const { return wall % 2 == 0 ? length_ : width_; }
    [[nodiscard]] const std::vector<PlacedPiece>& pieces() const { return pieces_; }
    /// Number of pieces without doors and windows.
    [[nodiscard]] int furnished() const;

    /// A piece on the floor with its back to the wall, `gap` cm away from it.
    [[nodiscard]] PlacedPiece atWall(const CatalogPiece& piece, FurnitureRole role,
                                     const WallPlace& place, double gap) const;

    /// Adds the piece if it is inside the room, touches no other piece (doors and windows do not
    /// count) and no reserved box, and leaves the floor connected; returns whether it was added. A
    /// supported piece is not compared with its supporter, because the caller has done so at
    /// triangle level, nor with reserved boxes.
    bool add(const PlacedPiece& piece);
    /// Adds a door or a window to a wall and reserves a box before it.
    void addOpening(const PlacedPiece& piece, const UprightBox& clear);
    /// Adds a point that must stay connected with the rest of the floor, such as an entrance.
    void reach(const Eigen::Vector2d& point) { floor_.reach(point); }

  private:
    [[nodiscard]] bool isInside(const UprightBox& box) const;
    [[nodiscard]] bool fits(const PlacedPiece& piece) const;

    double length_;
    double width_;
    double height_;
    std::vector<PlacedPiece> pieces_;
    std::vector<UprightBox> reserved_;
    TraversabilityGrid floor_;
};

}  // namespace dollytrack::generate
