#include "planning/metrics/explain.h"

#include <algorithm>
#include <map>
#include <string>

namespace dollytrack::planning {
namespace {

/// What kept most of the candidates from being a view, with the object that did it.
std::string mostCommon(const Scene& scene, const std::map<std::pair<Verdict, int>, int>& counts) {
    const auto most =
        std::max_element(counts.begin(), counts.end(),
                         [](const auto& a, const auto& b) { return a.second < b.second; });
    const auto [verdict, object] = most->first;
    const std::string by = object > 0 ? scene.object(object).name : std::string("itself");
    switch (verdict) {
        case Verdict::OccludedBy:
            return "occluded by " + by;
        case Verdict::InObstacle:
            return "no free pose: most places are too near to " + by;
        case Verdict::OutsideRoom:
            return "no free pose: most places are outside the free space";
        case Verdict::TooClose:
            return "no free pose: the camera would touch it";
        case Verdict::Cropped:
            return "does not fit into the image from any free place";
        case Verdict::TooSmall:
            return "too small at any legal distance";
        case Verdict::NoGo:
            return "no free pose: most places are in a no-go box";
        case Verdict::HeightBand:
            return "no free pose: most places are outside the height band";
        case Verdict::Legal:
            break;
    }
    return "lost between the key frames";
}

bool has(const std::vector<int>& ids, int id) {
    return std::find(ids.begin(), ids.end(), id) != ids.end();
}

}  // namespace

std::string explainUncaptured(const Scene& scene, const Plan& plan, int object_id) {
    std::map<std::pair<Verdict, int>, int> counts;
    bool removed = false;
    for (std::size_t o = 0; o < plan.observation_points.size(); ++o) {
        if (!has(plan.observation_points[o].objects, object_id)) continue;
        removed |= plan.searches[o].removed;
        for (const Candidate& candidate : plan.searches[o].candidates) {
            if (candidate.verdict != Verdict::Legal) {
                ++counts[{candidate.verdict, candidate.occluder}];
            }
        }
    }
    bool had_a_view = false;
    for (std::size_t p = 0; p < plan.position_points.size(); ++p) {
        if (!has(plan.position_points[p].captured, object_id)) continue;
        had_a_view = true;
        if (!has(plan.key_frames, static_cast<int>(p))) continue;
        const bool on_path = std::any_of(
            plan.smooth_paths.begin(), plan.smooth_paths.end(), [&](const SmoothPath& path) {
                return std::any_of(path.keys.begin(), path.keys.end(), [&](const auto& key) {
                    return key.position_point == static_cast<int>(p);
                });
            });
        return on_path ? "its key frame shows it just below the limit"
                       : "its key frame is not on the path";
    }
    if (removed && !had_a_view) return "its position point was removed by hand";
    const bool pinned = std::any_of(
        plan.position_points.begin(), plan.position_points.end(), [&](const PositionPoint& point) {
            const auto o = static_cast<std::size_t>(point.observation_point);
            return point.pin >= 0 && has(plan.observation_points[o].objects, object_id);
        });
    if (pinned && !had_a_view) return "its pinned position point does not capture it";
    // Key frames are chosen to keep every capture; only a budget drops some.
    if (had_a_view) return "dropped to keep to max_frames";
    return counts.empty() ? "no place could be tried" : mostCommon(scene, counts);
}

}  // namespace dollytrack::planning
