#include "render/overlays/overlay_painter.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dollytrack::render {
namespace {

constexpr float kThroughSurfaces = 0.22F;   // opacity of hidden elements
constexpr double kBias = 0.01;              // relative to depth; draws lines on a surface in front
                                            // of it
constexpr double kOrthographicBias = 0.02;  // m; the same for orthographic views, where depth is
                                            // independent of size

/// A capsule on the screen: its axis and, at both ends, a quantity that is linear on the screen:
/// the inverse depth, or in an orthographic view the depth itself.
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

    void line(const OverlayLine& line, double scale) {
        Eigen::Vector3d a = view_.pose.toCamera(line.a);
        Eigen::Vector3d b = view_.pose.toCamera(line.b);
        if (a.z() < view_.near_m && b.z() < view_.near_m) return;
        if (a.z() < view_.near_m) a = cutNear(b, a);
        if (b.z() < view_.near_m) b = cutNear(a, b);
        const Stroke whole{view_.project(a),
                           view_.project(b),
                           linear(a.z()),
                           linear(b.z()),
                           0.5 * line.width_px * scale,
                           line.rgba};
        const double length = (whole.b - whole.a).norm();
        const double dash = line.dash_px * scale;
        if (dash <= 0.0 || length <= 0.0) {
            paint(whole);
            return;
        }
        for (double begin = 0.0; begin < length; begin += 2.0 * dash) {
            paint(part(whole, begin / length, std::min(1.0, (begin + dash) / length)));
        }
    }

    void mark(const OverlayMark& mark, double scale) {
        const Eigen::Vector3d p = view_.pose.toCamera(mark.at);
        if (p.z() < view_.near_m) return;
        const Eigen::Vector2d at = view_.project(p);
        const double half = 0.5 * mark.size_px * scale;
        const auto stroke = [&](const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                                double radius) {
            paint({at + from, at + to, linear(p.z()), linear(p.z()), radius, mark.rgba});
        };
        switch (mark.shape) {
            case OverlayMark::Shape::Dot:
                stroke({0, 0}, {0, 0}, half);
                break;
            case OverlayMark::Shape::Cross:
                stroke({-half, half}, {half, -half}, 0.25 * half);
                stroke({-half, -half}, {half, half}, 0.25 * half);
                break;
            case OverlayMark::Shape::Square:
                outline(stroke, 0.75 * half, 4);
                break;
            case OverlayMark::Shape::Ring:
                outline(stroke, 0.85 * half, 16);
                break;
            case OverlayMark::Shape::Arrow: {
                const Eigen::Vector3d ahead = view_.pose.toCamera(mark.at + 1e-3 * mark.direction);
                Eigen::Vector2d way = view_.project(ahead) - at;
                if (way.norm() < 1e-9) {
                    stroke({0, 0}, {0, 0}, half);
                    break;
                }
                way *= half / way.norm();
                const Eigen::Vector2d aside(-way.y(), way.x());
                stroke(way, -0.6 * way + 0.7 * aside, 0.2 * half);
                stroke(way, -0.6 * way - 0.7 * aside, 0.2 * half);
                break;
            }
        }
    }

  private:
    /// Converts depth to the quantity that is linear on the screen, and back.
    [[nodiscard]] double linear(double depth) const {
        return view_.orthographic ? depth : 1.0 / depth;
    }

    /// A regular polygon of straight strokes; with four, its sides are level and upright.
    template <class Draw>
    static void outline(Draw&& draw, double radius, int corners) {
        const auto corner = [&](int i) {
            const double angle = (2.0 * i + 1.0) * std::numbers::pi / corners;
            const double reach = radius / std::cos(std::numbers::pi / corners);
            return Eigen::Vector2d(reach * std::cos(angle), reach * std::sin(angle));
        };
        for (int i = 0; i < corners; ++i) draw(corner(i), corner(i + 1), 0.2 * radius);
    }

    [[nodiscard]] static Stroke part(const Stroke& whole, double begin, double end) {
        Stroke result = whole;
        result.a = whole.a + begin * (whole.b - whole.a);
        result.b = whole.a + end * (whole.b - whole.a);
        result.depth_a = whole.depth_a + begin * (whole.depth_b - whole.depth_a);
        result.depth_b = whole.depth_a + end * (whole.depth_b - whole.depth_a);
        return result;
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
    for (const OverlayLine& line : overlay.lines) painter.line(line, pixel_scale);
    for (const OverlayMark& mark : overlay.marks) painter.mark(mark, pixel_scale);
}

}  // namespace dollytrack::render
