#include "render/verify/compare/other_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace dollytrack::verify {
namespace {

/// A surface less than this in front of a point counts as the point's own.
constexpr double kSameSurface_m = 0.002;

const char* name(int sight) {
    switch (sight) {
        case kSeen:
            return "seen";
        case kOccluded:
            return "occluded";
        case kOutside:
            return "outside";
        case kNothing:
            return "nothing";
        default:
            return "not a mask value";
    }
}

/// Whether a point may be inside and may be outside the image, within `off_px`.
struct Sides {
    bool may_be_inside = false, may_be_outside = false;
};

Sides sidesOf(const StoredDataset& dataset, const ReprojectedPixel& one) {
    constexpr double kNear_m = 0.002;  // uncertainty at the near plane
    if (one.behind) return {one.depth_m > dataset.near_m - kNear_m, true};
    const double off = one.off_px + 1e-3;
    const Intrinsics& lens = dataset.lens;
    const auto inside = [&](double margin) {
        return one.at.x() >= margin && one.at.y() >= margin && one.at.x() < lens.width - margin &&
               one.at.y() < lens.height - margin;
    };
    Sides sides{inside(-off), !inside(off)};
    // The near plane cuts as sharply as the image border.
    if (one.depth_m < dataset.near_m + kNear_m) sides.may_be_outside = true;
    return sides;
}

WrongPixels::Text wrong(int found, const char* expected) {
    return {fmt::format("{} ({})", name(found), found), expected};
}

/// The other image's depth at a subpixel position, if the four pixels around it lie on one smooth
/// surface; elsewhere that image alone cannot decide visibility.
std::optional<double> smoothDepthAt(const ImageF& depth, const Eigen::Vector2d& at) {
    const int x = static_cast<int>(std::floor(at.x() - 0.5));
    const int y = static_cast<int>(std::floor(at.y() - 0.5));
    // One more pixel on each side, to test smoothness.
    if (!depth.holds(x - 1, y - 1) || !depth.holds(x + 2, y + 2)) return std::nullopt;
    const auto inverse = [&](int dx, int dy) {
        const double metres = depth.at(x + dx, y + dy);
        return metres > 0.0 ? 1.0 / metres : std::numeric_limits<double>::quiet_NaN();
    };
    const double here = inverse(0, 0);
    // On a plane the inverse depth is linear in the image.
    constexpr double kBend = 0.001;  // relative to depth
    for (int i = 0; i < 2; ++i) {
        for (int k = -1; k <= 2; ++k) {
            const double bend_x = inverse(i - 1, k) - 2.0 * inverse(i, k) + inverse(i + 1, k);
            const double bend_y = inverse(k, i - 1) - 2.0 * inverse(k, i) + inverse(k, i + 1);
            if (!(std::abs(bend_x) < kBend * here && std::abs(bend_y) < kBend * here)) {
                return std::nullopt;
            }
        }
    }
    const double fx = at.x() - 0.5 - x;
    const double fy = at.y() - 0.5 - y;
    const double top = (1.0 - fx) * here + fx * inverse(1, 0);
    const double bottom = (1.0 - fx) * inverse(0, 1) + fx * inverse(1, 1);
    return 1.0 / ((1.0 - fy) * top + fy * bottom);
}

/// Compares by the depth of both images. A surface seen through a slit narrower than a pixel may be
/// visible although the other image misses the slit; such pixels lie at edges of this image and are
/// skipped.
void compareMaskWithDepth(const Image8& mask, const std::vector<ReprojectedPixel>& reprojected,
                          const std::vector<int>& inside, const FrameImages::Depth& own,
                          const FrameImages::Depth& other, WrongPixels& pixels) {
    for (const int i : inside) {
        const ReprojectedPixel& one = reprojected[i];
        const std::optional<double> surface = smoothDepthAt(other.metres, one.at);
        if (!surface) continue;
        const int x = i % mask.width;
        const int y = i / mask.width;
        if (!smoothDepthAt(own.metres, {x + 0.5, y + 0.5})) continue;
        const double slack =
            kSameSurface_m + own.rounding_m + other.rounding_m + 0.003 * one.depth_m;
        const int found = mask.values[i];
        const double before = one.depth_m - *surface;
        if (found == kOccluded && std::abs(before) < 0.001) {
            pixels.add(x, y, [&] { return wrong(found, "visible, by the other image's depth"); });
        } else if (found == kSeen && before > 3.0 * slack) {
            pixels.add(x, y, [&] { return wrong(found, "occluded, by the other image's depth"); });
        }
    }
}

/// Appends the wrong ones of the points `inside` the image, by ray casts.
void addWrongByRays(const Subject& subject, std::span<const std::uint8_t> found,
                    const std::vector<ReprojectedPixel>& points,
                    const std::vector<std::size_t>& inside, double rounding_m, const OtherView& to,
                    std::vector<WrongVisibility>& wrong) {
    FrameRays rays(subject, to.frame, to.camera);
    std::vector<Eigen::Vector3d> places;
    for (const std::size_t i : inside) places.push_back(points[i].place);
    std::vector<RayHit> hits;
    rays.castTo(places, hits);
    for (std::size_t k = 0; k < inside.size(); ++k) {
        const ReprojectedPixel& one = points[inside[k]];
        const double slack = 2.0 * rounding_m + FrameRays::kDrawing * (1.0 + one.depth_m);
        const double same = one.depth_m - kSameSurface_m;
        const double first = hits[k].object_id == 0 ? one.depth_m : hits[k].distance;
        const bool wrong_seen = found[inside[k]] == kSeen && first < same - slack;
        const bool wrong_occluded = found[inside[k]] == kOccluded && first > same + slack;
        if (!wrong_seen && !wrong_occluded) continue;
        // At an edge, a ray slightly beside the point may give the other answer.
        const double off = (one.off_px + 0.01) * one.depth_m / subject.dataset.lens.fx;
        std::vector<Eigen::Vector3d> near;
        for (const double dx : {-off, 0.0, off}) {
            for (const double dy : {-off, 0.0, off}) {
                near.push_back(one.place + to.camera.rotation * Eigen::Vector3d(dx, dy, 0.0));
            }
        }
        std::vector<RayHit> around;
        rays.castTo(near, around);
        const bool may_be = std::any_of(around.begin(), around.end(), [&](const RayHit& hit) {
            const double depth = hit.object_id == 0 ? one.depth_m : hit.distance;
            return wrong_seen ? depth >= same - slack : depth <= same + slack;
        });
        using Expected = WrongVisibility::Expected;
        if (!may_be) {
            wrong.push_back({inside[k], wrong_seen ? Expected::Occluded : Expected::Seen});
        }
    }
}

const char* expectedInMask(WrongVisibility::Expected expected) {
    switch (expected) {
        case WrongVisibility::Expected::Seen:
            return "seen";
        case WrongVisibility::Expected::Occluded:
            return "occluded";
        case WrongVisibility::Expected::Inside:
            return "inside the other image";
        default:
            return "outside the other image (2)";
    }
}

}  // namespace

