#include "planning/timing/drop_repeats.h"

#include "planning/metrics/shown_surface.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace dollytrack::planning {
namespace {

constexpr int kRateHalvings = 10;
constexpr double kSurely = 0.75;  // of the limit: a glance that finds fewer needs no closer look
constexpr double kAim = 0.9;      // of the limit, to be sure to meet it
// Places of another rate lie beside those glanced at, so the last word is a look at them.
constexpr int kLooks = 12;
constexpr int kLooksUp = 3;
constexpr double kAlike = 0.05;     // of the frames: so few more are not worth another look
constexpr double kBelow = 0.99;     // of the limit: fewer than that, not just as many
constexpr double kStricter = 0.96;  // of the frames, after a look that found too many repeats

int keyFrames(const Trajectory& trajectory) {
    return static_cast<int>(
        std::count_if(trajectory.frames.begin(), trajectory.frames.end(),
                      [](const TrajectoryFrame& frame) { return frame.position_point >= 0; }));
}

/// Indices of the key frames, and one past the last frame.
std::vector<std::size_t> keysOf(const Trajectory& trajectory) {
    std::vector<std::size_t> keys;
    for (std::size_t i = 0; i < trajectory.frames.size(); ++i) {
        if (trajectory.frames[i].position_point >= 0) keys.push_back(i);
    }
    keys.push_back(trajectory.frames.size());
    return keys;
}

/// About the frames that remain at a lower rate: as many of each stretch between two key frames as
/// its share allows, evenly, and all key frames.
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

/// As many more frames than `low`, and fewer than `high`, as are few enough by a closer look:
/// glances are coarse, and lead too low.
Result<Trajectory> addFrames(Trajectory thinned, int low, int high, const TimeWithin& time_within,
                             const std::function<Result<bool>(const Trajectory&)>& repeats_little) {
    for (int look = 0; look < kLooksUp && high - low > 1 + kAlike * high; ++look) {
        const int between = low + (high - low) / 2;
        Result<Trajectory> more = time_within(between);
        if (!more) return more;
        const Result<bool> allowed = repeats_little(*more);
        if (!allowed) return tl::unexpected<Error>(allowed.error());
        (*allowed ? low : high) = between;
        if (*allowed) thinned = std::move(*more);
    }
    return thinned;
}

}  // namespace

Result<Trajectory> dropRepeats(Trajectory trajectory, double max_repeat_rate,
                               const TimeWithin& time_within, FrameLooks& looks,
                               const JobContext& job) {
    const int least = keyFrames(trajectory);
    if (max_repeat_rate >= 1.0 || least == 0) return trajectory;
    const auto glanced = looks.glances.look(trajectory, job);
    if (!glanced) return tl::unexpected<Error>(glanced.error());
    const std::vector<std::size_t> keys = keysOf(trajectory);
    const auto isFew = [&](double share, double rate) {
        const auto frames = atLowerRate(keys, share);
        return glanced->repeats(frames) <= rate * static_cast<double>(frames.size());
    };
    if (isFew(1.0, kSurely * max_repeat_rate)) return trajectory;

    // The highest rate at which, as far as the frames glanced at can tell, few enough repeat.
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
    const auto rateOf = [&](const Trajectory& looked_at) -> Result<double> {
        const auto shown = looks.closer.look(looked_at, job);
        if (!shown) return tl::unexpected<Error>(shown.error());
        return shown->repeats() / static_cast<double>(shown->frames());
    };
    const double limit = kBelow * max_repeat_rate;
    double rate = kAim * max_repeat_rate;
    int low = framesAt(rate);
    // The fewest frames that are known to hold too many repeats, or all there are.
    int high = static_cast<int>(trajectory.frames.size());
    Result<Trajectory> thinned = time_within(low);
    for (int look = 0; look < kLooks && thinned && low > least; ++look) {
        const Result<double> found = rateOf(*thinned);
        if (!found) return tl::unexpected<Error>(found.error());
        if (*found <= limit) break;
        high = low;
        // As many more as were found now will be found again.
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
