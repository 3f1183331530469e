#include "app/statistics/trajectory_line.h"

#include <algorithm>

namespace dollytrack::statistics {

TrajectoryLine trajectoryLineOf(const std::vector<double>& time_s,
                                const std::vector<std::optional<double>>& values) {
    constexpr std::size_t kMostPoints = 300;
    const std::size_t group = (time_s.size() + kMostPoints - 1) / kMostPoints;
    TrajectoryLine line;
    for (std::size_t begin = 0; begin < time_s.size(); begin += group) {
        const std::size_t end = std::min(begin + group, time_s.size());
        double time_sum = 0.0;
        double sum = 0.0;
        int count = 0;
        for (std::size_t i = begin; i < end; ++i) {
            time_sum += time_s[i];
            if (!values[i]) continue;
            sum += *values[i];
            ++count;
        }
        line.time_s.push_back(time_sum / static_cast<double>(end - begin));
        line.values.push_back(count > 0 ? std::optional(sum / count) : std::nullopt);
    }
    return line;
}

}  // namespace dollytrack::statistics