Eigen::Isometry3d OtherView::motion(const StoredFrame& from, int object_id) const {
    const Eigen::Isometry3d* before = from.movement(object_id);
    const Eigen::Isometry3d* after = frame.movement(object_id);
    Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
    if (after) result = *after;
    if (before) result = result * before->inverse();
    return result;
}

ReprojectedPixel reproject(const StoredDataset& dataset, const StoredFrame& from, int x, int y,
                           double metres, double rounding_m, const OtherView& to,
                           const Eigen::Isometry3d& motion) {
    const Eigen::Vector3d along = dataset.lens.unproject(x + 0.5, y + 0.5);
    const auto in_other = [&](double depth) -> Eigen::Vector3d {
        return to.camera.toCamera(motion * from.pose.toWorld(depth * along));
    };
    ReprojectedPixel reprojected;
    reprojected.place = motion * from.pose.toWorld(metres * along);
    const Eigen::Vector3d there = to.camera.toCamera(reprojected.place);
    reprojected.depth_m = there.z();
    reprojected.behind = there.z() < dataset.near_m;
    if (reprojected.behind) return reprojected;
    reprojected.at = dataset.lens.project(there);
    for (const double depth : {metres - rounding_m, metres + rounding_m}) {
        const Eigen::Vector3d beside = in_other(depth);
        if (beside.z() < dataset.near_m + 1e-6) reprojected.may_be_behind = true;
        if (beside.z() <= 1e-6) continue;
        reprojected.off_px =
            std::max(reprojected.off_px, (dataset.lens.project(beside) - reprojected.at).norm());
    }
    return reprojected;
}

