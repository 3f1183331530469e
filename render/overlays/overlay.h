#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace dollytrack::render {

/// A straight line in the world.
struct OverlayLine {
    Eigen::Vector3d a = Eigen::Vector3d::Zero();
    Eigen::Vector3d b = Eigen::Vector3d::Zero();
    Eigen::Vector4f rgba = {1, 1, 1, 1};  // sRGB
    double width_px = 2.0;
};

/// A sign at a point that always faces the viewer.
struct OverlayMark {
    enum class Shape { Dot, Cross };
    Eigen::Vector3d at = Eigen::Vector3d::Zero();
    Shape shape = Shape::Dot;
    Eigen::Vector4f rgba = {1, 1, 1, 1};
    double size_px = 8.0;
};

/// What is drawn over a picture of a scene: as plain data, so that anyone can fill it.
struct Overlay {
    std::vector<OverlayLine> lines;
    std::vector<OverlayMark> marks;
};

}  // namespace dollytrack::render
