#pragma once

#include "engine/jobs/job.h"

#include <vector>

namespace dollytrack::planning {

/// Square matrix of costs between stops.
using CostMatrix = std::vector<std::vector<double>>;

/// Stops that the tour must begin and end with, two different ones; -1: any.
struct TourEnds {
    int first = -1;
    int last = -1;
};

/// A short open tour through all stops: nearest neighbour, improved by reversing stretches (2-opt)
/// and moving short ones (Or-opt) until neither helps; then again and again two stretches swap
/// places, which stays where it ends in a shorter tour (iterated local search; Lourenco, Martin
/// and Stuetzle 2003). Only the nearest of each stop are looked at, so work grows little faster
/// than the number of stops. Deterministic. Costs must be symmetric and finite. A cancelled job
/// ends it early.
std::vector<int> shortTour(const CostMatrix& cost, const JobContext& job = {},
                           const TourEnds& ends = {});

double tourCost(const CostMatrix& cost, const std::vector<int>& tour);

}  // namespace dollytrack::planning
