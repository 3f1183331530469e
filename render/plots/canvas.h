#pragma once

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace dollytrack::render {

using Ink = std::array<std::uint8_t, 3>;  // red, green, blue

enum class Align { Left, Middle, Right };

/// A drawing surface for figures. Coordinates are px, x right, y down, origin at the upper left.
class Canvas {
  public:
    virtual ~Canvas() = default;
    virtual void line(const std::vector<Eigen::Vector2d>& points, Ink ink, double width) = 0;
    virtual void rectangle(const Eigen::Vector2d& low, const Eigen::Vector2d& high, Ink ink) = 0;
    virtual void dot(const Eigen::Vector2d& center, double radius, Ink ink) = 0;
    /// `at` lies on the text's baseline. `size` is the font size, px.
    virtual void text(const Eigen::Vector2d& at, const std::string& text, double size, Align align,
                      Ink ink) = 0;
    /// The encoded file.
    [[nodiscard]] virtual std::string finish() = 0;
};

std::unique_ptr<Canvas> makeSvgCanvas(int width, int height);
/// A PNG canvas; finish() returns an empty string if encoding fails. Non-ASCII letters become
/// question marks.
std::unique_ptr<Canvas> makePngCanvas(int width, int height);

}  // namespace dollytrack::render
