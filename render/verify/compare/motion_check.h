#pragma once

#include "render/verify/compare/other_view.h"

#include <limits>
#include <string>
#include <vector>

namespace dollytrack::verify {

/// Larger components mean that the motion is unknown, as in Middlebury's files.
inline constexpr double kUnknownMotion = 1e9;

/// Origin and precision of a file's motions.
struct MotionFile {
    std::string name;
    int frame = 0;
    double rounding_px = 0.0;  // largest rounding error of a component
    double largest_px = std::numeric_limits<double>::infinity();  // longer motions are stored as
                                                                  // unknown
};

/// Reprojects all pixels with depth into another frame. Entries of other pixels are meaningless.
std::vector<ReprojectedPixel> reprojectAll(const StoredDataset& dataset, FrameImages& images,
                                           const FrameImages::Depth& depth, const OtherView& to);

/// Compares motions (two channels, px right and down) with those computed from depth and poses.
void checkMotions(const ImageF& motions, const FrameImages::Depth& depth,
                  const std::vector<ReprojectedPixel>& reprojected, const MotionFile& file,
                  Findings& findings);

/// Problem with reading an image or with its size; empty if none.
template <class Read>
std::string problemOf(const Read& image, const Intrinsics& lens) {
    if (!image) return image.error().message;
    if (image->width == lens.width && image->height == lens.height) return {};
    return "it is " + std::to_string(image->width) + " x " + std::to_string(image->height) + " px";
}

/// Reports such a problem as a finding. Returns whether the image is usable.
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
