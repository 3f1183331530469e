#pragma once

#include <Eigen/Core>

#include <array>

namespace dollytrack::generate {

/// Everything in this folder is in cm in the plan of Sweet Home 3D: the room is 0..length by
/// 0..width, x to the right, y down the page, angles in radians and clockwise on it; a piece at
/// angle 0 looks down the page. The third coordinate is the height.

/// A box that stands upright in the room.
struct UprightBox {
    Eigen::Vector2d centre = Eigen::Vector2d::Zero();
    Eigen::Vector2d half = Eigen::Vector2d::Zero();  // along its width and its depth
    double angle = 0.0;
    double low = 0.0;
    double high = 0.0;
};

/// How far a box reaches from its centre along a direction.
double reachAlong(const UprightBox& box, const Eigen::Vector2d& direction);

/// Whether two boxes come nearer than `gap`; exact for the boxes themselves (separating axes), and
/// on the safe side of a gap at their corners.
bool near(const UprightBox& a, const UprightBox& b, double gap);

using TriangleInRoom = std::array<Eigen::Vector3d, 3>;

/// Whether a triangle reaches into a box: thirteen separating axes (Akenine-Moeller 2001).
bool reachesInto(const TriangleInRoom& triangle, const UprightBox& box);

/// The way that something at this angle looks, and its right.
Eigen::Vector2d forwardAt(double angle);
Eigen::Vector2d acrossAt(double angle);

}  // namespace dollytrack::generate
