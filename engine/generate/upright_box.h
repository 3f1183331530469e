#pragma once

#include <Eigen/Core>

#include <array>

namespace dollytrack::generate {

/// All lengths in this folder are in cm, in the plan of Sweet Home 3D: the room is 0..length by
/// 0..width, x to the right, y down the page; angles are in radians, clockwise on the page; a piece
/// at angle 0 faces down the page. The third coordinate is the height.

/// A box with a vertical axis.
struct UprightBox {
    Eigen::Vector2d centre = Eigen::Vector2d::Zero();
    Eigen::Vector2d half = Eigen::Vector2d::Zero();  // half its width and half its depth
    double angle = 0.0;
    double low = 0.0;
    double high = 0.0;
};

/// Half the extent of a box along a horizontal unit vector.
double reachAlong(const UprightBox& box, const Eigen::Vector2d& direction);

/// Whether two boxes are less than `gap` apart, by separating axes. Exact for a gap of 0; at
/// corners, boxes that are slightly farther apart may count as near.
bool near(const UprightBox& a, const UprightBox& b, double gap);

using TriangleInRoom = std::array<Eigen::Vector3d, 3>;

/// Whether a triangle intersects a box: thirteen separating axes (Akenine-Moeller 2001).
bool reachesInto(const TriangleInRoom& triangle, const UprightBox& box);

/// Unit vectors of a piece at this angle: its front and its width axis.
Eigen::Vector2d forwardAt(double angle);
Eigen::Vector2d acrossAt(double angle);

}  // namespace dollytrack::generate
