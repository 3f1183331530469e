#include "planning/path/tour.h"

#include "engine/core/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace dollytrack::planning::tour_test {
namespace {

/// Distances between positions in a square of 10 x 10 m.
CostMatrix distances(Random& random, std::size_t count) {
    std::vector<std::pair<double, double>> places(count);
    for (auto& [x, y] : places) {
        x = random.uniform(0, 10);
        y = random.uniform(0, 10);
    }
    CostMatrix cost(count, std::vector<double>(count, 0.0));
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t j = 0; j < count; ++j) {
            cost[i][j] =
                std::hypot(places[i].first - places[j].first, places[i].second - places[j].second);
        }
    }
    return cost;
}

/// Costs need not be distances, since paths go around obstacles: any symmetric matrix.
CostMatrix anyCosts(Random& random, std::size_t count) {
    CostMatrix cost(count, std::vector<double>(count, 0.0));
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t j = 0; j < i; ++j) cost[i][j] = cost[j][i] = random.uniform(1, 10);
    }
    return cost;
}

double costOf(const CostMatrix& cost, const std::vector<int>& order) {
    double sum = 0.0;
    for (std::size_t i = 1; i < order.size(); ++i) {
        sum += cost[order[i - 1]][order[i]];
    }
    return sum;
}

double leastOfAll(const CostMatrix& cost) {
    std::vector<int> order(cost.size());
    std::iota(order.begin(), order.end(), 0);
    double least = std::numeric_limits<double>::infinity();
    do {
        least = std::min(least, costOf(cost, order));
    } while (std::next_permutation(order.begin(), order.end()));
    return least;
}

void expectEveryStopOnce(std::vector<int> tour, std::size_t count) {
    ASSERT_EQ(tour.size(), count);
    std::sort(tour.begin(), tour.end());
    for (std::size_t i = 0; i < count; ++i) EXPECT_EQ(tour[i], static_cast<int>(i));
}

void expectNearlyShortest(const CostMatrix& cost) {
    const std::vector<int> tour = shortTour(cost);
    expectEveryStopOnce(tour, cost.size());
    const double least = leastOfAll(cost);
    EXPECT_LE(costOf(cost, tour), 1.1 * least);
    EXPECT_GE(costOf(cost, tour), least - 1e-9);
    EXPECT_NEAR(tourCost(cost, tour), costOf(cost, tour), 1e-9);
    EXPECT_EQ(shortTour(cost), tour);
}

}  // namespace

TEST(ShortTour, IsWithinATenthOfTheShortestOfAllOrders) {
    Random random(5);
    for (int i = 0; i < 40; ++i) {
        SCOPED_TRACE(i);
        expectNearlyShortest(distances(random, 7));
    }
}

TEST(ShortTour, SoItIsWhereCostsAreNoDistances) {
    Random random(6);
    for (int i = 0; i < 40; ++i) {
        SCOPED_TRACE(i);
        expectNearlyShortest(anyCosts(random, 7));
    }
}

TEST(ShortTour, VisitsEveryStopOfManyOnce) {
    Random random(7);
    expectEveryStopOnce(shortTour(distances(random, 60)), 60);
}

TEST(ShortTour, NoOneAndTwoStops) {
    EXPECT_TRUE(shortTour({}).empty());
    EXPECT_EQ(shortTour({{0.0}}), std::vector<int>{0});
    expectEveryStopOnce(shortTour({{0.0, 3.0}, {3.0, 0.0}}), 2);
    EXPECT_EQ(tourCost({}, {}), 0.0);
}

}  // namespace dollytrack::planning::tour_test
