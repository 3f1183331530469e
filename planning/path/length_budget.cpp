#include "planning/path/length_budget.h"

#include "engine/jobs/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

namespace dollytrack::planning {
namespace {

constexpr double kWell = 3.0;       // additional worth of an object captured well
constexpr int kRounds = 4;          // of re-ordering and insertion
constexpr double kLeast = 1e-9;     // smaller lengths are rounding
constexpr std::size_t kSeeds = 16;  // single stops from which tours are grown
constexpr std::array<double, 2> kAppetites = {1.0, 2.0};  // exponents of worth in worth per metre
constexpr double kWorthOnly = 8.0;  // exponent for cases where stops are limited, not metres
constexpr int kRungs = 32;          // number of lengths for which tours are made, up to the whole
constexpr double kRungShape = 1.5;  // exponent of their spacing; above 1: denser at short lengths
constexpr double kBeyond = 1.5;     // relative to the requested length, since walks skip corners of
                                    // the roadmap's paths

double lengthOf(const BudgetedTour& tour) {
    return tourCost(tour.metres, tour.order);
}

/// Shortens the order of the same stops, if possible.
void reorder(BudgetedTour& tour) {
    CostMatrix cost(tour.order.size(), std::vector<double>(tour.order.size()));
    const auto at = [](const CostMatrix& matrix, int a, int b) { return matrix[a][b]; };
    for (std::size_t i = 0; i < tour.order.size(); ++i) {
        for (std::size_t j = 0; j < tour.order.size(); ++j) {
            cost[i][j] = at(tour.cost, tour.order[i], tour.order[j]);
        }
    }
    const auto place = [&](int stop) {
        const auto found = std::find(tour.order.begin(), tour.order.end(), stop);
        return stop < 0 ? -1 : static_cast<int>(found - tour.order.begin());
    };
    std::vector<int> order;
    for (const int i : shortTour(cost, {}, {place(tour.ends.first), place(tour.ends.last)}))
        order.push_back(tour.order[i]);
    // An order with less cost, which includes turning, may be longer in metres.
    if (tourCost(tour.metres, order) < lengthOf(tour)) tour.order = std::move(order);
}

class Budget {
  public:
    Budget(std::vector<BudgetedTour>& tours, double max_length_m,
           const std::vector<double>& weights, double appetite = 1.0)
        : tours_(tours), max_(max_length_m), weights_(weights), appetite_(appetite) {
        for (const BudgetedTour& tour : tours_) {
            for (const int stop : tour.order) count(tour, stop, 1);
            length_ += lengthOf(tour);
        }
    }

    /// Removes stops from the complete tours down to the length.
    void shrink() {
        leaveOut();
        fill();
    }

    /// Inserts stops up to the length, starting from the fixed stops and one more. `seed` numbers
    /// the stops of all tours; a number past the last adds none.
    void grow(std::size_t seed, std::vector<TourChoice>* on_the_way = nullptr) {
        on_the_way_ = on_the_way;
        std::size_t number = 0;
        length_ = 0.0;
        for (BudgetedTour& tour : tours_) {
            std::erase_if(tour.order, [&](int stop) {
                if (number++ == seed || stays(tour, stop)) return false;
                count(tour, stop, -1);
                return true;
            });
            length_ += lengthOf(tour);
        }
        fill();
    }

    /// Removes stops one by one down to the fixed ones, those with the least worth of their own
    /// first. Records each state.
    void leaveOutOneByOne(std::vector<TourChoice>& on_the_way) {
        const auto shown = [this](const BudgetedTour& tour, int stop, double metres) {
            return std::optional(Rank(worthOf(tour, stop, 1), -metres));
        };
        while (dropOne(shown)) on_the_way.push_back(choice());
    }

    /// As leaveOutOneByOne(), but drops stops in reverse order of rank.
    void leaveOutByRank(std::vector<TourChoice>& on_the_way) {
        const auto last = [](const BudgetedTour& tour, int stop, double metres) {
            return std::optional(Rank(-static_cast<double>(tour.rank[stop]), -metres));
        };
        while (dropOne(last)) on_the_way.push_back(choice());
    }

