#include "render/rig/rig_pictures.h"

#include "engine/jobs/parallel.h"
#include "engine/scene/srgb.h"
#include "render/draw/crack_filling.h"
#include "render/light/tone_curve.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

namespace dollytrack::render {
namespace {

// Tangent at which a cube side ends: 5 degrees beyond its edge, over which sides blend.
constexpr double kReach = 1.2;
// Largest size of a doubled side, to bound graphics memory.
constexpr int kFinest_px = 2048;
// Up to this half angle, radians, one pinhole image covers the lens without much waste at its
// border.
constexpr double kAlone = 50.0 * std::numbers::pi / 180.0;

const std::array<float, 256>& linearOfBytes() {
    static const std::array<float, 256> table = [] {
        std::array<float, 256> values{};
        for (std::size_t i = 0; i < values.size(); ++i) {
            values[i] = linearFromSrgb(static_cast<float>(i) / 255.0F);
        }
        return values;
    }();
    return table;
}

/// A pinhole image with its pixels.
struct DrawnSide {
    LensPictures::Side side;
    Eigen::Matrix3d side_from_camera;
    std::vector<std::uint8_t> rgb;

    /// Position of a camera direction in the image, px, and its blending weight (0: outside).
    struct Place {
        double x = 0.0, y = 0.0, weight = 0.0;
    };
    [[nodiscard]] Place placeOf(const Eigen::Vector3d& in_camera) const {
        const Eigen::Vector3d d = side_from_camera * in_camera;
        if (!(d.z() > 0.0)) return {};
        const double u = d.x() / d.z(), v = d.y() / d.z();
        const double far = std::max(std::abs(u), std::abs(v));
        if (far >= side.reach) return {};
        const double px = 0.5 * side.size_px / side.reach;
        return {px * (u + side.reach), px * (v + side.reach), weightAt(far)};
    }

    /// Bilinearly interpolated linear light.
    [[nodiscard]] Eigen::Vector3f at(double x, double y) const {
        const int last = side.size_px - 1;
        const double left = std::clamp(x - 0.5, 0.0, static_cast<double>(last));
        const double top = std::clamp(y - 0.5, 0.0, static_cast<double>(last));
        const int x0 = static_cast<int>(left), y0 = static_cast<int>(top);
        const int x1 = std::min(x0 + 1, last), y1 = std::min(y0 + 1, last);
        const auto right = static_cast<float>(left - x0), below = static_cast<float>(top - y0);
        return (1.0F - below) * ((1.0F - right) * pixel(x0, y0) + right * pixel(x1, y0)) +
               below * ((1.0F - right) * pixel(x0, y1) + right * pixel(x1, y1));
    }

  private:
    /// Smooth blending weight: 1 up to the tangent 1 / reach, where the overlapping side ends, 0 at
    /// `reach`.
    [[nodiscard]] double weightAt(double far) const {
        if (side.alone) return 1.0;
        const double least = 1.0 / side.reach;
        const double share = std::clamp((side.reach - far) / (side.reach - least), 0.0, 1.0);
        return share * share * (3.0 - 2.0 * share);
    }
    [[nodiscard]] Eigen::Vector3f pixel(int x, int y) const {
        const std::uint8_t* c = &rgb[3 * (static_cast<std::size_t>(y) * side.size_px + x)];
        const auto& linear = linearOfBytes();
        return {linear[c[0]], linear[c[1]], linear[c[2]]};
    }
};

/// Visits a grid of the lens's ray directions, including the image border and the image circle.
template <class Use>
void forSomeRays(const LensModel& lens, Use&& use) {
    constexpr int kSteps = 64;
    for (int row = 0; row <= kSteps; ++row) {
        for (int column = 0; column <= kSteps; ++column) {
            const auto ray = lens.ray(lens.width() * static_cast<double>(column) / kSteps,
                                      lens.height() * static_cast<double>(row) / kSteps);
            if (ray) use(ray->direction);
        }
    }
    for (int i = 0; i < 8 * kSteps; ++i) {  // edge of the image circle
        const double way = i * std::numbers::pi / (4 * kSteps);
        const double r = 0.5 * lens.width() * (1.0 - 1e-9);
        const auto ray = lens.ray(0.5 * lens.width() + r * std::cos(way),
                                  0.5 * lens.height() + r * std::sin(way));
        if (ray) use(ray->direction);
    }
}

}  // namespace

View viewThrough(const LensModel& lens, const Pose& pose, double near_m) {
    View view;
    view.intrinsics = {lens.width(), lens.height(),      lens.focal(),
                       lens.focal(), 0.5 * lens.width(), 0.5 * lens.height()};
    view.pose = pose;
    view.near_m = near_m;
    if (lens.lens() == Lens::Orthographic) {
        view.orthographic.emplace();
        view.orthographic->px_per_m = lens.focal();
    }
    return view;
}

LensPictures::LensPictures(double near_m, const PictureParams& look,
                           const Eigen::Quaterniond& sides_from_camera)
    : near_m_(near_m), look_(look), sides_from_camera_(sides_from_camera) {}

std::vector<LensPictures::Side> LensPictures::sidesFor(const LensModel& lens) const {
    const double finest = lens.mostPxPerRadian();
    const auto sizeFor = [&](double reach) {
        return 2 * static_cast<int>(std::ceil(finest * reach)) + 2;
    };
    if (lens.widest() <= kAlone) {
        const double reach = std::tan(lens.widest()) + 2.0 / finest;
        return {{Eigen::Quaterniond::Identity(), reach, sizeFor(reach), true}};
    }
    constexpr double kRight = 0.5 * std::numbers::pi;
    const auto turned = [](double angle, const Eigen::Vector3d& axis) {
        return Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis));
    };
    const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY();
    std::vector<Side> sides;
    for (const Eigen::Quaterniond& way :
         {turned(0.0, y), turned(kRight, y), turned(2 * kRight, y), turned(-kRight, y),
          turned(kRight, x), turned(-kRight, x)}) {
        Side side{sides_from_camera_.conjugate() * way, kReach, sizeFor(kReach), false};
        const DrawnSide probe{side, side.camera_from_side.toRotationMatrix().transpose(), {}};
        bool shows = false;
        forSomeRays(lens, [&](const Eigen::Vector3d& direction) {
            shows = shows || probe.placeOf(direction).weight > 0.0;
        });
        if (!shows) continue;
        // Around the poles each row is stretched, so single pixels of the side would be visible.
        if (lens.lens() == Lens::Equirectangular &&
            (probe.placeOf(y).weight > 0.0 || probe.placeOf(-y).weight > 0.0)) {
            side.finer = true;
            side.size_px = std::max(side.size_px, std::min(2 * side.size_px, kFinest_px));
        }
        sides.push_back(side);
    }
    return sides;
}

