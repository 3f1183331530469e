#include "planning/timing/drop_repeats.h"

#include "planning/visibility/shown_surface.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace dollytrack::planning {
namespace {

constexpr int kRateHalvings = 10;
constexpr double kSurely = 0.75;  // relative to the limit: a coarse rate below this needs no fine
                                  // measurement
constexpr double kAim = 0.9;      // target, relative to the limit
// At another rate frames lie beside those sampled coarsely, so fine measurements have the last
// word.
constexpr int kMostReductions = 12;
constexpr int kMostAdditions = 3;
constexpr double kAlike = 0.05;     // relative to the number of frames: smaller gains are not worth
                                    // a measurement
constexpr double kBelow = 0.99;     // relative to the limit, so that the result is below it
constexpr double kStricter = 0.96;  // factor of the number of frames after a measurement above the
                                    // limit

/// Indices of the key frames, and the number of frames.
std::vector<std::size_t> keysOf(const Trajectory& trajectory) {
    std::vector<std::size_t> keys;
    for (std::size_t i = 0; i < trajectory.frames.size(); ++i) {
        if (trajectory.frames[i].position_point >= 0) keys.push_back(i);
    }
    keys.push_back(trajectory.frames.size());
    return keys;
}

/// Approximate frames at a lower rate: all key frames, and a share of the frames between them,
/// evenly spaced.
std::vector<std::size_t> atLowerRate(const std::vector<std::size_t>& keys, double share) {
    std::vector<std::size_t> frames;
    for (std::size_t k = 0; k + 1 < keys.size(); ++k) {
        const std::size_t count = keys[k + 1] - keys[k];
        const auto kept = std::max<std::size_t>(
            1, static_cast<std::size_t>(std::lround(share * static_cast<double>(count))));
        for (std::size_t i = 0; i < kept; ++i) frames.push_back(keys[k] + i * count / kept);
    }
    return frames;
}

/// Searches for more frames than `low` and fewer than `high` that still meet the limit, by fine
/// measurements: the coarse search tends to end too low.
Result<Trajectory> addFrames(Trajectory thinned, int low, int high, const TimeWithin& time_within,
                             const std::function<Result<bool>(const Trajectory&)>& repeats_little) {
    for (int trial = 0; trial < kMostAdditions && high - low > 1 + kAlike * high; ++trial) {
        const int between = low + (high - low) / 2;
        Result<Trajectory> more = time_within(between);
        if (!more) return more;
        const Result<bool> allowed = repeats_little(*more);
        if (!allowed) return tl::unexpected(allowed.error());
        (*allowed ? low : high) = between;
        if (*allowed) thinned = std::move(*more);
    }
    return thinned;
}

}  // namespace

Result<Trajectory> dropRepeats(Trajectory trajectory, double max_repeat_rate, int least,
                               const TimeWithin& time_within, SurfaceSamplers& samplers,
                               const JobContext& job) {
    const std::vector<std::size_t> keys = keysOf(trajectory);
    if (max_repeat_rate >= 1.0 || keys.size() == 1) return trajectory;
    const auto coarse = samplers.coarse.sample(trajectory, job);
    if (!coarse) return tl::unexpected(coarse.error());
    const auto isFew = [&](double share, double rate) {
        const auto frames = atLowerRate(keys, share);
        return coarse->repeats(frames) <= rate * static_cast<double>(frames.size());
    };
    if (isFew(1.0, kSurely * max_repeat_rate)) return trajectory;

    // The most frames that meet a repeat rate, estimated from the coarse sampling.
    const auto framesAt = [&](double rate) {
        double few = 0.0;
        double many = 1.0;
        if (isFew(many, rate)) few = many;
        for (int halving = 0; halving < kRateHalvings && few < many; ++halving) {
            const double middle = 0.5 * (few + many);
            (isFew(middle, rate) ? few : many) = middle;
        }
        return std::max(least, static_cast<int>(atLowerRate(keys, few).size()));
    };
    const auto rateOf = [&](const Trajectory& sampled) -> Result<double> {
        const auto shown = samplers.fine.sample(sampled, job);
        if (!shown) return tl::unexpected(shown.error());
        return shown->repeats() / static_cast<double>(shown->frames());
    };
    const double limit = kBelow * max_repeat_rate;
    double rate = kAim * max_repeat_rate;
    int low = framesAt(rate);
    // The fewest frames known to exceed the limit, or all.
    int high = static_cast<int>(trajectory.frames.size());
    Result<Trajectory> thinned = time_within(low);
    for (int trial = 0; thinned; ++trial) {
        const Result<double> found = rateOf(*thinned);
        if (!found) return tl::unexpected(found.error());
        if (*found <= limit) break;
        // Not even the fewest frames meet the limit: keep all of them.
        if (low <= least || trial == kMostReductions) return trajectory;
        high = low;
        // Correct the target by the ratio found.
        rate *= kAim * max_repeat_rate / *found;
        low = std::max(least, std::min(framesAt(rate), static_cast<int>(kStricter * low)));
        thinned = time_within(low);
    }
    if (!thinned) return thinned;
    return addFrames(std::move(*thinned), low, high, time_within, [&](const Trajectory& more) {
        return rateOf(more).map([&](double found) { return found <= limit; });
    });
}

}  // namespace dollytrack::planning
