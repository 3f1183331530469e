#pragma once

#include <chrono>
#include <optional>
#include <vector>

namespace dollytrack {

/// The progress of a job for display: never falls, and tells the time left.
class ProgressEstimate {
  public:
    using Clock = std::chrono::steady_clock;

    explicit ProgressEstimate(Clock::time_point begin = Clock::now()) : begin_(begin) {}

    /// Records that the share `fraction` of the work, 0..1, is done at `now`. Returns the largest
    /// share recorded so far.
    double add(double fraction, Clock::time_point now = Clock::now());

    /// Time left, s, if the work goes on as fast as in the later half of the time spent, because
    /// phases of a job differ in speed. Empty while it is too early to tell.
    [[nodiscard]] std::optional<double> secondsLeft(Clock::time_point now = Clock::now()) const;

  private:
    struct Step {
        Clock::time_point time;
        double fraction;
    };

    Clock::time_point begin_;
    double fraction_ = 0.0;
    std::vector<Step> steps_;  // rises of the fraction; small ones are skipped
};

}  // namespace dollytrack
