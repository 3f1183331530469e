#include "ui/panels/timeline/frame_axis.h"

#include <algorithm>
#include <cmath>

namespace dollytrack::ui {
namespace {

constexpr double kFewestFrames = 8.0;

}  // namespace

FrameAxis::FrameAxis(int count, double left, double right, double first, double shown,
                     double margin)
    : count_(std::max(count, 1)),
      length_(count_ + margin),
      left_(left),
      right_(std::max(right, left + 1.0)),
      first_(first),
      shown_(shown > 0.0 ? shown : length_) {
    clamp();
}

void FrameAxis::clamp() {
    const double most = length_;
    shown_ = std::clamp(shown_, std::min(kFewestFrames, most), most);
    first_ = std::clamp(first_, 0.0, most - shown_);
}

double FrameAxis::xOf(double place) const {
    return left_ + (place - first_) * pixelsPerFrame();
}

double FrameAxis::placeAt(double x) const {
    return first_ + (x - left_) / pixelsPerFrame();
}

int FrameAxis::frameAt(double x) const {
    return std::clamp(static_cast<int>(std::floor(placeAt(x))), 0, count_ - 1);
}

int FrameAxis::endFrame() const {
    // Less than a thousandth of a frame is a rounding error.
    return std::clamp(static_cast<int>(std::ceil(first_ + shown_ - 1e-3)), 1, count_);
}

void FrameAxis::zoom(double x, double factor) {
    const double kept = placeAt(x);
    const double share = (x - left_) / (right_ - left_);
    shown_ *= factor;
    shown_ = std::clamp(shown_, std::min(kFewestFrames, length_), length_);
    first_ = kept - share * shown_;
    clamp();
}

void FrameAxis::pan(double pixels) {
    first_ -= pixels / pixelsPerFrame();
    clamp();
}

void FrameAxis::reveal(int frame) {
    if (frame < first_) first_ = frame;
    if (frame + 1 > first_ + shown_) first_ = frame + 1 - shown_;
    clamp();
}

}  // namespace dollytrack::ui
