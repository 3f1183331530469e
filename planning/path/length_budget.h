#pragma once

#include "planning/path/tour.h"

#include <vector>

namespace dollytrack::planning {

/// A tour of one connected part of the roadmap, from which stops may be dropped. A stop is an index
/// into all members.
struct BudgetedTour {
    CostMatrix metres;                    // path lengths between stops, m; must satisfy the
                                          // triangle inequality
    CostMatrix cost;                      // cost that shortTour() minimises
    std::vector<std::vector<int>> shows;  // ids captured well at each stop; negative: not an object
                                          // but worth as much
    std::vector<std::vector<int>> shows_less;  // ids captured at each stop, including `shows`
    std::vector<bool> fixed;                   // never dropped
    TourEnds ends;                             // never dropped or moved
    std::vector<int> order;                    // the stops in visiting order
    std::vector<int> rank;  // by stop: rank among all tours, 0 is the most useful; may be empty
};

/// A choice of stops and their order, for all tours.
struct TourChoice {
    std::vector<std::vector<int>> orders;  // by tour
    double metres = 0.0;
    int stops = 0;
    double worth = 0.0;  // see keepWithinLength()
};

/// Adds a fixed copy of a stop, as the end of a closed tour. Returns its index.
int addCopyOfStop(BudgetedTour& tour, int stop);

/// Candidate solutions for all budgets up to `max_length_m`; most are at most 1.5 times as long.
/// Sorted by worth, then by length. The candidates for a smaller length are a subset of those for a
/// larger one, so that taking the first that fits a budget of metres or stops never gets worse with
/// a larger budget. Deterministic.
std::vector<TourChoice> tourChoices(const std::vector<BudgetedTour>& tours, double max_length_m,
                                    const std::vector<double>& weights = {});

/// Drops stops until all tours together are at most `max_length_m` long, by heuristics of the
/// orienteering problem: greedy removal by worth per metre, greedy insertion, and re-ordering, from
/// several starts. A larger length never gives a smaller worth. An object captured counts its
/// weight (index id - 1; 1 if `weights` is empty), one captured well four times that. Fixed stops
/// stay even if the length is exceeded; a tour may end up empty. Returns the worth. Deterministic.
double keepWithinLength(std::vector<BudgetedTour>& tours, double max_length_m,
                        const std::vector<double>& weights = {});

}  // namespace dollytrack::planning
