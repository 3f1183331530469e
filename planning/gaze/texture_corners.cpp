#include "planning/gaze/texture_corners.h"

#include "engine/jobs/parallel.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace dollytrack::planning {
namespace {

constexpr int kLargestSide_px = 1024;  // finer levels would only be seen from very near
constexpr int kSmallestSide_px = 16;
constexpr int kBlock_px = 32;
constexpr double kCornerStrength = 1.2e-3;  // least eigenvalue of the gradients' covariance
constexpr float kLargestDensity = 0.02F;    // more corners than this suppress each other

/// Number of blocks along a side.
int blocks(int side_px) {
    return (side_px + kBlock_px - 1) / kBlock_px;
}

/// Corners per texel of one level, by block.
std::vector<float> cornersByBlock(const cv::Mat& grey) {
    const int columns = blocks(grey.cols);
    const int rows = blocks(grey.rows);
    cv::Mat strength;
    cv::Mat strongest;
    cv::cornerMinEigenVal(grey, strength, 3, 3, cv::BORDER_REPLICATE);
    cv::dilate(strength, strongest, {});
    std::vector<float> density(static_cast<std::size_t>(columns) * rows, 0.0F);
    for (int y = 0; y < grey.rows; ++y) {
        for (int x = 0; x < grey.cols; ++x) {
            const float here = strength.at<float>(y, x);
            if (here < kCornerStrength || here < strongest.at<float>(y, x)) continue;
            // A plateau of equal strength counts once.
            if (x > 0 && strength.at<float>(y, x - 1) == here) continue;
            if (y > 0 && strength.at<float>(y - 1, x) == here) continue;
            density[y / kBlock_px * columns + x / kBlock_px] += 1.0F;
        }
    }
    for (int y = 0; y < rows; ++y) {
        for (int x = 0; x < columns; ++x) {
            const int width = std::min(kBlock_px, grey.cols - x * kBlock_px);
            const int height = std::min(kBlock_px, grey.rows - y * kBlock_px);
            float& one = density[y * columns + x];
            one = std::min(kLargestDensity, one / static_cast<float>(width * height));
        }
    }
    return density;
}

/// Where in a repeated texture, 0 to below `size`.
int wrapped(float coordinate, int size) {
    const float part = coordinate - std::floor(coordinate);
    return std::clamp(static_cast<int>(part * static_cast<float>(size)), 0, size - 1);
}

}  // namespace

TextureCorners::TextureCorners(const Scene& scene) : textures_(scene.textures.size()) {
    std::vector<bool> used(scene.textures.size(), false);
    for (const Material& material : scene.materials) {
        if (material.texture >= 0) used[material.texture] = true;
    }
    parallelFor(scene.textures.size(), [&](std::size_t t) {
        const Texture& texture = scene.textures[t];
        if (!used[t] || texture.width <= 0 || texture.height <= 0) return;
        const cv::Mat rgba(texture.height, texture.width, CV_8UC4,
                           const_cast<std::uint8_t*>(texture.rgba.data()));
        cv::Mat grey;
        cv::cvtColor(rgba, grey, cv::COLOR_RGBA2GRAY);
        Detail& detail = textures_[t];
        detail.brightness = cv::mean(grey)[0] / 255.0;
        detail.scale = std::min(
            1.0, static_cast<double>(kLargestSide_px) / std::max(texture.width, texture.height));
        if (detail.scale < 1.0) {
            // A very narrow texture keeps one row or column.
            const cv::Size size(std::max(1, cvRound(detail.scale * texture.width)),
                                std::max(1, cvRound(detail.scale * texture.height)));
            cv::resize(grey, grey, size, 0.0, 0.0, cv::INTER_AREA);
        }
        while (std::min(grey.cols, grey.rows) >= kSmallestSide_px) {
            detail.levels.push_back({grey.cols, grey.rows, cornersByBlock(grey)});
            cv::resize(grey, grey, {}, 0.5, 0.5, cv::INTER_AREA);
        }
    });
}

double TextureCorners::perPixel(int texture, const Eigen::Vector2f& uv, double texels) const {
    if (texture < 0 || textures_[texture].levels.empty() || !uv.allFinite()) return 0.0;
    const Detail& detail = textures_[texture];
    const double covered = texels * detail.scale;
    const auto last = static_cast<double>(detail.levels.size() - 1);
    const double level = std::clamp(std::round(std::log2(std::max(covered, 1e-3))), 0.0, last);
    const Level& at = detail.levels[static_cast<std::size_t>(level)];
    const int row = wrapped(1.0F - uv.y(), at.height) / kBlock_px;
    const int column = wrapped(uv.x(), at.width) / kBlock_px;
    const double density = at.density[row * blocks(at.width) + column];
    // A magnified texture has fewer corners per pixel.
    return density * std::min(1.0, covered * covered);
}

double TextureCorners::brightness(int texture) const {
    return texture < 0 ? 1.0 : textures_[texture].brightness;
}

}  // namespace dollytrack::planning
