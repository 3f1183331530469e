#pragma once

#include "engine/core/result.h"
#include "engine/jobs/job.h"
#include "engine/plan/targets.h"
#include "engine/plan/viewpoint.h"
#include "planning/viewpoints/moved_objects.h"
#include "planning/visibility/heading_limit.h"
#include "planning/visibility/pitch_band.h"

#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace dollytrack::planning {

class CornerPanoramas;
class FreeSpace;
class SweptSphere;
class ViewEstimator;
struct ViewpointParams;

/// Shared input of the planning searches: visibility estimates, free space, collision tests, and
/// limits of the viewing direction. Keeps references.
struct PlanningEnvironment {
    const ViewEstimator& views;
    const FreeSpace& free_space;
    const SweptSphere& sphere;
    PitchBand pitch = {};
    HeadingLimit heading = {};
    CornerPanoramas* corners = nullptr;  // null without trackability, and in the stages before
                                         // key frames are selected
};

struct Viewpoints {
    std::vector<ObservationPoint> observation_points;  // the given ones, then members split off
                                                       // their groups
    std::vector<ViewpointSearch> searches;             // by observation point
    std::vector<PositionPoint> position_points;
};

/// Result of the search for one observation point.
struct FoundView {
    ViewpointSearch search;
    std::optional<PositionPoint> best;
    std::vector<int> not_well;  // members of the group that the best view does not
                                // capture well
    std::shared_ptr<const SearchFootprint> footprint;  // what the result depends on
};

/// Cache of search results. A search depends on its observation point alone, given the same map,
/// parameters and seed. The owner clears it when any of these change; if objects only moved,
/// forget() is enough.
class SearchCache {
  public:
    [[nodiscard]] const FoundView* find(const ObservationPoint& point) const;
    void keep(const ObservationPoint& point, FoundView found);
    void clear() { entries_.clear(); }
    [[nodiscard]] bool empty() const { return entries_.empty(); }
    /// Drops results that moved objects may have changed. Returns the number of entries left.
    std::size_t forget(const MovedObjects& moved, const MapChange& map, double camera_radius_m);

  private:
    struct Entry {
        ObservationPoint point;
        FoundView found;
    };
    std::map<std::vector<int>, Entry> entries_;  // by the point's objects
};

/// Finds the set P (paper, eq. 1 and 3.2.1): for each observation point the best legal candidate in
/// the cone around its direction, or elsewhere if none there captures well (see searchView).
/// Members that their group's view does not capture well get an observation point and view of their
/// own. Points are searched independently, so that excluding one object leaves the views of the
/// others unchanged. `memo` may be null. Error: Cancelled.
Result<Viewpoints> searchViewpoints(const PlanningEnvironment& environment,
                                    std::vector<ObservationPoint> observation_points,
                                    const ViewpointParams& params, int seed, const JobContext& job,
                                    SearchCache* memo = nullptr);

}  // namespace dollytrack::planning
