#pragma once

#include "render/verify/other_view.h"

#include <limits>
#include <string>
#include <vector>

namespace dollytrack::verify {

/// Beyond it a motion is not known, as Middlebury has it.
inline constexpr double kUnknownMotion = 1e9;

/// Where a file's motions come from, and how exact they are.
struct MotionFile {
    std::string name;
    int frame = 0;
    double rounding_px = 0.0;  // the most that a number of it is off
    double largest_px = std::numeric_limits<double>::infinity();  // longer ones are unknown
};

/// Follows all pixels that have a depth into another frame; the others' entries say nothing.
std::vector<Followed> followAll(const StoredDataset& dataset, FrameImages& images,
                                const FrameImages::Depth& depth, const OtherView& to);

/// Compares motions, two channels right and down, with what depth and poses say.
void checkMotions(const ImageF& motions, const FrameImages::Depth& depth,
                  const std::vector<Followed>& followed, const MotionFile& file,
                  Findings& findings);

/// What is wrong with an image's size, or with reading it; empty when nothing is.
template <class Read>
std::string problemOf(const Read& image, const Intrinsics& lens) {
    if (!image) return image.error().message;
    if (image->width == lens.width && image->height == lens.height) return {};
    return "it is " + std::to_string(image->width) + " x " + std::to_string(image->height) + " px";
}

/// Reports what is wrong; whether nothing is.
template <class Read>
bool isUsable(const Read& image, const StoredDataset& dataset, const std::string& file, int frame,
              Findings& findings) {
    const Intrinsics& lens = dataset.lens;
    std::string problem = problemOf(image, lens);
    if (problem.empty()) return true;
    findings.add({file,
                  frame,
                  {},
                  std::move(problem),
                  std::to_string(lens.width) + " x " + std::to_string(lens.height) + " px"});
    return false;
}

}  // namespace dollytrack::verify
