#include "render/overlays/overlay_painter.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace dollytrack::render {
namespace {

constexpr float kThroughSurfaces = 0.22F;   // opacity of what is hidden
constexpr double kBias = 0.01;              // of the depth: a line on a floor is not in it
constexpr double kOrthographicBias = 0.02;  // m: there depth says nothing about nearness

/// A capsule on the screen: its axis, and at both ends what is linear between them there: the
/// inverse of the depth, or in an orthographic view the depth itself.
struct Stroke {
    Eigen::Vector2d a, b;
    double depth_a = 0.0;
    double depth_b = 0.0;
    double radius = 1.0;
    Eigen::Vector4f rgba;
};

class Painter {
  public:
    Painter(const View& view, const std::vector<float>& depth_m, std::vector<std::uint8_t>& rgb)
        : view_(view), depth_(depth_m), rgb_(rgb) {}

    void line(Eigen::Vector3d a, Eigen::Vector3d b, const Eigen::Vector4f& rgba, double width) {
        a = view_.pose.toCamera(a);
        b = view_.pose.toCamera(b);
        if (a.z() < view_.near_m && b.z() < view_.near_m) return;
        if (a.z() < view_.near_m) a = cutNear(b, a);
        if (b.z() < view_.near_m) b = cutNear(a, b);
        paint(
            {view_.project(a), view_.project(b), linear(a.z()), linear(b.z()), 0.5 * width, rgba});
    }

    void mark(const OverlayMark& mark, double scale) {
        const Eigen::Vector3d p = view_.pose.toCamera(mark.at);
        if (p.z() < view_.near_m) return;
        const Eigen::Vector2d at = view_.project(p);
        const double half = 0.5 * mark.size_px * scale;
        if (mark.shape == OverlayMark::Shape::Dot) {
            paint({at, at, linear(p.z()), linear(p.z()), half, mark.rgba});
            return;
        }
        for (const double side : {-1.0, 1.0}) {
            const Eigen::Vector2d arm(half, side * half);
            paint({at - arm, at + arm, linear(p.z()), linear(p.z()), 0.25 * half, mark.rgba});
        }
    }

  private:
    /// Depth to what is linear on the screen, and back.
    [[nodiscard]] double linear(double depth) const {
        return view_.orthographic ? depth : 1.0 / depth;
    }

    [[nodiscard]] Eigen::Vector3d cutNear(const Eigen::Vector3d& inside,
                                          const Eigen::Vector3d& outside) const {
        const double share = (inside.z() - view_.near_m) / (inside.z() - outside.z());
        return inside + share * (outside - inside);
    }

    void paint(const Stroke& stroke) {
        const int width = view_.intrinsics.width;
        const int height = view_.intrinsics.height;
        const double reach = stroke.radius + 1.0;
        const auto clampTo = [](double value, int limit) {
            return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(limit)));
        };
        const int x0 = clampTo(std::floor(std::min(stroke.a.x(), stroke.b.x()) - reach), width);
        const int x1 = clampTo(std::ceil(std::max(stroke.a.x(), stroke.b.x()) + reach), width);
        const int y0 = clampTo(std::floor(std::min(stroke.a.y(), stroke.b.y()) - reach), height);
        const int y1 = clampTo(std::ceil(std::max(stroke.a.y(), stroke.b.y()) + reach), height);
        const Eigen::Vector2d axis = stroke.b - stroke.a;
        const double squared = axis.squaredNorm();
        for (int y = y0; y < y1; ++y) {
            for (int x = x0; x < x1; ++x) {
                const Eigen::Vector2d p(x + 0.5, y + 0.5);
                const double along =
                    squared > 0.0 ? std::clamp((p - stroke.a).dot(axis) / squared, 0.0, 1.0) : 0.0;
                const double distance = (p - stroke.a - along * axis).norm();
                const double cover = std::clamp(stroke.radius + 0.5 - distance, 0.0, 1.0);
                if (cover <= 0.0) continue;
                const double depth = stroke.depth_a + along * (stroke.depth_b - stroke.depth_a);
                blend(static_cast<std::size_t>(y) * width + x, linear(depth), cover, stroke.rgba);
            }
        }
    }

    void blend(std::size_t pixel, double z, double cover, const Eigen::Vector4f& rgba) {
        const double surface = depth_[pixel];
        const double nearer = view_.orthographic ? z - kOrthographicBias : z * (1.0 - kBias);
        const bool hidden = surface > 0.0 && nearer > surface;
        const float opacity =
            static_cast<float>(cover) * rgba[3] * (hidden ? kThroughSurfaces : 1.0F);
        for (std::size_t c = 0; c < 3; ++c) {
            std::uint8_t& value = rgb_[3 * pixel + c];
            const float mixed = value + opacity * (255.0F * rgba[static_cast<int>(c)] - value);
            value = static_cast<std::uint8_t>(std::lround(std::clamp(mixed, 0.0F, 255.0F)));
        }
    }

    const View& view_;
    const std::vector<float>& depth_;
    std::vector<std::uint8_t>& rgb_;
};

}  // namespace

void paintOverlay(const Overlay& overlay, const View& view, const std::vector<float>& depth_m,
                  double pixel_scale, std::vector<std::uint8_t>& rgb) {
    Painter painter(view, depth_m, rgb);
    for (const OverlayLine& line : overlay.lines) {
        painter.line(line.a, line.b, line.rgba, line.width_px * pixel_scale);
    }
    for (const OverlayMark& mark : overlay.marks) painter.mark(mark, pixel_scale);
}

}  // namespace dollytrack::render
