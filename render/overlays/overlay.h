#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace dollytrack::render {

/// Tag of elements without a number. Tags identify the clicked element.
constexpr std::int32_t kNoTag = -1;

/// A straight line, world frame, m.
struct OverlayLine {
    Eigen::Vector3d a = Eigen::Vector3d::Zero();
    Eigen::Vector3d b = Eigen::Vector3d::Zero();
    Eigen::Vector4f rgba = {1, 1, 1, 1};  // sRGB
    double width_px = 2.0;
    double dash_px = 0.0;  // length of a dash and of the gap after it; 0: solid
    std::int32_t tag = kNoTag;
};

/// A symbol of fixed screen size at a world position.
struct OverlayMark {
    enum class Shape { Dot, Cross, Square, Ring, Arrow };
    Eigen::Vector3d at = Eigen::Vector3d::Zero();
    Shape shape = Shape::Dot;
    Eigen::Vector4f rgba = {1, 1, 1, 1};
    double size_px = 8.0;  // diameter
    /// Direction of an Arrow; an arrow seen end-on becomes a dot.
    Eigen::Vector3d direction = Eigen::Vector3d::Zero();
    std::int32_t tag = kNoTag;
};

/// An upright box with its edges drawn.
struct OverlayBox {
    Eigen::Vector3d center = Eigen::Vector3d::Zero();
    Eigen::Vector3d half_size = Eigen::Vector3d::Zero();  // along its own axes, m
    Eigen::Vector4f rgba = {1, 1, 1, 1};
    double yaw = 0.0;  // radians, from the world's x axis to the box's first axis
    std::int32_t tag = kNoTag;
};

/// A triangle, world frame, m; its front is the side from which a, b, c are counter-clockwise.
struct OverlayTriangle {
    Eigen::Vector3d a = Eigen::Vector3d::Zero();
    Eigen::Vector3d b = Eigen::Vector3d::Zero();
    Eigen::Vector3d c = Eigen::Vector3d::Zero();
    Eigen::Vector4f rgba = {1, 1, 1, 1};
    std::int32_t tag = kNoTag;
};

/// Elements drawn over an image of a scene. Boxes are drawn first, then triangles, lines and
/// marks, each in their order. Only the frontmost box or triangle of a pixel is drawn, so that many
/// translucent cells do not add up to an opaque colour.
struct Overlay {
    std::vector<OverlayBox> boxes;
    std::vector<OverlayTriangle> triangles;
    bool one_sided_triangles = false;  // draws only their fronts
    std::vector<OverlayLine> lines;
    std::vector<OverlayMark> marks;
};

}  // namespace dollytrack::render
