#include "render/verify/check/check_list.h"
#include "render/verify/compare/other_view.h"
#include "render/verify/compare/stereo_pair.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace dollytrack::verify {
namespace {

/// One frame's stereo pair.
class StereoPair {
  public:
    StereoPair(const Subject& subject, FrameImages& images, double baseline_m)
        : subject_(subject),
          images_(images),
          focal_times_baseline_(subject.dataset.lens.fx * baseline_m),
          right_{rightOf(images.stored().pose, baseline_m), images.stored()} {}

    void check(Findings& findings) {
        const FrameImages::Depth* depth = images_.depth();
        if (depth) {
            reprojectAll(*depth);
            if (const Image16* disparity = images_.image16("disparity")) {
                checkDisparity(*disparity, *depth, findings);
            }
            checkMask(*depth, findings);
            checkColours(*depth, findings);
        }
        if (subject_.rays) checkRightDepth(findings);
    }

  private:
    [[nodiscard]] std::string file(std::string_view modality) const {
        return imageFile(modality, images_.frame());
    }

    void reprojectAll(const FrameImages::Depth& depth) {
        reprojected_.resize(depth.metres.values.size());
        std::size_t i = 0;
        for (int y = 0; y < depth.metres.height; ++y) {
            for (int x = 0; x < depth.metres.width; ++x, ++i) {
                const double metres = depth.metres.values[i];
                if (!(metres > 0.0)) continue;
                reprojected_[i] =
                    reproject(subject_.dataset, images_.stored(), x, y, metres, depth.rounding_m,
                              right_, Eigen::Isometry3d::Identity());
            }
        }
    }

    /// KITTI disparity: 256 steps per pixel, 0 for no surface and beyond 16 bits.
    void checkDisparity(const Image16& disparity, const FrameImages::Depth& depth,
                        Findings& findings) const {
        WrongPixels pixels;
        std::size_t i = 0;
        for (int y = 0; y < disparity.height; ++y) {
            for (int x = 0; x < disparity.width; ++x, ++i) {
                const int found = disparity.values[i];
                const double metres = depth.metres.values[i];
                double least = 0.0, most = 0.0;
                if (metres > 0.0) {
                    const double rounding = std::min(depth.rounding_m, 0.5 * metres);
                    least = 256.0 * focal_times_baseline_ / (metres + rounding) - 0.51;
                    most = 256.0 * focal_times_baseline_ / (metres - rounding) + 0.51;
                }
                const bool may_be_none = metres <= 0.0 || least < 1.0 || most > 65535.0;
                if (found == 0 ? may_be_none : found >= least && found <= most) continue;
                pixels.add(x, y, [&] {
                    return WrongPixels::Text{
                        fmt::format("{:.3f} px", found / 256.0),
                        metres > 0.0
                            ? fmt::format("{:.3f} px, by the depth", focal_times_baseline_ / metres)
                            : std::string("none, because nothing is visible")};
                });
            }
        }
        pixels.report(file("disparity"), images_.frame(), findings);
    }

    void checkMask(const FrameImages::Depth& depth, Findings& findings) {
        const Image8* mask = images_.mask("disparity");
        if (!mask) return;
        FrameImages::Depth right;
        if (const Image16* rounded = images_.image16("depth_right")) {
            right.metres = {rounded->width, rounded->height, 1, {}};
            for (const std::uint16_t value : rounded->values) {
                right.metres.values.push_back(static_cast<float>(value * 0.001));
            }
            right.rounding_m = 0.0005 + 1e-6;
        }
        checkVisibilityMask(
            subject_, *mask, depth, reprojected_, right_,
            right.metres.values.empty() ? nullptr : &right,
            {fmt::format("disparity/{:06}_mask.png", images_.frame()), images_.frame()}, findings);
    }