Result<RenderTarget*> LensPictures::targetOf(int width, int height) {
    auto target = targets_.find({width, height});
    if (target == targets_.end()) {
        Result<RenderTarget> created = RenderTarget::create(width, height);
        if (!created) return tl::unexpected(created.error());
        target = targets_.emplace(std::pair(width, height), std::move(*created)).first;
    }
    return &target->second;
}

Status LensPictures::prepare(const LensModel& lens) {
    const auto makeTarget = [&](int width, int height) {
        return targetOf(width, height).map([](RenderTarget*) {});
    };
    if (!lens.measuresRange()) return makeTarget(lens.width(), lens.height());
    for (const Side& side : sidesFor(lens)) {
        if (Status status = makeTarget(side.size_px, side.size_px); !status) return status;
    }
    return {};
}

Status LensPictures::drawView(const View& view, SceneRenderer& renderer, const RayCaster& rays,
                              std::vector<std::uint8_t>& rgb) {
    const Result<RenderTarget*> target = targetOf(view.intrinsics.width, view.intrinsics.height);
    if (!target) return tl::unexpected(target.error());
    if (Status status = renderer.draw(view, **target); !status) return status;
    std::vector<std::uint16_t> ids;
    (*target)->readIds(ids);
    (*target)->readRgb(rgb);
    fillCrackColours(findCracks(view, ids, rays), rgb);
    return {};
}

Status LensPictures::draw(const LensModel& lens, const Pose& pose, SceneRenderer& renderer,
                          const RayCaster& rays, std::vector<std::uint8_t>& rgb) {
    if (!lens.measuresRange()) {
        View view = viewThrough(lens, pose, near_m_);
        view.antialias = look_.antialias;
        view.reflections = look_.reflections;
        return drawView(view, renderer, rays, rgb);
    }
    std::vector<DrawnSide> drawn;
    for (const Side& side : sidesFor(lens)) {
        DrawnSide& one = drawn.emplace_back(
            DrawnSide{side, side.camera_from_side.toRotationMatrix().transpose(), {}});
        View view;
        const double middle = 0.5 * side.size_px;
        const double focal = middle / side.reach;
        view.intrinsics = {side.size_px, side.size_px, focal, focal, middle, middle};
        view.pose = {pose.position, pose.rotation * side.camera_from_side};
        // The near plane is moved closer, so that it does not cut anything in the image corners.
        view.near_m = near_m_ / std::sqrt(1.0 + 2.0 * side.reach * side.reach);
        view.antialias = look_.antialias;
        view.reflections = look_.reflections;
        if (Status status = drawView(view, renderer, rays, one.rgb); !status) return status;
    }
    const std::size_t width = lens.width();
    rgb.assign(3 * width * static_cast<std::size_t>(lens.height()), 0);
    const auto fillRows = [&](std::size_t begin, std::size_t end) {
        for (std::size_t pixel = begin * width; pixel < end * width; ++pixel) {
            const auto rayAt = [&](double below) {
                return lens.ray(static_cast<double>(pixel % width) + 0.5,
                                static_cast<double>(pixel / width) + below);
            };
            const std::optional<LensRay> ray = rayAt(0.5);
            if (!ray) continue;
            Eigen::Vector3f light = Eigen::Vector3f::Zero();
            double weights = 0.0;
            const auto add = [&](const DrawnSide& side, const Eigen::Vector3d& direction,
                                 double share) {
                const DrawnSide::Place place = side.placeOf(direction);
                if (!(place.weight > 0.0)) return;
                light += static_cast<float>(share * place.weight) * side.at(place.x, place.y);
                weights += share * place.weight;
            };
            for (const DrawnSide& side : drawn) {
                if (!side.side.finer) {
                    add(side, ray->direction, 1.0);
                    continue;
                }
                for (const double below : {0.25, 0.75}) add(side, rayAt(below)->direction, 0.5);
            }
            if (!(weights > 0.0)) continue;
            light /= static_cast<float>(weights);
            for (int c = 0; c < 3; ++c) {
                rgb[3 * pixel + static_cast<std::size_t>(c)] = encodedByte(light[c]);
            }
        }
    };
    parallelRanges(static_cast<std::size_t>(lens.height()), 8, fillRows);
    return {};
}

}  // namespace dollytrack::render
