#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace dollytrack {

/// A corner of the path: a key frame, or a mere turning point.
struct PathVertex {
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    int position_point = -1;  // index; -1: a turning point
};

/// The polyline through one component of free space.
struct CameraPath {
    int component = 0;
    int room = 0;  // see PositionPoint::room
    std::vector<PathVertex> vertices;
};

/// What smoothing made of one inner corner.
struct Corner {
    int vertex = 0;           // index in CameraPath::vertices
    double set_back_m = 0.0;  // Bezier set-back; 0: the camera stops and turns
    bool shortened = false;   // less than asked for, because of an obstacle or a capture
};

/// A path with its corners rounded: straight pieces and quadratic Bezier curves, each proven free
/// for the camera sphere.
struct SmoothPath {
    struct Piece {
        Eigen::Vector3d start, control,
            end;  // control: the corner; for a straight piece the middle
        double length_m = 0.0;
        bool curved = false;
        double begin_m = 0.0;   // length of the path before it
        bool collides = false;  // could not be proven free; set for given motions only

        /// Point of the curve, by its own parameter 0..1.
        [[nodiscard]] Eigen::Vector3d at(double t) const;
        /// The parameter that far along the piece, to rounding.
        [[nodiscard]] double parameterAt(double way_m) const;
        /// 1 / radius, 1/m.
        [[nodiscard]] double curvature(double t) const;
    };
    struct Key {
        double arc_m = 0.0;       // where on the path
        int position_point = -1;  // -1: no key frame, only a view towards looks_at
        Eigen::Vector3d position = Eigen::Vector3d::Zero();  // on the curve
        Eigen::Vector3d looks_at = Eigen::Vector3d::Zero();  // world; without a position point
        // Of the way from the key before:
        double image_motion_rad = 0.0;  // 0: not measured
        double frame_weight = 1.0;      // relative number of frames per second under a budget
    };
    int component = 0;
    std::vector<Piece> pieces;
    std::vector<Key> keys;  // by rising arc length
    std::vector<Corner> corners;
    double length_m = 0.0;
    double min_clearance_m = 0.0;  // between the camera's centre and the nearest surface
    int collisions = 0;            // pieces that could not be proven free
    int corner_collisions = 0;     // those of them that are curves

    /// Adds a piece at the end, with its length; one of no length is left out.
    void append(const Eigen::Vector3d& start, const Eigen::Vector3d& control,
                const Eigen::Vector3d& end, bool curved);

    /// Index of the piece there; the last one that begins there or before.
    [[nodiscard]] std::size_t pieceAt(double arc_m) const;
    [[nodiscard]] Eigen::Vector3d at(double arc_m) const;
};

}  // namespace dollytrack
