#pragma once

#include <Eigen/Core>

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
    };
    struct Key {
        double arc_m = 0.0;  // where on the path
        int position_point = -1;
        Eigen::Vector3d position = Eigen::Vector3d::Zero();  // on the curve
    };
    int component = 0;
    std::vector<Piece> pieces;
    std::vector<Key> keys;  // by rising arc length
    std::vector<Corner> corners;
    double length_m = 0.0;
    double min_clearance_m = 0.0;  // between the camera's centre and the nearest surface
    int collisions = 0;            // pieces that could not be proven free
    int corner_collisions = 0;     // those of them that are curves

    [[nodiscard]] Eigen::Vector3d at(double arc_m) const;
};

}  // namespace dollytrack
