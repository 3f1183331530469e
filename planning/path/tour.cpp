#include "planning/path/tour.h"

#include "engine/core/random.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace dollytrack::planning {
namespace {

constexpr std::size_t kNeighbours = 8;
constexpr double kGain = 1e-9;    // smaller gains are rounding
constexpr double kNever = 1e6;    // cost of a wrong end
constexpr int kLongestMoved = 3;  // most stops of a segment that Or-opt moves
constexpr int kKicksPerStop = 4;
constexpr std::uint32_t kKicked = 30;  // most stops of a segment that a kick swaps with the next
                                       // one

/// By stop, its nearest stops. Any shorter tour has a link to one of them where the old tour has a
/// longer link, so most pairs need not be tested.
std::vector<std::vector<int>> nearestOf(const CostMatrix& cost) {
    const std::size_t count = std::min(kNeighbours, cost.size() - 1);
    std::vector<std::vector<int>> nearest(cost.size());
    std::vector<int> others(cost.size());
    for (std::size_t i = 0; i < cost.size(); ++i) {
        std::iota(others.begin(), others.end(), 0);
        others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
        const auto end = others.begin() + static_cast<std::ptrdiff_t>(count);
        const auto nearer = [&](int a, int b) {
            return std::pair(cost[i][a], a) < std::pair(cost[i][b], b);
        };
        std::partial_sort(others.begin(), end, others.end(), nearer);
        nearest[i].assign(others.begin(), end);
        others.resize(cost.size());
    }
    return nearest;
}

/// A tour that is improved by reversing segments. All changes are reversals, so that they can be
/// undone.
class Tour {
  public:
    Tour(const CostMatrix& cost, const TourEnds& ends)
        : cost_(cost),
          ends_(ends),
          nearest_(nearestOf(cost)),
          at_(cost.size()),
          waits_(cost.size(), false) {
        goToNearest(ends.first >= 0 ? ends.first : 0);
    }

    void improve(const JobContext& job) {
        for (const int stop : stops_) lookAt(stop);
        settle();
        Random random(1);
        const auto count = static_cast<std::uint32_t>(stops_.size());
        const int kicks = count < 4 ? 0 : kKicksPerStop * static_cast<int>(count);
        for (int kick = 0; kick < kicks && !job.cancelled(); ++kick) {
            done_.clear();
            gained_ = 0.0;
            swapStretches(random);
            settle();
            if (gained_ >= -kGain) continue;
            for (auto undo = done_.rbegin(); undo != done_.rend(); ++undo) {
                turnRound(undo->first, undo->second);
            }
        }
    }

    [[nodiscard]] const std::vector<int>& stops() const { return stops_; }

  private:
    void goToNearest(int start) {
        std::vector<bool> used(cost_.size(), false);
        const auto take = [&](int stop) {
            stops_.push_back(stop);
            used[stop] = true;
        };
        take(start);
        const bool last_waits = ends_.last >= 0 && start != ends_.last;
        if (last_waits) used[ends_.last] = true;
        while (stops_.size() + (last_waits ? 1 : 0) < cost_.size()) {
            int best = -1;
            for (int i = 0; i < static_cast<int>(cost_.size()); ++i) {
                if (used[i]) continue;
                if (best < 0 || link(stops_.back(), i) < link(stops_.back(), best)) best = i;
            }
            take(best);
        }
        if (last_waits) take(ends_.last);
        for (std::size_t i = 0; i < stops_.size(); ++i) {
            at_[stops_[i]] = static_cast<int>(i);
        }
    }

    /// Cost of the step between two stops. Before the first and after the last stop (-1) it is 0,
    /// or kNever at a wrong end.
    [[nodiscard]] double link(int a, int b) const { return cost_[a][b]; }
    [[nodiscard]] double firstAt(int stop) const {
        return ends_.first < 0 || ends_.first == stop ? 0.0 : kNever;
    }
    [[nodiscard]] double lastAt(int stop) const {
        return ends_.last < 0 || ends_.last == stop ? 0.0 : kNever;
    }
    [[nodiscard]] double step(int from, int to) const {
        if (from < 0) return to < 0 ? 0.0 : firstAt(to);
        return to < 0 ? lastAt(from) : link(from, to);
    }
    [[nodiscard]] int stop(int i) const {
        return i < 0 || i >= static_cast<int>(stops_.size()) ? -1 : stops_[i];
    }
    [[nodiscard]] int place(int stop) const { return at_[stop]; }

    void turnRound(int i, int j) {
        for (; i < j; ++i, --j) {
            std::swap(stops_[i], stops_[j]);
            at_[stop(i)] = i;
            at_[stop(j)] = j;
        }
    }
    void reverse(int i, int j) {
        if (i >= j) return;
        turnRound(i, j);
        done_.emplace_back(i, j);
    }
    void lookAt(int stop) {
        if (stop < 0 || waits_[stop]) return;
        waits_[stop] = true;
        waiting_.push_back(stop);
    }

    /// Repeats local moves until none near a changed stop improves the tour.
    void settle() {
        while (!waiting_.empty()) {
            const int stop = waiting_.back();
            waiting_.pop_back();
            waits_[stop] = false;
            while (reverseFrom(stop) || moveFrom(stop)) continue;
        }
    }