std::vector<WrongVisibility> wrongVisibilities(const Subject& subject,
                                               std::span<const std::uint8_t> found,
                                               const std::vector<ReprojectedPixel>& points,
                                               double rounding_m, const OtherView& to) {
    std::vector<WrongVisibility> wrong;
    std::vector<std::size_t> inside;  // points that may lie inside the image
    for (std::size_t i = 0; i < found.size(); ++i) {
        if (found[i] != kSeen && found[i] != kOccluded && found[i] != kOutside) continue;
        const Sides sides = sidesOf(subject.dataset, points[i]);
        if (found[i] == kOutside ? !sides.may_be_outside : !sides.may_be_inside) {
            wrong.push_back({i, found[i] == kOutside ? WrongVisibility::Expected::Inside
                                                     : WrongVisibility::Expected::Outside});
        } else if (found[i] != kOutside) {
            inside.push_back(i);
        }
    }
    if (subject.rays) addWrongByRays(subject, found, points, inside, rounding_m, to, wrong);
    return wrong;
}

void checkVisibilityMask(const Subject& subject, const Image8& mask,
                         const FrameImages::Depth& depth,
                         const std::vector<ReprojectedPixel>& reprojected, const OtherView& to,
                         const FrameImages::Depth* other_depth, const VisibilityMaskFile& file,
                         Findings& findings) {
    WrongPixels pixels;
    std::vector<std::uint8_t> compared = mask.values;
    std::vector<int> inside;
    const auto add = [&](std::size_t i, const char* expected) {
        const int pixel = static_cast<int>(i);
        pixels.add(pixel % mask.width, pixel / mask.width,
                   [&] { return wrong(mask.values[i], expected); });
    };
    for (std::size_t i = 0; i < mask.values.size(); ++i) {
        const int found = mask.values[i];
        const bool nothing = !(depth.metres.values[i] > 0.0F);
        if (nothing || found == kNothing) {
            compared[i] = kNothing;
            if (nothing == (found == kNothing)) continue;
            add(i, nothing ? "nothing (255)" : "the state of the surface");
        } else if (found == kSeen || found == kOccluded) {
            inside.push_back(static_cast<int>(i));
        } else if (found != kOutside) {
            add(i, "0, 1, 2 or 255");
        }
    }
    for (const WrongVisibility& one :
         wrongVisibilities(subject, compared, reprojected, depth.rounding_m, to)) {
        add(one.point, expectedInMask(one.expected));
    }
    if (!subject.rays && other_depth) {
        WrongPixels unlikely;
        compareMaskWithDepth(mask, reprojected, inside, depth, *other_depth, unlikely);
        // An object thinner than a pixel may hide points without showing up in the depth; whole
        // surfaces may not.
        if (unlikely.count() > 5 + inside.size() / 500) {
            unlikely.report(file.name, file.frame, findings);
        }
    }
    pixels.report(file.name, file.frame, findings);
}

}  // namespace dollytrack::verify
