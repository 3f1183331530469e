#include "planning/timing/drop_repeats.h"

#include "planning/visibility/shown_surface.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace dollytrack::planning {

Result<Trajectory> dropRepeats(Trajectory trajectory, double max_repeat_rate,
                               const ViewEstimator& views, const JobContext& job) {
    if (max_repeat_rate >= 1.0) return trajectory;
    const auto shown = measureShownSurface(views, trajectory, job);
    if (!shown) return tl::unexpected(shown.error());
    const std::vector<double>& fresh = shown->new_shares;
    std::vector<std::size_t> repeats;  // frames that may be left out
    for (std::size_t i = 0; i + 1 < fresh.size(); ++i) {
        const bool is_end = !continuesPath(trajectory, i) || !continuesPath(trajectory, i + 1);
        if (is_end || trajectory.frames[i].position_point >= 0) continue;
        if (shown->repeats(i)) repeats.push_back(i);
    }
    // Without a frame, no later frame shows less that is new.
    const auto frames = static_cast<double>(fresh.size());
    const double excess =
        frames * (shown->repeatRate() - max_repeat_rate) / (1.0 - max_repeat_rate);
    const auto dropped = static_cast<std::size_t>(std::ceil(std::max(0.0, excess - 1e-9)));
    if (dropped == 0 || dropped > repeats.size()) return trajectory;
    std::ranges::stable_sort(repeats, {}, [&](std::size_t i) { return fresh[i]; });
    std::vector<char> keep(fresh.size(), 1);
    for (std::size_t k = 0; k < dropped; ++k) keep[repeats[k]] = 0;
    return keepOnly(trajectory, keep);
}

}  // namespace dollytrack::planning