    /// Inserts stops in the order of the shortest detours, up to the length. Records each state.
    void takeInNearest(std::vector<TourChoice>& on_the_way) {
        on_the_way_ = &on_the_way;
        appetite_ = 0.0;
        takeIn();
    }

    [[nodiscard]] TourChoice choice() const {
        TourChoice made{{}, length_, 0, worth()};
        for (const BudgetedTour& tour : tours_) {
            made.orders.push_back(tour.order);
            made.stops += static_cast<int>(tour.order.size());
        }
        return made;
    }

    [[nodiscard]] bool fits() const { return length_ <= max_; }

    /// Sum of the weights of all objects shown.
    [[nodiscard]] double worth() const {
        const auto shown = [this](const std::map<int, int>& stops) {
            double sum = 0.0;
            for (const auto& [id, count] : stops) sum += count > 0 ? weightOf(id) : 0.0;
            return sum;
        };
        return kWell * shown(well_) + shown(captured_);
    }

  private:
    struct Choice {
        std::size_t tour = 0;
        std::size_t at = 0;  // position in the tour's order
        int stop = -1;       // -1: none
        double metres = 0.0;
        double worth = 0.0;  // worth per metre
    };

    [[nodiscard]] double weightOf(int id) const {
        return weights_.empty() || id <= 0 ? 1.0 : weights_[id - 1];
    }

    void count(const BudgetedTour& tour, int stop, int sign) {
        for (const int id : tour.shows[stop]) well_[id] += sign;
        for (const int id : tour.shows_less[stop]) captured_[id] += sign;
    }

    /// Worth of the stop's objects that at most `others` stops of the tours show.
    double worthOf(const BudgetedTour& tour, int stop, int others) {
        double sum = 0.0;
        for (const int id : tour.shows[stop]) {
            sum += well_[id] <= others ? kWell * weightOf(id) : 0.0;
        }
        for (const int id : tour.shows_less[stop]) {
            sum += captured_[id] <= others ? weightOf(id) : 0.0;
        }
        return sum;
    }

    /// Metres that a stop between two neighbours adds; -1: no neighbour.
    static double detour(const BudgetedTour& tour, int before, int stop, int after) {
        const auto metres = [&](int a, int b) { return a < 0 || b < 0 ? 0.0 : tour.metres[a][b]; };
        return metres(before, stop) + metres(stop, after) - metres(before, after);
    }

    static int stopAt(const BudgetedTour& tour, std::size_t at) {
        return at < tour.order.size() ? tour.order[at] : -1;
    }

    static bool stays(const BudgetedTour& tour, int stop) {
        return tour.fixed[stop] || stop == tour.ends.first || stop == tour.ends.last;
    }

    using Rank = std::pair<double, double>;  // the stop with the least rank is dropped first

    /// Drops the stop with the least rank that is not fixed. `rankOf(tour, stop, metres of its
    /// detour)` returns nothing for stops that must stay. Returns false if no stop can be dropped.
    template <class RankOf>
    bool dropOne(const RankOf& rankOf) {
        Choice least;
        Rank least_rank;
        for (std::size_t t = 0; t < tours_.size(); ++t) {
            const BudgetedTour& tour = tours_[t];
            for (std::size_t i = 0; i < tour.order.size(); ++i) {
                const int stop = tour.order[i];
                if (stays(tour, stop)) continue;
                const double metres =
                    detour(tour, i > 0 ? tour.order[i - 1] : -1, stop, stopAt(tour, i + 1));
                const std::optional<Rank> rank = rankOf(tour, stop, metres);
                if (!rank || (least.stop >= 0 && *rank >= least_rank)) continue;
                least = {t, i, stop, metres};
                least_rank = *rank;
            }
        }
        if (least.stop < 0) return false;
        BudgetedTour& tour = tours_[least.tour];
        tour.order.erase(tour.order.begin() + static_cast<std::ptrdiff_t>(least.at));
        count(tour, least.stop, -1);
        length_ -= least.metres;
        return true;
    }