    /// Surfaces visible in both images have the same colour in most pixels. Highlights, and
    /// shading near the image border, which depends on the neighbourhood, may differ.
    void checkColours(const FrameImages::Depth& depth, Findings& findings) {
        const Image8* left = images_.image8("rgb");
        const Image8* right = images_.image8("rgb_right");
        const Image8* mask = images_.mask("disparity");
        if (!left || !right || !mask) return;
        WrongPixels pixels;
        std::size_t seen = 0;
        for (std::size_t i = 0; i < depth.metres.values.size(); ++i) {
            if (!(depth.metres.values[i] > 0.0F) || mask->values[i] != kSeen) continue;
            const ReprojectedPixel& to = reprojected_[i];
            const int x = static_cast<int>(std::floor(to.at.x()));
            const int y = static_cast<int>(std::floor(to.at.y()));
            if (to.behind || !right->holds(x - 1, y - 1) || !right->holds(x + 1, y + 1)) continue;
            ++seen;
            const int at_x = static_cast<int>(i) % left->width;
            const int at_y = static_cast<int>(i) / left->width;
            const int apart = leastDifference(left->pixel(at_x, at_y), *right, x, y);
            if (apart <= kAlike) continue;
            pixels.add(at_x, at_y, [&] {
                return WrongPixels::Text{
                    fmt::format("a colour {} of 255 away from that of pixel ({}, {}) in {}", apart,
                                x, y, file("rgb_right")),
                    "the same surface"};
            });
        }
        if (pixels.count() > 20 + seen / 4) pixels.report(file("rgb"), images_.frame(), findings);
    }

    static constexpr int kAlike = 16;  // of 255; edges are antialiased in each image separately

    static int leastDifference(const std::uint8_t* colour, const Image8& image, int x, int y) {
        int least = 255;
        for (int dy = -1; dy <= 1; ++dy) {
            for (int dx = -1; dx <= 1; ++dx) {
                const std::uint8_t* other = image.pixel(x + dx, y + dy);
                int most = 0;
                for (int c = 0; c < 3; ++c) most = std::max(most, std::abs(colour[c] - other[c]));
                least = std::min(least, most);
            }
        }
        return least;
    }

    void checkRightDepth(Findings& findings) {
        const Image16* depth = images_.image16("depth_right");
        if (!depth) return;
        FrameRays rays(subject_, images_.stored(), right_.camera);
        std::vector<RayHit> hits;
        WrongPixels pixels;
        constexpr double kRounding = 0.0005 + 1e-6;
        for (int y = 0; y < depth->height; ++y) {
            rays.castRow(y, hits);
            for (int x = 0; x < depth->width; ++x) {
                const RayHit& hit = hits[x];
                const double metres = depth->at(x, y) * 0.001;
                const bool none = hit.object_id == 0 || hit.distance > FrameRays::kFarthest;
                const double allowed = kRounding + FrameRays::kDrawing * (1.0 + metres);
                if (none ? metres == 0.0 : std::abs(hit.distance - metres) <= allowed) continue;
                if (rays.mayShowDepth(x, y, metres, kRounding)) continue;
                pixels.add(x, y, [&] {
                    return WrongPixels::Text{fmt::format("{:.3f} m", metres),
                                             fmt::format("{:.4f} m", none ? 0.0 : hit.distance)};
                });
            }
        }
        pixels.report(file("depth_right"), images_.frame(), findings);
    }

    const Subject& subject_;
    FrameImages& images_;
    double focal_times_baseline_;
    OtherView right_;
    std::vector<ReprojectedPixel> reprojected_;
};

}  // namespace

CheckWork beginStereo(const Subject& subject, Findings& findings) {
    const std::optional<double> baseline = baselineOf(subject.dataset);
    if (!baseline || !(*baseline > 0.0)) {
        findings.add({"dataset.json",
                      {},
                      {},
                      "no baseline_m in the conventions",
                      "that of the stereo pair"});
        return {};
    }
    CheckWork work;
    work.frame = [&subject, baseline](FrameImages& images, Findings& found) {
        StereoPair(subject, images, *baseline).check(found);
    };
    return work;
}

}  // namespace dollytrack::verify
