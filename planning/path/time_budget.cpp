#include "planning/path/time_budget.h"

#include <algorithm>
#include <utility>

namespace dollytrack::planning {
namespace {

constexpr int kHalvings = 8;
// After bisection, longer lengths up to twice its result are tried.
constexpr double kStep = 0.15;  // relative to that result
constexpr double kFarthest = 2.0;
constexpr double kShortest_m = 1e-3;  // so short that only fixed stops are visited

/// Length before smoothing, which never makes it longer.
double lengthOf(const Paths& taken) {
    double length = 0.0;
    for (const CameraPath& path : taken.paths) {
        for (std::size_t i = 1; i < path.vertices.size(); ++i) {
            length += (path.vertices[i].position - path.vertices[i - 1].position).norm();
        }
    }
    return length;
}

}  // namespace

Result<std::optional<Paths>> pathsWithinFrames(const TimedPaths& timed, double max_length_m,
                                               std::size_t most_frames) {
    std::optional<Paths> longest;
    /// Keeps the paths of this length if they have few enough frames.
    const auto fits = [&](double length_m) -> Result<bool> {
        Result<Paths> taken = timed.take(length_m);
        if (!taken) return tl::unexpected(std::move(taken.error()));
        const Result<std::size_t> frames = timed.frames(*taken);
        if (!frames) return tl::unexpected(frames.error());
        if (*frames > most_frames) return false;
        longest = std::move(*taken);
        return true;
    };
    Result<Paths> whole = timed.take(max_length_m);
    if (!whole) return tl::unexpected(std::move(whole.error()));
    const Result<std::size_t> all = timed.frames(*whole);
    if (!all) return tl::unexpected(all.error());
    if (*all <= most_frames) return std::optional(std::move(*whole));
    const double whole_m = lengthOf(*whole);
    double high = whole_m;
    double low = 0.0;
    for (int halving = 0; halving < kHalvings; ++halving) {
        const double middle = 0.5 * (low + high);
        const Result<bool> few = fits(middle);
        if (!few) return tl::unexpected(few.error());
        (*few ? low : high) = middle;
    }
    if (!longest) {
        const Result<bool> few = fits(kShortest_m);
        if (!few) return tl::unexpected(few.error());
        return longest;
    }
    // A longer path may need fewer frames, if it leaves out large turns or context views.
    for (double length_m = (1.0 + kStep) * low; length_m < std::min(whole_m, kFarthest * low);
         length_m += kStep * low) {
        const Result<bool> few = fits(length_m);
        if (!few) return tl::unexpected(few.error());
    }
    return longest;
}

}  // namespace dollytrack::planning
