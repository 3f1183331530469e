#include "ui/viewport/false_color.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dollytrack::ui {
namespace {

std::uint8_t byte(float value) {
    return static_cast<std::uint8_t>(std::lround(255.0F * std::clamp(value, 0.0F, 1.0F)));
}

/// From near (0: warm, bright) to far (1: cool, dark), with steadily falling lightness.
Eigen::Vector3f depthColor(float share) {
    static const std::array<Eigen::Vector3f, 5> kStops = {
        Eigen::Vector3f(0.99F, 0.92F, 0.65F), Eigen::Vector3f(0.96F, 0.60F, 0.30F),
        Eigen::Vector3f(0.72F, 0.25F, 0.42F), Eigen::Vector3f(0.33F, 0.14F, 0.45F),
        Eigen::Vector3f(0.08F, 0.06F, 0.20F)};
    const float at = std::clamp(share, 0.0F, 1.0F) * (kStops.size() - 1);
    const auto i = std::min<std::size_t>(static_cast<std::size_t>(at), kStops.size() - 2);
    const float t = at - static_cast<float>(i);
    return (1.0F - t) * kStops[i] + t * kStops[i + 1];
}

/// Normals in the camera frame from depth differences.
Eigen::Vector3f normalColor(const render::FrameRecord& record, const render::View& view, int x,
                            int y) {
    const auto point = [&](int px, int py) -> Eigen::Vector3d {
        px = std::clamp(px, 0, record.width - 1);
        py = std::clamp(py, 0, record.height - 1);
        const float depth = record.depth_m[static_cast<std::size_t>(py) * record.width + px];
        return view.intrinsics.unproject(px + 0.5, py + 0.5) * depth;
    };
    const Eigen::Vector3d across = point(x + 1, y) - point(x - 1, y);
    const Eigen::Vector3d down = point(x, y + 1) - point(x, y - 1);
    Eigen::Vector3d normal = across.cross(down);
    if (normal.norm() < 1e-12) return {0, 0, 0};
    normal.normalize();
    if (normal.z() > 0) normal = -normal;
    return (0.5 * normal + Eigen::Vector3d::Constant(0.5)).cast<float>();
}

/// Colours by class id if the user provided a class table; empty for NYU40.
std::vector<Eigen::Vector3f> colorsOfClasses(const ClassTable& table) {
    if (table.isNyu40()) return {};
    std::vector<Eigen::Vector3f> colors(ClassTable::kLargestId + 1, Eigen::Vector3f::Zero());
    for (const DatasetClass& one : table.classes()) {
        colors[one.id] = Eigen::Vector3f(one.color[0], one.color[1], one.color[2]) / 255.0F;
    }
    return colors;
}

}  // namespace

Eigen::Vector3f colorOfId(int id) {
    if (id <= 0) return {0, 0, 0};
    // Steps by the golden ratio spread hues evenly for any number of ids.
    const double hue = std::fmod(0.61803398875 * id, 1.0) * 6.0;
    const double lightness = 0.55 + 0.15 * ((id / 7) % 3 - 1);
    const double chroma = (1.0 - std::abs(2.0 * lightness - 1.0)) * 0.75;
    const auto channel = [&](double shift) {
        const double k = std::fmod(hue + shift, 6.0);
        const double ramp = std::clamp(std::abs(k - 3.0) - 1.0, 0.0, 1.0);
        return static_cast<float>(lightness + chroma * (ramp - 0.5));
    };
    return {channel(0.0), channel(4.0), channel(2.0)};
}

std::vector<std::uint8_t> falseColor(const render::FrameRecord& record, const render::View& view,
                                     Modality modality) {
    const auto pixels = static_cast<std::size_t>(record.width) * record.height;
    std::vector<std::uint8_t> rgba(4 * pixels, 255);
    const std::vector<Eigen::Vector3f> classes = modality == Modality::Semantic
                                                     ? colorsOfClasses(record.classes())
                                                     : std::vector<Eigen::Vector3f>();
    float farthest = 0.1F;
    for (const float depth : record.depth_m) farthest = std::max(farthest, depth);
    for (std::size_t i = 0; i < pixels; ++i) {
        Eigen::Vector3f color = Eigen::Vector3f::Zero();
        switch (modality) {
            case Modality::Rgb:
                for (int c = 0; c < 3; ++c) rgba[4 * i + c] = record.rgb[3 * i + c];
                continue;
            case Modality::Depth:
                if (record.depth_m[i] > 0) color = depthColor(record.depth_m[i] / farthest);
                break;
            case Modality::Instance:
                color = colorOfId(record.instance[i]);
                break;
            case Modality::Semantic:
                color =
                    classes.empty() ? colorOfId(record.semantic[i]) : classes[record.semantic[i]];
                break;
            case Modality::Normal:
                if (record.depth_m[i] > 0) {
                    color = normalColor(record, view, static_cast<int>(i % record.width),
                                        static_cast<int>(i / record.width));
                }
                break;
        }
        for (int c = 0; c < 3; ++c) rgba[4 * i + c] = byte(color[c]);
    }
    return rgba;
}

}  // namespace dollytrack::ui
