#include "render/verify/compare/motion_check.h"

#include <fmt/format.h>

#include <cmath>

namespace dollytrack::verify {
namespace {

constexpr double kTolerance_px = 0.01;

}  // namespace

std::vector<ReprojectedPixel> reprojectAll(const StoredDataset& dataset, FrameImages& images,
                                           const FrameImages::Depth& depth, const OtherView& to) {
    const StoredFrame& from = images.stored();
    const Image16* ids = images.image16("instance");
    const bool moves = !from.moving.empty() || !to.frame.moving.empty();
    std::vector<ReprojectedPixel> reprojected(depth.metres.values.size());
    std::size_t i = 0;
    for (int y = 0; y < depth.metres.height; ++y) {
        for (int x = 0; x < depth.metres.width; ++x, ++i) {
            const double metres = depth.metres.values[i];
            if (!(metres > 0.0)) continue;
            const Eigen::Isometry3d motion =
                moves && ids ? to.motion(from, ids->values[i]) : Eigen::Isometry3d::Identity();
            reprojected[i] = reproject(dataset, from, x, y, metres, depth.rounding_m, to, motion);
        }
    }
    return reprojected;
}

void checkMotions(const ImageF& motions, const FrameImages::Depth& depth,
                  const std::vector<ReprojectedPixel>& reprojected, const MotionFile& file,
                  Findings& findings) {
    WrongPixels pixels;
    std::size_t i = 0;
    for (int y = 0; y < motions.height; ++y) {
        for (int x = 0; x < motions.width; ++x, ++i) {
            const float* uv = motions.pixel(x, y);
            const bool unknown =
                std::abs(uv[0]) > kUnknownMotion || std::abs(uv[1]) > kUnknownMotion;
            const bool nothing = !(depth.metres.values[i] > 0.0F);
            const auto found = [&] {
                return unknown ? std::string("no motion")
                               : fmt::format("({:.4g}, {:.4g}) px", uv[0], uv[1]);
            };
            if (nothing) {
                if (!unknown) {
                    pixels.add(x, y, [&] {
                        return WrongPixels::Text{found(), "no motion, because nothing is visible"};
                    });
                }
                continue;
            }
            const ReprojectedPixel& to = reprojected[i];
            // Points behind the other camera have no position in its image.
            if (to.behind) continue;
            const Eigen::Vector2d expected = to.at - Eigen::Vector2d(x + 0.5, y + 0.5);
            const double longest = expected.cwiseAbs().maxCoeff() + to.off_px + kTolerance_px;
            if (unknown && (to.may_be_behind || longest >= file.largest_px)) continue;
            const double off = (Eigen::Vector2d(uv[0], uv[1]) - expected).norm();
            // Single precision stores long motions only to about 1e-7 of their length.
            const double allowed =
                kTolerance_px + file.rounding_px + to.off_px + 1e-6 * expected.norm();
            if (!unknown && off <= allowed) continue;
            pixels.add(x, y, [&] {
                return WrongPixels::Text{
                    found(), fmt::format("({:.4f}, {:.4f}) px, by depth and poses", expected.x(),
                                         expected.y())};
            });
        }
    }
    pixels.report(file.name, file.frame, findings);
}

}  // namespace dollytrack::verify
