#include "planning/path/frame_budget.h"

#include "planning/plan_params.h"

#include <algorithm>
#include <set>
#include <utility>

namespace dollytrack::planning {

int mostVisits(const PlanParams& params) {
    if (params.body.heading == Heading::Free) return params.timing.max_frames;
    // The key frame itself, turning to it and back, and two corners on the way to it.
    constexpr int kFramesPerVisit = 7;
    return params.timing.max_frames > 0 ? std::max(1, params.timing.max_frames / kFramesPerVisit)
                                        : 0;
}

std::vector<int> withinBudget(std::vector<int> keys, const std::vector<PositionPoint>& points,
                              const PathEnds& ends) {
    for (const int end : {ends.end, ends.start}) {
        const auto found = std::find(keys.begin(), keys.end(), end);
        if (found != keys.end()) std::rotate(keys.begin(), found, found + 1);
    }
    const auto visits = [&] {
        std::set<std::pair<int, int>> rooms;
        for (const int key : keys) {
            const PositionPoint& point = points[key];
            rooms.emplace(point.component, point.room);
        }
        return keys.size() + (ends.loop && keys.size() > rooms.size() ? rooms.size() : 0);
    };
    while (ends.visits > 0 && visits() > static_cast<std::size_t>(ends.visits)) keys.pop_back();
    return keys;
}

bool isChosenByTour(const PathParams& path, const std::vector<PositionPoint>& position_points,
                    const PathEnds& ends) {
    if (ends.visits <= 0 || path.max_length_m <= 0.0 || path.path_mode != PathMode::Tour) {
        return false;
    }
    std::set<int> rooms;
    int stay = 0;
    for (const PositionPoint& point : position_points) {
        stay += point.pin >= 0 ? 1 : 0;
        rooms.insert(point.component);
        rooms.insert(-1 - point.room);
    }
    // A loop keeps two stops in each room.
    return stay + (ends.loop ? 2 * static_cast<int>(rooms.size()) : 0) <= ends.visits;
}

void refusePinsOverBudget(const PlanEdits& edits, Plan& plan) {
    for (std::size_t p = 0; p < plan.position_points.size(); ++p) {
        const int pin = plan.position_points[p].pin;
        const auto& keys = plan.key_frames;
        if (pin < 0 || std::find(keys.begin(), keys.end(), static_cast<int>(p)) != keys.end()) {
            continue;
        }
        plan.refused_pins.push_back(
            {pin, edits.pinned[pin].name, Verdict::Legal, 0, "dropped to keep within max_frames"});
    }
}

}  // namespace dollytrack::planning
