#pragma once

#include "engine/jobs/job.h"

#include <vector>

namespace dollytrack::planning {

/// Square matrix of costs between stops.
using CostMatrix = std::vector<std::vector<double>>;

/// First and last stop of the tour, which must differ; -1: any.
struct TourEnds {
    int first = -1;
    int last = -1;
};

/// A short open tour through all stops, as stop indices: nearest neighbour, then 2-opt and Or-opt
/// until neither improves, then iterated local search with random segment swaps (Lourenco, Martin
/// and Stuetzle, 2003). Candidate moves are limited to the 8 nearest neighbours of each stop, so
/// run time grows little faster than the number of stops. Costs must be symmetric and finite.
/// Deterministic. Cancelling the job ends it early with a valid tour.
std::vector<int> shortTour(const CostMatrix& cost, const JobContext& job = {},
                           const TourEnds& ends = {});

double tourCost(const CostMatrix& cost, const std::vector<int>& tour);

}  // namespace dollytrack::planning
