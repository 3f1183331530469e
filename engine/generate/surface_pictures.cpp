#include "engine/generate/surface_pictures.h"

#include "engine/io/files/png_writer.h"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>

namespace dollytrack::generate {
namespace {

using Eigen::Vector3d;

constexpr int kSide = 512;  // pixels

/// Tileable value noise, -1..1: random values on a grid, interpolated.
class Noise {
  public:
    Noise(int across, int down, Random& random) : across_(across), down_(down) {
        values_.resize(static_cast<std::size_t>(across) * down);
        for (double& value : values_) value = random.uniform(-1.0, 1.0);
    }
    [[nodiscard]] double at(int x, int y) const {
        const double u = static_cast<double>(x) * across_ / kSide;
        const double v = static_cast<double>(y) * down_ / kSide;
        const int left = static_cast<int>(u);
        const int top = static_cast<int>(v);
        const double s = u - left;
        const double t = v - top;
        return (1.0 - t) * ((1.0 - s) * value(left, top) + s * value(left + 1, top)) +
               t * ((1.0 - s) * value(left, top + 1) + s * value(left + 1, top + 1));
    }

  private:
    [[nodiscard]] double value(int x, int y) const {
        return values_[(y % down_) * across_ + x % across_];
    }
    int across_;
    int down_;
    std::vector<double> values_;
};

/// A texture of one colour (sRGB, 0..1), multiplied by `shade` at each pixel.
template <class Shade>
Result<std::vector<std::uint8_t>> paint(const Vector3d& color, Shade&& shade) {
    std::vector<std::uint8_t> pixels;
    pixels.reserve(std::size_t{3} * kSide * kSide);
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
            const double value = shade(x, y);
            for (int i = 0; i < 3; ++i) {
                pixels.push_back(static_cast<std::uint8_t>(
                    std::lround(255.0 * std::clamp(color[i] * value, 0.0, 1.0))));
            }
        }
    }
    return encodePng(kSide, kSide, PngFormat::Rgb8, pixels);
}

Vector3d oneOf(std::initializer_list<Vector3d> colors, Random& random) {
    return *(colors.begin() + random.below(static_cast<std::uint32_t>(colors.size())));
}

bool isAtEdge(int x, int period, int width) {
    return x % period < width;
}

}  // namespace

Result<std::vector<std::uint8_t>> boardsPicture(Random& random) {
    constexpr int kBoards = 8;
    constexpr int kBoard = kSide / kBoards;
    const Vector3d color = oneOf(
        {{0.66, 0.47, 0.30}, {0.48, 0.33, 0.22}, {0.76, 0.62, 0.45}, {0.55, 0.50, 0.45}}, random);
    std::array<double, kBoards> tint{};
    std::array<int, kBoards> joint{};
    for (double& value : tint) value = random.uniform(0.82, 1.0);
    for (int& at : joint) at = static_cast<int>(random.below(kSide));
    const Noise grain(8, 128, random);
    const Noise fine(256, 256, random);
    return paint(color, [&](int x, int y) {
        const std::size_t board = y / kBoard;
        const bool seam = isAtEdge(y, kBoard, 2) || isAtEdge(x + joint[board], kSide, 2);
        return (seam ? 0.55 : tint[board]) + 0.09 * grain.at(x, y) + 0.04 * fine.at(x, y);
    });
}

Result<std::vector<std::uint8_t>> tilesPicture(Random& random) {
    constexpr int kTiles = 4;
    constexpr int kTile = kSide / kTiles;
    const Vector3d color =
        oneOf({{0.78, 0.76, 0.72}, {0.62, 0.60, 0.58}, {0.72, 0.58, 0.48}}, random);
    std::array<double, static_cast<std::size_t>(kTiles * kTiles)> tint{};
    for (double& value : tint) value = random.uniform(0.88, 1.0);
    const Noise clouds(24, 24, random);
    const Noise fine(256, 256, random);
    return paint(color, [&](int x, int y) {
        const bool joint = isAtEdge(x, kTile, 3) || isAtEdge(y, kTile, 3);
        const std::size_t tile = (y / kTile) * kTiles + x / kTile;
        return (joint ? 0.6 : tint[tile]) + 0.05 * clouds.at(x, y) + 0.03 * fine.at(x, y);
    });
}

Result<std::vector<std::uint8_t>> plasterPicture(Random& random) {
    const Vector3d color = oneOf({{0.90, 0.89, 0.85},
                                  {0.85, 0.88, 0.90},
                                  {0.90, 0.85, 0.76},
                                  {0.80, 0.86, 0.80},
                                  {0.88, 0.82, 0.80}},
                                 random);
    const Noise clouds(12, 12, random);
    const Noise grain(128, 128, random);
    const Noise fine(256, 256, random);
    return paint(color, [&](int x, int y) {
        return 0.95 + 0.02 * clouds.at(x, y) + 0.025 * grain.at(x, y) + 0.03 * fine.at(x, y);
    });
}

}  // namespace dollytrack::generate
