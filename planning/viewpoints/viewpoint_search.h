#pragma once

#include "engine/core/result.h"
#include "engine/jobs/job.h"
#include "engine/plan/targets.h"
#include "engine/plan/viewpoint.h"
#include "planning/viewpoints/moved_things.h"
#include "planning/visibility/heading_limit.h"
#include "planning/visibility/pitch_band.h"

#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace dollytrack::planning {

class FreeSpace;
class SweptSphere;
class ViewEstimator;
struct ViewpointParams;

/// What the viewpoint searches look at. References must outlive the call.
struct Surroundings {
    const ViewEstimator& views;
    const FreeSpace& free_space;
    const SweptSphere& sphere;
    PitchBand pitch = {};
    HeadingLimit heading = {};
};

struct Viewpoints {
    std::vector<ObservationPoint> observation_points;  // those given, then members split off
    std::vector<ViewpointSearch> searches;             // one an observation point
    std::vector<PositionPoint> position_points;
};

/// What the search for one observation point found.
struct FoundView {
    ViewpointSearch search;
    std::optional<PositionPoint> best;
    std::vector<int> not_well;               // members that the best view does not capture well
    std::shared_ptr<const LookedAt> looked;  // what it rests on
};

/// Remembers searches, for the next run in the same free space with the same parameters and seed:
/// there a search depends on its observation point alone. Whoever keeps one clears it when any of
/// those change; when things have only moved, forgetting what they touch is enough.
class SearchMemo {
  public:
    [[nodiscard]] const FoundView* find(const ObservationPoint& point) const;
    void keep(const ObservationPoint& point, FoundView found);
    void clear() { entries_.clear(); }
    [[nodiscard]] bool empty() const { return entries_.empty(); }
    /// Forgets the searches that might find something else now. Returns how many are left.
    std::size_t forget(const MovedThings& moved, const MapChange& map, double camera_radius_m);

  private:
    struct Entry {
        ObservationPoint point;
        FoundView found;
    };
    std::map<std::vector<int>, Entry> entries_;  // by objects
};

/// Sets P (paper, eq. 1 and 3.2.1): for each observation point the best legal place in the cone
/// around its direction; where the cone has none that captures well, where searchView() goes on.
/// Members that their group's view does not capture well get a view of their own.
/// What is searched for one observation point does not depend on the others, so that excluding
/// an object leaves their places alone. Error: Cancelled.
Result<Viewpoints> searchViewpoints(const Surroundings& around,
                                    std::vector<ObservationPoint> observation_points,
                                    const ViewpointParams& params, int seed, const JobContext& job,
                                    SearchMemo* memo = nullptr);

}  // namespace dollytrack::planning
