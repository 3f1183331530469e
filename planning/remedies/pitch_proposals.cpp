#include "planning/remedies/proposal_parts.h"

#include "engine/jobs/parallel.h"
#include "planning/visibility/coarse_grid.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dollytrack::planning {
namespace {

constexpr double kPitchDegreesPerRadian = 180.0 / std::numbers::pi;
constexpr int kMoreSteps = 5;

/// The pitch band with one limit moved outwards by steps of at most a degree, to whole degrees.
ConstraintParams loosened(const ConstraintParams& from, bool down, int steps) {
    ConstraintParams to = from;
    if (down) {
        to.min_pitch_deg = std::max(-90.0, std::ceil(from.min_pitch_deg) - steps);
    } else {
        to.max_pitch_deg = std::min(90.0, std::floor(from.max_pitch_deg) + steps);
    }
    return to;
}

/// A position from which the object is above or below the pitch band.
struct SteepPlace {
    const HypotheticalPosition* place = nullptr;
    bool down = false;
    int steps = 0;  // fewest steps after which a coarse estimate meets the requirement; 0: none
    double goodness = 0.0;  // without any limit of pitch
};

SteepPlace steepPlace(const ProposalContext& context, const HypotheticalPosition& place,
                      double asked) {
    SteepPlace steep{&place};
    const double elevation = elevationOf(context.subject.center - place.position);
    const PitchBand band = pitchBand(context.params.constraints);
    if (band.nearest(elevation) == elevation) return steep;
    steep.down = elevation < band.lowest;
    const ConstraintParams& from = context.params.constraints;
    const auto seen = [&](int steps) {
        const PitchBand looser = pitchBand(loosened(from, steep.down, steps));
        return context.environment.views.estimate(
            aim(place.position, context.subject.center, looser), context.object_id, kCoarseGrid);
    };
    const auto promises = [&](const ViewEstimator::Estimate& view) {
        return promise(view, context.well) >= asked;
    };
    // With this many steps the object is in the image centre.
    int enough = static_cast<int>(std::ceil(
                     steep.down ? from.min_pitch_deg - elevation * kPitchDegreesPerRadian
                                : elevation * kPitchDegreesPerRadian - from.max_pitch_deg)) +
                 1;
    const ViewEstimator::Estimate whole = seen(enough);
    if (!promises(whole)) return steep;
    steep.goodness = goodness(whole);
    int short_of = 0;
    while (enough - short_of > 1) {
        const int middle = (enough + short_of) / 2;
        (promises(seen(middle)) ? enough : short_of) = middle;
    }
    steep.steps = enough;
    return steep;
}

Proposal propose(const ProposalContext& context, const SteepPlace& steep, int steps) {
    const ConstraintParams to = loosened(context.params.constraints, steep.down, steps);
    Proposal made =
        unchanged(context, aim(steep.place->position, context.subject.center, pitchBand(to)));
    ConstraintParams& band = made.change.params.constraints;
    if (steep.down) {
        changeTo(made, "min_pitch_deg", band.min_pitch_deg, to.min_pitch_deg);
    } else {
        changeTo(made, "max_pitch_deg", band.max_pitch_deg, to.max_pitch_deg);
    }
    return made;
}

/// The positions from which a coarse estimate reaches `asked`, fewest steps first.
std::vector<SteepPlace> steepPlaces(const ProposalContext& context, double asked) {
    std::vector<SteepPlace> steep(context.places.size());
    parallelFor(context.places.size(), [&](std::size_t i) {
        const HypotheticalPosition& place = context.places[i];
        if (place.legal() && std::isfinite(place.fill))
            steep[i] = steepPlace(context, place, asked);
    });
    std::erase_if(steep, [](const SteepPlace& one) { return one.steps == 0; });
    std::stable_sort(steep.begin(), steep.end(), [](const SteepPlace& a, const SteepPlace& b) {
        return a.steps != b.steps ? a.steps < b.steps : a.goodness > b.goodness;
    });
    return steep;
}

/// The mildest loosening, verified by exact estimates; empty if no position meets the requirement.
std::vector<Proposal> loosenedFor(const ProposalContext& context) {
    const auto shows = [&](const Proposal& made) {
        return showsEnough(context.environment.views, *made.view, context.object_id, context.well);
    };
    // Most candidates that nearly meet the requirement fail the exact estimate.
    for (const double asked : {1.0, kAlmost}) {
        std::size_t looked = 0;
        for (const SteepPlace& one : steepPlaces(context, asked)) {
            if (++looked > 2 * kLookedAt) break;
            int steps = one.steps;
            Proposal pinned = propose(context, one, steps);
            if (!shows(pinned)) continue;
            for (; steps > 1; --steps) {
                Proposal milder = propose(context, one, steps - 1);
                if (!shows(milder)) break;
                pinned = std::move(milder);
            }
            // A slightly looser band may make the pin unnecessary, since the search has more
            // candidates.
            Proposal least = pinned;
            Proposal more = propose(context, one, steps + kMoreSteps);
            least.view.reset();
            more.view.reset();
            pinned.needs_pin = true;
            return {std::move(least), std::move(more), std::move(pinned)};
        }
    }
    return {};
}

}  // namespace

std::vector<Proposal> proposePitches(const ProposalContext& context) {
    if (!pitchBand(context.params.constraints).restricts()) return {};
    ProposalContext well = context;
    well.well = true;
    // Prefer views that capture well: a looser band has no other cost.
    std::vector<Proposal> proposals = loosenedFor(well);
    if (context.well) return proposals;
    for (Proposal& made : loosenedFor(context)) proposals.push_back(std::move(made));
    return proposals;
}

}  // namespace dollytrack::planning
