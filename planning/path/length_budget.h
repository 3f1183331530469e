#pragma once

#include "planning/path/tour.h"

#include <vector>

namespace dollytrack::planning {

/// A tour of one connected part that may have to leave out stops. A stop is an index into the
/// matrices and into `shows` and `fixed`.
struct BudgetedTour {
    CostMatrix metres;                    // between stops; a triangle's side never exceeds the rest
    CostMatrix cost;                      // what shortTour() weighs
    std::vector<std::vector<int>> shows;  // ids of what each stop captures well; below 0: no object
    std::vector<std::vector<int>> shows_less;  // ids of what it captures, those included
    std::vector<bool> fixed;                   // stays whatever it costs
    TourEnds ends;                             // stay, too, and where they are
    std::vector<int> order;                    // the stops in turn
    std::vector<int> rank;  // of each stop among all tours', the most useful first; may be empty
};

/// One way to go through some of the stops of all tours.
struct TourChoice {
    std::vector<std::vector<int>> orders;  // by tour
    double metres = 0.0;
    int stops = 0;
    double worth = 0.0;  // see keepWithinLength()
};

/// Adds a stop at the same place as another, to end a closed tour at; it stays in. The new index.
int addCopyOfStop(BudgetedTour& tour, int stop);

/// Ways worth a look for any budget up to that length, most of them no longer than one and a half
/// times it, the worthiest first and of those the shortest. A smaller length gives a part of what a
/// larger one gives, so that whoever takes the first that fits a budget of metres, of stops or of
/// both loses nothing by a larger budget. Deterministic.
std::vector<TourChoice> tourChoices(const std::vector<BudgetedTour>& tours, double max_length_m,
                                    const std::vector<double>& weights = {});

/// Shortens tours until together they are no longer than `max_length_m` (a heuristic of the
/// orienteering problem): from all stops down, leaving out those that save the most metres for the
/// objects lost, or from none or from one up, taking in those that show the most a metre; the best
/// of tourChoices(). A larger length never shows less. An object captured counts by its weight, of
/// index id - 1, and four times when captured well; without weights all count alike. Fixed stops
/// stay, so a budget may be too small to keep; a tour may end up without stops. Returns the sum of
/// what counts. Deterministic.
double keepWithinLength(std::vector<BudgetedTour>& tours, double max_length_m,
                        const std::vector<double>& weights = {});

}  // namespace dollytrack::planning
