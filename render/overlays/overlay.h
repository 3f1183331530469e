#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace dollytrack::render {

/// Who draws an overlay may number its elements, to know again what was clicked.
constexpr std::int32_t kNoTag = -1;

/// A straight line in the world.
struct OverlayLine {
    Eigen::Vector3d a = Eigen::Vector3d::Zero();
    Eigen::Vector3d b = Eigen::Vector3d::Zero();
    Eigen::Vector4f rgba = {1, 1, 1, 1};  // sRGB
    double width_px = 2.0;
    double dash_px = 0.0;  // length of a dash and of the gap after it; 0: solid
    std::int32_t tag = kNoTag;
};

/// A sign at a point that always faces the viewer.
struct OverlayMark {
    enum class Shape { Dot, Cross, Square, Ring, Arrow };
    Eigen::Vector3d at = Eigen::Vector3d::Zero();
    Shape shape = Shape::Dot;
    Eigen::Vector4f rgba = {1, 1, 1, 1};
    double size_px = 8.0;  // across
    /// Arrow only: where it points. Seen along its own direction it is a dot.
    Eigen::Vector3d direction = Eigen::Vector3d::Zero();
    std::int32_t tag = kNoTag;
};

/// A block that stands upright, with its edges drawn in.
struct OverlayBox {
    Eigen::Vector3d center = Eigen::Vector3d::Zero();
    Eigen::Vector3d half_size = Eigen::Vector3d::Zero();  // along its own axes, m
    Eigen::Vector4f rgba = {1, 1, 1, 1};
    double yaw = 0.0;  // radians, turns the world's x axis onto the box's first axis
    std::int32_t tag = kNoTag;
};

/// A piece of a surface, seen from both sides.
struct OverlayTriangle {
    Eigen::Vector3d a = Eigen::Vector3d::Zero();
    Eigen::Vector3d b = Eigen::Vector3d::Zero();
    Eigen::Vector3d c = Eigen::Vector3d::Zero();
    Eigen::Vector4f rgba = {1, 1, 1, 1};
    std::int32_t tag = kNoTag;
};

/// What is drawn over a picture of a scene: as plain data, so that anyone can fill it. Boxes are
/// drawn first, then triangles, lines and marks, each in their order. Of boxes and triangles only
/// the foremost shows, so that a thousand translucent cells do not add up to a wall of paint.
struct Overlay {
    std::vector<OverlayBox> boxes;
    std::vector<OverlayTriangle> triangles;
    std::vector<OverlayLine> lines;
    std::vector<OverlayMark> marks;
};

}  // namespace dollytrack::render
