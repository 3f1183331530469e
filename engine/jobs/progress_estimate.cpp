#include "engine/jobs/progress_estimate.h"

#include <algorithm>

namespace dollytrack {
namespace {

constexpr double kLeastStep = 1e-3;
// Below this fraction an estimate of the time left is too unstable.
constexpr double kLeastFraction = 0.02;

double secondsBetween(ProgressEstimate::Clock::time_point begin,
                      ProgressEstimate::Clock::time_point end) {
    return std::chrono::duration<double>(end - begin).count();
}

}  // namespace

double ProgressEstimate::add(double fraction, Clock::time_point now) {
    fraction_ = std::max(fraction_, std::min(fraction, 1.0));
    const double before = steps_.empty() ? 0.0 : steps_.back().fraction;
    if (fraction_ - before >= kLeastStep) steps_.push_back({now, fraction_});
    return fraction_;
}

std::optional<double> ProgressEstimate::secondsLeft(Clock::time_point now) const {
    if (fraction_ <= kLeastFraction) return std::nullopt;
    // The last step before the later half of the time spent, and before the last few: one long step
    // raises the time left only gradually.
    constexpr std::size_t kLeastSteps = 4;
    const Clock::time_point middle = begin_ + (now - begin_) / 2;
    Step since{begin_, 0.0};
    for (std::size_t i = 0; i + kLeastSteps < steps_.size() && steps_[i].time <= middle; ++i) {
        since = steps_[i];
    }
    const double speed = (fraction_ - since.fraction) / secondsBetween(since.time, now);
    return (1.0 - fraction_) / speed;
}

}  // namespace dollytrack