    /// Drops stops down to the length, those with the least worth per metre first.
    void leaveOut() {
        const auto shown_a_metre = [this](const BudgetedTour& tour, int stop,
                                          double metres) -> std::optional<Rank> {
            if (metres <= kLeast) return std::nullopt;
            return Rank(std::pow(worthOf(tour, stop, 1), appetite_) / metres, 0.0);
        };
        while (length_ > max_ && dropOne(shown_a_metre)) {
        }
    }

    void fill() {
        for (int round = 0; round < kRounds; ++round) {
            shorten();
            if (!takeIn()) return;
        }
    }

    /// Inserts stops while one fits. Returns whether any was inserted.
    bool takeIn() {
        bool any = false;
        while (true) {
            Choice best;
            for (std::size_t t = 0; t < tours_.size(); ++t) considerLeftOut(t, best);
            if (best.stop < 0) return any;
            BudgetedTour& tour = tours_[best.tour];
            tour.order.insert(tour.order.begin() + static_cast<std::ptrdiff_t>(best.at), best.stop);
            count(tour, best.stop, 1);
            length_ += best.metres;
            any = true;
            if (on_the_way_) on_the_way_->push_back(choice());
        }
    }

    void considerLeftOut(std::size_t t, Choice& best) {
        const BudgetedTour& tour = tours_[t];
        std::vector<bool> in(tour.metres.size(), false);
        for (const int stop : tour.order) in[stop] = true;
        for (std::size_t s = 0; s < in.size(); ++s) {
            const int stop = static_cast<int>(s);
            const double value = in[s] ? 0.0 : worthOf(tour, stop, 0);
            if (value <= 0.0) continue;
            const std::size_t first = tour.ends.first >= 0 ? 1 : 0;
            const std::size_t last = tour.order.size() - (tour.ends.last >= 0 ? 1 : 0);
            for (std::size_t i = first; i <= last; ++i) {
                const double metres =
                    detour(tour, i > 0 ? tour.order[i - 1] : -1, stop, stopAt(tour, i));
                if (length_ + metres > max_) continue;
                const double a_metre = std::pow(value, appetite_) / std::max(metres, kLeast);
                if (best.stop >= 0 && a_metre <= best.worth) continue;
                best = {t, i, stop, metres, a_metre};
            }
        }
    }

    void shorten() {
        length_ = 0.0;
        for (BudgetedTour& tour : tours_) {
            reorder(tour);
            length_ += lengthOf(tour);
        }
    }

