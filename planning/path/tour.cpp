#include "planning/path/tour.h"

#include "engine/jobs/parallel.h"

#include <algorithm>
#include <limits>

namespace dollytrack::planning {
namespace {

constexpr std::size_t kStarts = 8;
constexpr double kGain = 1e-9;  // smaller improvements are rounding
constexpr int kRounds = 60;
constexpr double kNever = 1e6;  // cost of an end that is not the one asked for

class Tour {
  public:
    Tour(const CostMatrix& cost, std::size_t start, const TourEnds& ends)
        : cost_(cost), ends_(ends) {
        std::vector<bool> used(cost.size(), false);
        stops_.push_back(static_cast<int>(start));
        used[start] = true;
        const bool last_waits = ends.last >= 0 && stops_.front() != ends.last;
        if (last_waits) used[static_cast<std::size_t>(ends.last)] = true;
        while (stops_.size() + (last_waits ? 1 : 0) < cost.size()) {
            std::size_t best = 0;
            double least = std::numeric_limits<double>::infinity();
            for (std::size_t i = 0; i < cost.size(); ++i) {
                const double step = between(stops_.back(), static_cast<int>(i));
                if (used[i] || step >= least) continue;
                least = step;
                best = i;
            }
            stops_.push_back(static_cast<int>(best));
            used[best] = true;
        }
        if (last_waits) stops_.push_back(ends.last);
    }

    std::vector<int> improved(const JobContext& job) && {
        for (int round = 0; round < kRounds && !job.cancelled(); ++round) {
            const bool reversed = reverseStretches();
            const bool moved = moveStretches();
            if (!reversed && !moved) break;
        }
        return std::move(stops_);
    }

  private:
    [[nodiscard]] double between(int a, int b) const {
        return cost_[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)];
    }
    /// Cost of the step from stop i - 1 to stop i; none before the first and after the last, but
    /// for wrong ends.
    [[nodiscard]] double link(int from, int to) const {
        const auto end = [](int wanted, int is) {
            return wanted < 0 || wanted == is ? 0.0 : kNever;
        };
        if (from < 0 && to < 0) return 0.0;
        if (from < 0) return end(ends_.first, to);
        return to < 0 ? end(ends_.last, from) : between(from, to);
    }
    [[nodiscard]] int stop(std::ptrdiff_t i) const {
        return i < 0 || i >= static_cast<std::ptrdiff_t>(stops_.size())
                   ? -1
                   : stops_[static_cast<std::size_t>(i)];
    }

    bool reverseStretches() {
        bool any = false;
        const auto n = static_cast<std::ptrdiff_t>(stops_.size());
        for (std::ptrdiff_t i = 0; i < n - 1; ++i) {
            for (std::ptrdiff_t j = i + 1; j < n; ++j) {
                const double before = link(stop(i - 1), stop(i)) + link(stop(j), stop(j + 1));
                const double after = link(stop(i - 1), stop(j)) + link(stop(i), stop(j + 1));
                if (after >= before - kGain) continue;
                std::reverse(stops_.begin() + i, stops_.begin() + j + 1);
                any = true;
            }
        }
        return any;
    }

    bool moveStretches() {
        bool any = false;
        for (std::ptrdiff_t length = 1; length <= 3; ++length) {
            for (std::ptrdiff_t i = 0; i + length <= static_cast<std::ptrdiff_t>(stops_.size());
                 ++i) {
                any |= moveStretch(i, length);
            }
        }
        return any;
    }

    bool moveStretch(std::ptrdiff_t i, std::ptrdiff_t length) {
        const int first = stop(i);
        const int last = stop(i + length - 1);
        const double freed = link(stop(i - 1), first) + link(last, stop(i + length)) -
                             link(stop(i - 1), stop(i + length));
        std::vector<int> rest = stops_;
        const std::vector<int> piece(rest.begin() + i, rest.begin() + i + length);
        rest.erase(rest.begin() + i, rest.begin() + i + length);
        double least = freed - kGain;
        std::ptrdiff_t best = -1;
        bool best_reversed = false;
        for (std::ptrdiff_t at = 0; at <= static_cast<std::ptrdiff_t>(rest.size()); ++at) {
            const int before = at > 0 ? rest[static_cast<std::size_t>(at - 1)] : -1;
            const int after = at < static_cast<std::ptrdiff_t>(rest.size())
                                  ? rest[static_cast<std::size_t>(at)]
                                  : -1;
            for (const bool reversed : {false, true}) {
                const double added = link(before, reversed ? last : first) +
                                     link(reversed ? first : last, after) - link(before, after);
                if (added >= least) continue;
                least = added;
                best = at;
                best_reversed = reversed;
            }
        }
        if (best < 0) return false;
        if (best_reversed) {
            rest.insert(rest.begin() + best, piece.rbegin(), piece.rend());
        } else {
            rest.insert(rest.begin() + best, piece.begin(), piece.end());
        }
        stops_ = std::move(rest);
        return true;
    }

    const CostMatrix& cost_;
    TourEnds ends_;
    std::vector<int> stops_;
};

}  // namespace

double tourCost(const CostMatrix& cost, const std::vector<int>& tour) {
    double sum = 0.0;
    for (std::size_t i = 1; i < tour.size(); ++i) {
        sum += cost[static_cast<std::size_t>(tour[i - 1])][static_cast<std::size_t>(tour[i])];
    }
    return sum;
}

std::vector<int> shortTour(const CostMatrix& cost, const JobContext& job, const TourEnds& ends) {
    const std::size_t starts = ends.first >= 0 ? 1 : std::min(kStarts, cost.size());
    std::vector<std::vector<int>> tours(starts);
    parallelFor(starts, [&](std::size_t s) {
        const std::size_t start =
            ends.first >= 0 ? static_cast<std::size_t>(ends.first) : s * cost.size() / starts;
        tours[s] = Tour(cost, start, ends).improved(job);
    });
    std::vector<int> best;
    double least = std::numeric_limits<double>::infinity();
    for (std::vector<int>& tour : tours) {
        const double length = tourCost(cost, tour);
        if (length >= least) continue;
        least = length;
        best = std::move(tour);
    }
    return best;
}

}  // namespace dollytrack::planning
