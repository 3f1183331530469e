#include "planning/viewpoints/viewpoint_search.h"

#include "engine/jobs/parallel.h"
#include "planning/plan_params.h"
#include "planning/targets/observation_points.h"
#include "planning/viewpoints/view_search.h"

#include <algorithm>
#include <atomic>
#include <utility>

namespace dollytrack::planning {
namespace {

/// Random stream of a search: by its first object, and whether it is a group.
std::uint64_t streamOf(const ObservationPoint& point) {
    const auto id = static_cast<std::uint64_t>(point.objects.front());
    return 2 * id + (point.objects.size() > 1 ? 1 : 0);
}

}  // namespace

const FoundView* SearchCache::find(const ObservationPoint& point) const {
    const auto entry = entries_.find(point.objects);
    return entry != entries_.end() && entry->second.point == point ? &entry->second.found : nullptr;
}

void SearchCache::keep(const ObservationPoint& point, FoundView found) {
    entries_.insert_or_assign(point.objects, Entry{point, std::move(found)});
}

std::size_t SearchCache::forget(const MovedObjects& moved, const MapChange& map,
                                double camera_radius_m) {
    std::vector<const Entry*> entries;
    for (const auto& [objects, entry] : entries_) entries.push_back(&entry);
    std::vector<std::uint8_t> touched(entries.size(), 0);
    parallelFor(entries.size(), [&](std::size_t i) {
        const Entry& entry = *entries[i];
        const bool own =
            std::ranges::any_of(entry.point.objects, [&](int id) { return moved.isOne(id); });
        touched[i] = own || isTouched(*entry.found.footprint, moved, map, camera_radius_m) ? 1 : 0;
    });
    std::size_t i = 0;
    std::erase_if(entries_, [&](const auto&) { return touched[i++] != 0; });
    return entries_.size();
}

Result<Viewpoints> searchViewpoints(const PlanningEnvironment& environment,
                                    std::vector<ObservationPoint> observation_points,
                                    const ViewpointParams& params, int seed, const JobContext& job,
                                    SearchCache* memo) {
    Viewpoints result;
    result.observation_points = std::move(observation_points);
    std::size_t begin = 0;
    // The second round searches for the members split off in the first.
    for (int round = 0; round < 2; ++round) {
        const std::size_t end = result.observation_points.size();
        std::vector<FoundView> found(end - begin);
        std::atomic<bool> cancelled = false;
        parallelFor(found.size(), [&](std::size_t i) {
            if (cancelled || job.cancelled()) {
                cancelled = true;
                return;
            }
            const ObservationPoint& point = result.observation_points[begin + i];
            if (const FoundView* known = memo ? memo->find(point) : nullptr) {
                found[i] = *known;
                return;
            }
            found[i] = searchView(environment, point, params,
                                  Random(static_cast<std::uint64_t>(seed), streamOf(point)));
        });
        if (cancelled) return fail(ErrorCode::Cancelled, "Planning was cancelled.");
        job.report(round == 0 ? 0.7 : 1.0);

        for (std::size_t i = 0; i < found.size(); ++i) {
            const ObservationPoint point = result.observation_points[begin + i];
            if (memo) memo->keep(point, found[i]);
            if (found[i].best) {
                found[i].best->observation_point = static_cast<int>(begin + i);
                found[i].search.position_point = static_cast<int>(result.position_points.size());
                result.position_points.push_back(std::move(*found[i].best));
            }
            result.searches.push_back(std::move(found[i].search));
            if (point.objects.size() < 2) continue;
            for (const int id : found[i].not_well) {
                result.observation_points.push_back(alone(environment.views, point, id));
            }
        }
        begin = end;
    }
    return result;
}

}  // namespace dollytrack::planning