    std::vector<BudgetedTour>& tours_;
    double max_;
    const std::vector<double>& weights_;  // by object, at index id - 1
    double appetite_;                     // exponent of worth; 0: only short detours count
    double length_ = 0.0;
    std::vector<TourChoice>* on_the_way_ = nullptr;  // receives the state after every insertion
    std::map<int, int> well_;                        // by object: number of stops that show it
    std::map<int, int> captured_;
};

}  // namespace

int addCopyOfStop(BudgetedTour& tour, int stop) {
    const std::size_t of = stop;
    for (CostMatrix* matrix : {&tour.metres, &tour.cost}) {
        for (std::vector<double>& row : *matrix) row.push_back(row[of]);
        matrix->push_back((*matrix)[of]);
    }
    tour.shows.emplace_back();
    tour.shows_less.emplace_back();
    tour.fixed.push_back(true);
    if (!tour.rank.empty()) tour.rank.push_back(tour.rank[of]);
    return static_cast<int>(tour.fixed.size()) - 1;
}

namespace {

/// The lengths for which tours are made. They do not depend on the budget, so that budgets share
/// them.
std::vector<double> rungsUpTo(double max_length_m, double whole_m) {
    std::vector<double> rungs;
    for (int i = 0; i <= kRungs; ++i) {
        const double rung = whole_m * std::pow(static_cast<double>(i) / kRungs, kRungShape);
        if (rung > kBeyond * max_length_m) break;
        rungs.push_back(rung);
    }
    return rungs;
}

/// All candidate solutions for one length.
std::vector<TourChoice> choicesAt(const std::vector<BudgetedTour>& tours, double rung,
                                  double next_rung, const std::vector<double>& weights) {
    std::size_t stops = 0;
    for (const BudgetedTour& tour : tours) stops += tour.order.size();
    const std::size_t seeds = std::min(kSeeds, stops);
    // For each exponent: remove from all stops, insert from none, and insert from single stops.
    const std::size_t ways = 2 + seeds;
    std::vector<std::vector<TourChoice>> tries(kAppetites.size() * ways + 1);
    parallelFor(tries.size(), [&](std::size_t i) {
        std::vector<BudgetedTour> tried = tours;
        const bool worth_only = i + 1 == tries.size();
        Budget budget(tried, rung, weights, worth_only ? kWorthOnly : kAppetites[i / ways]);
        const std::size_t way = worth_only ? 1 : i % ways;
        if (way == 0) {
            budget.shrink();
        } else if (way == 1) {
            budget.grow(stops, &tries[i]);
        } else {
            budget.grow((way - 2) * stops / seeds);
        }
        tries[i].push_back(budget.choice());
    });
    std::vector<TourChoice> all;
    std::size_t best = 0;
    for (auto& tried : tries) {
        for (TourChoice& one : tried) {
            all.push_back(std::move(one));
            if (all.back().worth > all[best].worth) best = all.size() - 1;
        }
    }
    // Variants with fewer stops, and with a slightly larger length.
    std::vector<BudgetedTour> from = tours;
    for (std::size_t t = 0; t < from.size(); ++t) from[t].order = all[best].orders[t];
    std::vector<BudgetedTour> up = from;
    Budget(from, rung, weights).leaveOutOneByOne(all);
    Budget(up, next_rung, weights).takeInNearest(all);
    return all;
}

}  // namespace

std::vector<TourChoice> tourChoices(const std::vector<BudgetedTour>& tours, double max_length_m,
                                    const std::vector<double>& weights) {
    std::vector<BudgetedTour> all = tours;
    Budget whole(all, max_length_m, weights);
    std::vector<TourChoice> choices = {whole.choice()};
    const bool ranked =
        std::ranges::none_of(tours, [](const BudgetedTour& tour) { return tour.rank.empty(); });
    const double whole_m = choices.front().metres;
    if (ranked) whole.leaveOutByRank(choices);
    const std::vector<double> rungs = rungsUpTo(max_length_m, whole_m);
    for (std::size_t i = 0; i < rungs.size(); ++i) {
        const double next = whole_m * std::pow(static_cast<double>(i + 1) / kRungs, kRungShape);
        auto more = choicesAt(tours, rungs[i], next, weights);
        std::ranges::move(more, std::back_inserter(choices));
    }
    std::ranges::stable_sort(choices, [](const TourChoice& a, const TourChoice& b) {
        return std::pair(-a.worth, a.metres) < std::pair(-b.worth, b.metres);
    });
    return choices;
}

double keepWithinLength(std::vector<BudgetedTour>& tours, double max_length_m,
                        const std::vector<double>& weights) {
    const std::vector<TourChoice> choices = tourChoices(tours, max_length_m, weights);
    auto best = std::ranges::find_if(
        choices, [&](const TourChoice& one) { return one.metres <= max_length_m; });
    // The fixed stops may exceed the length.
    if (best == choices.end()) best = std::ranges::min_element(choices, {}, &TourChoice::metres);
    for (std::size_t t = 0; t < tours.size(); ++t) tours[t].order = best->orders[t];
    return best->worth;
}

}  // namespace dollytrack::planning
