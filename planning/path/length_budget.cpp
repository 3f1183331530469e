#include "planning/path/length_budget.h"

#include "engine/jobs/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace dollytrack::planning {
namespace {

constexpr double kWell = 3.0;       // what an object captured well is worth beside its capture
constexpr int kRounds = 4;          // of shortening and taking in again
constexpr double kLeast = 1e-9;     // metres below are rounding
constexpr std::size_t kSeeds = 16;  // stops to grow from, besides none
constexpr std::array<double, 2> kAppetites = {1.0, 2.0};  // exponents of worth over metres

double lengthOf(const BudgetedTour& tour) {
    return tourCost(tour.metres, tour.order);
}

/// The order through the same stops again, shorter where it can be.
void reorder(BudgetedTour& tour) {
    CostMatrix cost(tour.order.size(), std::vector<double>(tour.order.size()));
    const auto at = [](const CostMatrix& matrix, int a, int b) {
        return matrix[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)];
    };
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
        order.push_back(tour.order[static_cast<std::size_t>(i)]);
    // What is shorter by the weighed cost, which counts turns, may be longer in metres.
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

    /// From all stops down to the length.
    void shrink() {
        leaveOut();
        fill();
    }

    /// From the stops that have to stay, and one more, up to the length. `seed` counts the stops of
    /// all tours in their order; beyond the last there is none more.
    void grow(std::size_t seed) {
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

    [[nodiscard]] bool fits() const { return length_ <= max_; }

    /// Of all that is shown.
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
        std::size_t at = 0;  // in its order
        int stop = -1;       // -1: none
        double metres = 0.0;
        double worth = 0.0;  // of objects a metre
    };

    [[nodiscard]] double weightOf(int id) const {
        return weights_.empty() || id <= 0 ? 1.0 : weights_[static_cast<std::size_t>(id) - 1];
    }

    void count(const BudgetedTour& tour, int stop, int sign) {
        for (const int id : tour.shows[static_cast<std::size_t>(stop)]) well_[id] += sign;
        for (const int id : tour.shows_less[static_cast<std::size_t>(stop)]) captured_[id] += sign;
    }

    /// What the stop alone shows, when that many others at the most show it too.
    double worthOf(const BudgetedTour& tour, int stop, int others) {
        double sum = 0.0;
        for (const int id : tour.shows[static_cast<std::size_t>(stop)]) {
            sum += well_[id] <= others ? kWell * weightOf(id) : 0.0;
        }
        for (const int id : tour.shows_less[static_cast<std::size_t>(stop)]) {
            sum += captured_[id] <= others ? weightOf(id) : 0.0;
        }
        return sum;
    }

    /// Metres that a stop between two neighbours adds; -1: no neighbour.
    static double detour(const BudgetedTour& tour, int before, int stop, int after) {
        const auto metres = [&](int a, int b) {
            return a < 0 || b < 0
                       ? 0.0
                       : tour.metres[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)];
        };
        return metres(before, stop) + metres(stop, after) - metres(before, after);
    }

    static int stopAt(const BudgetedTour& tour, std::size_t at) {
        return at < tour.order.size() ? tour.order[at] : -1;
    }

    static bool stays(const BudgetedTour& tour, int stop) {
        return tour.fixed[static_cast<std::size_t>(stop)] || stop == tour.ends.first ||
               stop == tour.ends.last;
    }

    void leaveOut() {
        while (length_ > max_) {
            Choice least;
            for (std::size_t t = 0; t < tours_.size(); ++t) {
                const BudgetedTour& tour = tours_[t];
                for (std::size_t i = 0; i < tour.order.size(); ++i) {
                    const int stop = tour.order[i];
                    if (stays(tour, stop)) continue;
                    const double metres =
                        detour(tour, i > 0 ? tour.order[i - 1] : -1, stop, stopAt(tour, i + 1));
                    if (metres <= kLeast) continue;
                    const double a_metre = std::pow(worthOf(tour, stop, 1), appetite_) / metres;
                    if (least.stop >= 0 && a_metre >= least.worth) continue;
                    least = {t, i, stop, metres, a_metre};
                }
            }
            if (least.stop < 0) return;
            BudgetedTour& tour = tours_[least.tour];
            tour.order.erase(tour.order.begin() + static_cast<std::ptrdiff_t>(least.at));
            count(tour, least.stop, -1);
            length_ -= least.metres;
        }
    }

    void fill() {
        for (int round = 0; round < kRounds; ++round) {
            shorten();
            if (!takeIn()) return;
        }
    }

    /// True when a stop came back.
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
        }
    }

    void considerLeftOut(std::size_t t, Choice& best) {
        const BudgetedTour& tour = tours_[t];
        std::vector<bool> in(tour.metres.size(), false);
        for (const int stop : tour.order) in[static_cast<std::size_t>(stop)] = true;
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
    const std::vector<double>& weights_;  // by object, id - 1
    double appetite_;                     // for worth rather than for short detours
    double length_ = 0.0;
    std::map<int, int> well_;  // by object, how many stops show it
    std::map<int, int> captured_;
};

}  // namespace

int addCopyOfStop(BudgetedTour& tour, int stop) {
    const auto of = static_cast<std::size_t>(stop);
    for (CostMatrix* matrix : {&tour.metres, &tour.cost}) {
        for (std::vector<double>& row : *matrix) row.push_back(row[of]);
        matrix->push_back((*matrix)[of]);
    }
    tour.shows.emplace_back();
    tour.shows_less.emplace_back();
    tour.fixed.push_back(true);
    return static_cast<int>(tour.fixed.size()) - 1;
}

double keepWithinLength(std::vector<BudgetedTour>& tours, double max_length_m,
                        const std::vector<double>& weights) {
    const Budget all(tours, max_length_m, weights);
    if (all.fits()) return all.worth();
    std::size_t stops = 0;
    for (const BudgetedTour& tour : tours) stops += tour.order.size();
    const std::size_t seeds = std::min(kSeeds, stops);
    // For each appetite: from all down, from none up, and from single stops along the tour up.
    const std::size_t ways = 2 + seeds;
    struct Try {
        std::vector<BudgetedTour> tours;
        bool fits = false;
        double worth = 0.0;
    };
    std::vector<Try> tries(kAppetites.size() * ways);
    parallelFor(tries.size(), [&](std::size_t i) {
        Try& one = tries[i];
        one.tours = tours;
        Budget budget(one.tours, max_length_m, weights, kAppetites[i / ways]);
        const std::size_t way = i % ways;
        if (way == 0) {
            budget.shrink();
        } else {
            budget.grow(way == 1 ? stops : (way - 2) * stops / seeds);
        }
        one.fits = budget.fits();
        one.worth = budget.worth();
    });
    // What has to stay may be too long whatever is done: then from all down.
    std::size_t best = 0;
    for (std::size_t i = 1; i < tries.size(); ++i) {
        if (tries[i].fits && (!tries[best].fits || tries[i].worth > tries[best].worth)) best = i;
    }
    tours = std::move(tries[best].tours);
    return tries[best].worth;
}

}  // namespace dollytrack::planning
