#include "ui/panels/timeline/timeline_data.h"

#include <map>
#include <set>

namespace dollytrack::ui {
namespace {

std::string namesOf(const Scene& scene, const std::vector<int>& ids) {
    std::string text;
    for (const int id : ids) text += (text.empty() ? "" : ", ") + scene.object(id).name;
    return text;
}

}  // namespace

std::vector<TimelineKey> timelineKeys(const Scene& scene, const Plan& plan) {
    std::vector<TimelineKey> keys;
    const auto& frames = plan.trajectory.frames;
    int before = -1;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const int point = frames[i].position_point;
        const bool again = point == before && i > 0 && frames[i].path == frames[i - 1].path;
        before = point;
        if (point < 0 || again) continue;
        const std::size_t p = point;
        if (p >= plan.position_points.size()) continue;
        TimelineKey key;
        key.frame = static_cast<int>(i);
        const std::vector<int>& captured = plan.position_points[p].captured;
        key.text = captured.empty() ? "Captures nothing" : "Captures " + namesOf(scene, captured);
        keys.push_back(std::move(key));
    }
    for (std::size_t i = 0; i < plan.passed_keys.size(); ++i) {
        keys.push_back({plan.passed_keys[i].frame, "Key " + std::to_string(i + 1)});
    }
    return keys;
}

std::vector<TimelineBand> timelineBands(const Plan& plan) {
    const auto& frames = plan.trajectory.frames;
    std::map<int, std::set<int>> paths;  // paths by room
    for (const TrajectoryFrame& frame : frames) paths[frame.component].insert(frame.path);
    std::vector<TimelineBand> bands;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const TrajectoryFrame& frame = frames[i];
        const bool same =
            i > 0 && frames[i - 1].component == frame.component && frames[i - 1].path == frame.path;
        if (!same) {
            const std::set<int>& here = paths[frame.component];
            std::string name = "Room " + std::to_string(frame.component + 1);
            if (here.size() > 1) {
                const auto number = std::distance(here.begin(), here.find(frame.path)) + 1;
                name += ", path " + std::to_string(number);
            }
            bands.push_back({static_cast<int>(i), static_cast<int>(i), std::move(name)});
        }
        bands.back().end = static_cast<int>(i) + 1;
    }
    return bands;
}

}  // namespace dollytrack::ui