    /// Gain of reversing the segment from position i to j.
    [[nodiscard]] double gainOfReversal(int i, int j) const {
        return step(stop(i - 1), stop(i)) + step(stop(j), stop(j + 1)) -
               step(stop(i - 1), stop(j)) - step(stop(i), stop(j + 1));
    }

    bool tryReversal(int i, int j) {
        if (i >= j) return false;
        const double gain = gainOfReversal(i, j);
        if (gain <= kGain) return false;
        for (const int k : {i - 1, i, j, j + 1}) lookAt(stop(k));
        reverse(i, j);
        gained_ += gain;
        return true;
    }

    /// Makes one of its nearest stops a neighbour of the stop, by one reversal (2-opt).
    bool reverseFrom(int a) {
        const int i = place(a);
        // A shorter tour has a new link that is shorter than an old one at the same stop.
        const double longest = std::max(step(stop(i - 1), a), step(a, stop(i + 1)));
        for (const int c : nearest_[a]) {
            if (link(a, c) >= longest) break;
            const int j = place(c);
            const auto [low, high] = std::minmax(i, j);
            if (tryReversal(low + 1, high) || tryReversal(low, high - 1)) return true;
        }
        return false;
    }

    /// Moves a short segment that ends at the stop next to one of its nearest stops (Or-opt).
    bool moveFrom(int a) {
        for (int length = 1; length <= kLongestMoved; ++length) {
            for (const bool to_the_right : {true, false}) {
                const int first = to_the_right ? place(a) : place(a) - length + 1;
                const int last = first + length - 1;
                if (first < 0 || last >= static_cast<int>(stops_.size())) continue;
                const int before = stop(first - 1);
                const int after = stop(last + 1);
                const double freed =
                    step(before, stop(first)) + step(stop(last), after) - step(before, after);
                for (const int c : nearest_[a]) {
                    if (link(a, c) >= freed) break;
                    const int j = place(c);
                    if (j >= first && j <= last) continue;
                    if (tryMove(first, last, j) || tryMove(first, last, j - 1)) return true;
                }
            }
        }
        return false;
    }

    /// Moves the segment between positions j and j + 1, in the cheaper direction.
    bool tryMove(int first, int last, int j) {
        if (j >= first - 1 && j <= last) return false;
        const int before = stop(first - 1);
        const int after = stop(last + 1);
        const double freed = step(before, stop(first)) + step(stop(last), after) -
                             step(before, after) + step(stop(j), stop(j + 1));
        const double straight = step(stop(j), stop(first)) + step(stop(last), stop(j + 1));
        const double turned = step(stop(j), stop(last)) + step(stop(first), stop(j + 1));
        const double gain = freed - std::min(straight, turned);
        if (gain <= kGain) return false;
        for (const int k : {first - 1, first, last, last + 1, j, j + 1}) lookAt(stop(k));
        const int length = last - first + 1;
        if (j > last) {
            // Swap the segment and the stops it passes: reverse both together, then each.
            reverse(first, j);
            reverse(first, j - length);
            if (straight <= turned) reverse(j - length + 1, j);
        } else {
            reverse(j + 1, last);
            reverse(j + 1 + length, last);
            if (straight <= turned) reverse(j + 1, j + length);
        }
        gained_ += gain;
        return true;
    }

    /// Swaps two adjacent segments (double bridge), which single moves above cannot undo.
    void swapStretches(Random& random) {
        const auto count = static_cast<std::uint32_t>(stops_.size());
        const std::uint32_t most = std::min(kKicked, (count - 2) / 2);
        const auto one = static_cast<int>(1 + random.below(most));
        const auto other = static_cast<int>(1 + random.below(most));
        const auto i =
            static_cast<int>(1 + random.below(count - 1 - static_cast<std::uint32_t>(one + other)));
        const int middle = i + one - 1;
        const int j = middle + other;
        gained_ += step(stop(i - 1), stop(i)) + step(stop(middle), stop(middle + 1)) +
                   step(stop(j), stop(j + 1)) - step(stop(i - 1), stop(middle + 1)) -
                   step(stop(j), stop(i)) - step(stop(middle), stop(j + 1));
        for (const int k : {i - 1, i, middle, middle + 1, j, j + 1}) lookAt(stop(k));
        reverse(i, j);
        reverse(i, i + other - 1);
        reverse(i + other, j);
    }

    const CostMatrix& cost_;
    TourEnds ends_;
    std::vector<std::vector<int>> nearest_;
    std::vector<int> stops_;
    std::vector<int> at_;  // position in the tour, by stop
    std::vector<int> waiting_;
    std::vector<bool> waits_;
    std::vector<std::pair<int, int>> done_;  // reversals since the last kick
    double gained_ = 0.0;
};

}  // namespace

double tourCost(const CostMatrix& cost, const std::vector<int>& tour) {
    double sum = 0.0;
    for (std::size_t i = 1; i < tour.size(); ++i) {
        sum += cost[tour[i - 1]][tour[i]];
    }
    return sum;
}

std::vector<int> shortTour(const CostMatrix& cost, const JobContext& job, const TourEnds& ends) {
    if (cost.empty()) return {};
    Tour tour(cost, ends);
    tour.improve(job);
    return tour.stops();
}

}  // namespace dollytrack::planning
