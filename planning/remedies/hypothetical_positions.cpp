#include "planning/remedies/hypothetical_positions.h"

#include "engine/jobs/parallel.h"
#include "planning/collision/allowed_region.h"
#include "planning/collision/swept_sphere.h"
#include "planning/free_space/free_space.h"
#include "planning/viewpoints/candidate_source.h"
#include "planning/visibility/coarse_grid.h"

#include <algorithm>
#include <cmath>

namespace dollytrack::planning {
namespace {

constexpr int kDirections = 700;
constexpr int kRandomPlaces = 3000;
constexpr double kLeastFill = 0.05;
constexpr double kMostFill = 3.5;  // largest fill that a wide lens could fit into the image
constexpr double kFillStep = 1.2;
constexpr std::uint64_t kStream = 200'000;  // random stream, different from those of the searches

std::vector<Eigen::Vector3d> positionsAround(const PlanningEnvironment& environment,
                                             const Subject& subject, int object_id, int seed) {
    std::vector<Eigen::Vector3d> positions;
    for (const Eigen::Vector3d& direction :
         directionsAllAround(Eigen::Vector3d::UnitX(), kDirections)) {
        for (double fill = kLeastFill; fill < kMostFill; fill *= kFillStep) {
            const double distance = distanceForFill(environment.views, subject, direction, fill);
            positions.push_back(subject.center + direction * distance);
            // With a height band most positions are outside it: add the clamped ones.
            const Eigen::Vector3d moved = environment.sphere.inBand(positions.back());
            if (moved != positions.back()) positions.push_back(moved);
        }
    }
    Random random(static_cast<std::uint64_t>(seed),
                  kStream + static_cast<std::uint64_t>(object_id));
    const SweptSphere anywhere(environment.views.rays(), environment.free_space,
                               environment.sphere.radius());
    const auto more = randomPlaces(environment.free_space, anywhere, environment.views, subject,
                                   kLeastFill, kMostFill, kRandomPlaces, random);
    positions.insert(positions.end(), more.begin(), more.end());
    return positions;
}

}  // namespace

std::vector<HypotheticalPosition> hypotheticalPositions(const PlanningEnvironment& environment,
                                                        const Subject& subject, int object_id,
                                                        int seed, const JobContext& job) {
    const auto positions = positionsAround(environment, subject, object_id, seed);
    const SweptSphere anywhere(environment.views.rays(), environment.free_space,
                               environment.sphere.radius());
    const double reach = environment.sphere.radius() + SweptSphere::kMargin;
    std::vector<HypotheticalPosition> places(positions.size());
    std::vector<char> in_air(positions.size(), 0);
    parallelFor(positions.size(), [&](std::size_t i) {
        const Eigen::Vector3d& position = positions[i];
        if (job.cancelled() || environment.free_space.stateAt(position) != CellState::Free) return;
        HypotheticalPosition& place = places[i];
        place.position = position;
        place.fill = fillFrom(environment.views, subject, position);
        place.clearance_m = anywhere.clearance(position, reach);
        place.roomy = anywhere.fits(position);
        if (const AllowedRegion* region = environment.sphere.region()) {
            place.allowed = region->verdict(position, reach);
        }
        if (std::isfinite(place.fill)) {
            place.seen = environment.views.estimate(
                aim(position, subject.center, environment.pitch), object_id, kCoarseGrid);
        }
        in_air[i] = 1;
    });
    std::vector<HypotheticalPosition> kept;
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (in_air[i] != 0) kept.push_back(places[i]);
    }
    if (job.cancelled()) kept.clear();
    return kept;
}

}  // namespace dollytrack::planning
