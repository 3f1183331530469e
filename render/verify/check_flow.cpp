#include "render/verify/check_list.h"
#include "render/verify/flow_files.h"
#include "render/verify/other_view.h"

#include <fmt/format.h>

#include <cmath>

namespace dollytrack::verify {
namespace {

constexpr double kTolerance_px = 0.01;
constexpr double kUnknown = 1e9;  // Middlebury: beyond it a motion is not known

/// One file of motions and its mask.
class FlowPair {
  public:
    FlowPair(const Subject& subject, FrameImages& images, FrameImages& other, std::string stem)
        : subject_(subject),
          images_(images),
          other_(other),
          stem_(std::move(stem)),
          to_{other.stored().pose, other.stored()} {}

    void check(Findings& findings) {
        const StoredDataset& dataset = subject_.dataset;
        const Result<ImageF> flow = readFlow(dataset.folder / (stem_ + ".flo"));
        const Result<Image8> mask = readImage8(dataset.folder / (stem_ + "_mask.png"), 1);
        const bool flow_fits = fits(flow, ".flo", findings);
        const bool mask_fits = fits(mask, "_mask.png", findings);
        const FrameImages::Depth* depth = images_.depth();
        if (!depth) return;
        followAll(*depth);
        if (flow_fits) checkMotions(*flow, *depth, findings);
        if (!mask_fits) return;
        checkSight(subject_, *mask, *depth, followed_, to_, other_.depth(),
                   {stem_ + "_mask.png", images_.frame()}, findings);
    }

  private:
    template <class Read>
    bool fits(const Read& image, const char* ending, Findings& findings) const {
        const Intrinsics& lens = subject_.dataset.lens;
        std::string problem;
        if (!image) {
            problem = image.error().message;
        } else if (image->width != lens.width || image->height != lens.height) {
            problem = fmt::format("it is {} x {} px", image->width, image->height);
        }
        if (problem.empty()) return true;
        findings.add({stem_ + ending,
                      images_.frame(),
                      {},
                      problem,
                      fmt::format("{} x {} px", lens.width, lens.height)});
        return false;
    }

    void followAll(const FrameImages::Depth& depth) {
        const StoredFrame& from = images_.stored();
        const Image16* ids = images_.image16("instance");
        const bool moves = !from.moving.empty() || !to_.frame.moving.empty();
        followed_.resize(depth.metres.values.size());
        std::size_t i = 0;
        for (int y = 0; y < depth.metres.height; ++y) {
            for (int x = 0; x < depth.metres.width; ++x, ++i) {
                const double metres = depth.metres.values[i];
                if (!(metres > 0.0)) continue;
                const Eigen::Isometry3d motion =
                    moves && ids ? to_.motion(from, ids->values[i]) : Eigen::Isometry3d::Identity();
                followed_[i] =
                    follow(subject_.dataset, from, x, y, metres, depth.rounding_m, to_, motion);
            }
        }
    }

    void checkMotions(const ImageF& flow, const FrameImages::Depth& depth,
                      Findings& findings) const {
        WrongPixels pixels;
        std::size_t i = 0;
        for (int y = 0; y < flow.height; ++y) {
            for (int x = 0; x < flow.width; ++x, ++i) {
                const float* uv = flow.pixel(x, y);
                const bool unknown = std::abs(uv[0]) > kUnknown || std::abs(uv[1]) > kUnknown;
                const bool nothing = !(depth.metres.values[i] > 0.0F);
                const auto found = [&] { return fmt::format("({:.4g}, {:.4g}) px", uv[0], uv[1]); };
                // What is behind the other camera has no place in its picture.
                if (!nothing && followed_[i].behind) continue;
                if (unknown || nothing) {
                    if (unknown != nothing) {
                        pixels.add(x, y, [&] {
                            return WrongPixels::Text{
                                found(), nothing ? "1e10, as nothing is seen" : "a motion"};
                        });
                    }
                    continue;
                }
                const Followed& to = followed_[i];
                const Eigen::Vector2d expected = to.at - Eigen::Vector2d(x + 0.5, y + 0.5);
                const double off = (Eigen::Vector2d(uv[0], uv[1]) - expected).norm();
                // Single precision ends at a ten-millionth of motions far out of the picture.
                if (off <= kTolerance_px + to.off_px + 1e-6 * expected.norm()) continue;
                pixels.add(x, y, [&] {
                    return WrongPixels::Text{found(),
                                             fmt::format("({:.4f}, {:.4f}) px, by depth and poses",
                                                         expected.x(), expected.y())};
                });
            }
        }
        pixels.report(stem_ + ".flo", images_.frame(), findings);
    }

    const Subject& subject_;
    FrameImages& images_;
    FrameImages& other_;
    std::string stem_;
    OtherView to_;
    std::vector<Followed> followed_;
};

}  // namespace

CheckWork beginFlow(const Subject& subject, Findings& findings) {
    for (const char* const modality : {"flow_forward", "flow_backward"}) {
        if (!subject.dataset.has(modality) || !flowDistances(subject.dataset, modality).empty()) {
            continue;
        }
        findings.add({"dataset.json",
                      {},
                      {},
                      fmt::format("conventions.{} has no distances", modality),
                      "numbers of frames"});
    }
    CheckWork work;
    work.frame = [&subject](FrameImages& images, Findings& found) {
        for (const FlowFile& file : flowFiles(subject.dataset, images.frame())) {
            FlowPair(subject, images, images.other(file.other), file.stem).check(found);
        }
    };
    return work;
}

}  // namespace dollytrack::verify
