#include "planning/path/length_budget.h"

#include "engine/core/random.h"
#include "planning/pipeline/pipeline.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace dollytrack::planning::length_budget_test {
namespace {

constexpr int kObjects = 6;

/// Stops in a square of 10 x 10 m, each showing one or two objects.
BudgetedTour someStops(Random& random, std::size_t count) {
    BudgetedTour tour;
    std::vector<std::pair<double, double>> places;
    for (std::size_t i = 0; i < count; ++i) {
        places.emplace_back(random.uniform(0, 10), random.uniform(0, 10));
        std::set<int> ids = {static_cast<int>(random.uniform(0, kObjects)),
                             static_cast<int>(random.uniform(0, kObjects))};
        tour.shows.emplace_back(ids.begin(), ids.end());
    }
    tour.shows_less = tour.shows;
    tour.fixed.assign(count, false);
    tour.metres.assign(count, std::vector<double>(count));
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t j = 0; j < count; ++j) {
            tour.metres[i][j] =
                std::hypot(places[i].first - places[j].first, places[i].second - places[j].second);
        }
    }
    tour.cost = tour.metres;
    tour.order = shortTour(tour.cost);
    return tour;
}

int objectsShown(const BudgetedTour& tour, const std::vector<int>& stops) {
    std::set<int> ids;
    for (const int stop : stops) {
        const auto& shown = tour.shows[stop];
        ids.insert(shown.begin(), shown.end());
    }
    return static_cast<int>(ids.size());
}

/// The most objects that any order of any subset of the stops shows within the length, by trying
/// all.
int mostWithin(const BudgetedTour& tour, double max_length_m, std::vector<int>& stops,
               double length = 0.0) {
    int most = objectsShown(tour, stops);
    for (int next = 0; next < static_cast<int>(tour.metres.size()); ++next) {
        if (std::find(stops.begin(), stops.end(), next) != stops.end()) continue;
        const double step = stops.empty() ? 0.0 : tour.metres[stops.back()][next];
        if (length + step > max_length_m) continue;
        stops.push_back(next);
        most = std::max(most, mostWithin(tour, max_length_m, stops, length + step));
        stops.pop_back();
    }
    return most;
}

double lengthOf(const std::vector<BudgetedTour>& tours) {
    double sum = 0.0;
    for (const BudgetedTour& tour : tours) sum += tourCost(tour.metres, tour.order);
    return sum;
}

std::shared_ptr<const Plan> planned(double max_length_m, const PlanEdits& edits = {}) {
    PlanParams params;
    params.path.max_length_m = max_length_m;
    params.gaze.view_mix = 0.0;  // without a length budget the path goes through room views, too
    Pipeline pipeline(std::make_shared<const Scene>(test::furnishedRoom()));
    const auto plan = pipeline.run(params, edits, JobContext{});
    EXPECT_TRUE(plan.has_value());
    return plan ? *plan : nullptr;
}

}  // namespace

TEST(LengthBudget, ShowsNearlyAsMuchAsAnyWayOfThatLength) {
    Random random(1, 0);
    int shown = 0;
    int possible = 0;
    for (int run = 0; run < 30; ++run) {
        const BudgetedTour all = someStops(random, 7);
        const double whole = tourCost(all.metres, all.order);
        for (const double share : {0.2, 0.5, 0.8}) {
            std::vector<BudgetedTour> tours = {all};
            keepWithinLength(tours, share * whole);
            ASSERT_LE(lengthOf(tours), share * whole + 1e-9);
            std::vector<int> none;
            const int most = mostWithin(all, share * whole, none);
            EXPECT_LE(objectsShown(all, tours[0].order), most);
            shown += objectsShown(all, tours[0].order);
            possible += most;
        }
    }
    EXPECT_GE(shown, 0.99 * possible);
}

TEST(LengthBudget, WeightyObjectsAreReachedFirst) {
    // Stops along a line with the start in the middle: only one of the two sides fits the budget.
    BudgetedTour tour;
    const std::vector<double> at = {-5.0, 0.0, 5.0};
    tour.shows = {{1}, {}, {2}};
    tour.shows_less = tour.shows;
    tour.fixed = {false, true, false};
    for (const double a : at) {
        tour.metres.emplace_back();
        for (const double b : at) tour.metres.back().push_back(std::abs(a - b));
    }
    tour.cost = tour.metres;
    tour.order = {0, 1, 2};
    for (const std::vector<double>& weights : {std::vector{1.0, 3.0}, {3.0, 1.0}}) {
        std::vector<BudgetedTour> tours = {tour};
        keepWithinLength(tours, 6.0, weights);
        const int kept = weights[0] > weights[1] ? 0 : 2;
        EXPECT_NE(std::ranges::find(tours[0].order, kept), tours[0].order.end());
        EXPECT_EQ(tours[0].order.size(), 2U);
    }
}

TEST(LengthBudget, FixedStopsAndEndsStay) {
    Random random(2, 0);
    for (int run = 0; run < 30; ++run) {
        BudgetedTour tour = someStops(random, 9);
        tour.fixed[4] = true;
        tour.ends = {2, 7};
        tour.order = shortTour(tour.cost, {}, tour.ends);
        std::vector<BudgetedTour> tours = {tour};
        keepWithinLength(tours, 0.5 * lengthOf(tours));
        const std::vector<int>& order = tours[0].order;
        ASSERT_FALSE(order.empty());
        EXPECT_EQ(order.front(), 2);
        EXPECT_EQ(order.back(), 7);
        EXPECT_NE(std::find(order.begin(), order.end(), 4), order.end());
    }
}

TEST(LengthBudget, AClosedTourStillEndsWhereItBegins) {
    Random random(3, 0);
    BudgetedTour tour = someStops(random, 8);
    tour.ends = {1, addCopyOfStop(tour, 1)};
    tour.order = shortTour(tour.cost, {}, tour.ends);
    std::vector<BudgetedTour> tours = {tour};
    const double limit = 0.5 * lengthOf(tours);
    keepWithinLength(tours, limit);
    EXPECT_LE(lengthOf(tours), limit);
    EXPECT_EQ(tours[0].order.front(), 1);
    EXPECT_EQ(tours[0].order.back(), tour.ends.last);
}

// Two rooms share a length budget: it is spent in the room where it shows more objects.
TEST(LengthBudget, SpendsTheLengthWhereItShowsMore) {
    Random random(4, 0);
    BudgetedTour rich = someStops(random, 6);
    BudgetedTour poor = rich;
    for (std::size_t i = 0; i < poor.shows.size(); ++i) {
        rich.shows[i] = rich.shows_less[i] = {static_cast<int>(10 + i)};
        poor.shows[i] = poor.shows_less[i] = {99};
    }
    std::vector<BudgetedTour> tours = {rich, poor};
    keepWithinLength(tours, tourCost(rich.metres, rich.order));
    EXPECT_EQ(tours[0].order.size(), rich.order.size());
    EXPECT_EQ(tours[1].order.size(), 1U);
}

TEST(LengthBudget, APlanKeepsToIt) {
    const auto all = planned(0.0);
    ASSERT_TRUE(all);
    const double length = all->trajectory_metrics.path_length_m;
    int well = all->capture_metrics.well_captured;
    for (const double share : {0.8, 0.5, 0.2}) {
        const auto shorter = planned(share * length);
        ASSERT_TRUE(shorter);
        EXPECT_LE(shorter->trajectory_metrics.path_length_m, share * length);
        EXPECT_LT(shorter->capture_metrics.well_captured, well);
        well = shorter->capture_metrics.well_captured;
        EXPECT_GT(well, 0);
    }
    // A budget for which no key frame is left out changes nothing in the plan.
    const auto same = planned(10.0 * length);
    ASSERT_TRUE(same);
    EXPECT_EQ(same->trajectory_metrics.path_length_m, length);
}

TEST(LengthBudget, MoreMetresOrMoreStopsShowNoLess) {
    Random random(5, 0);
    const auto most = [](const std::vector<TourChoice>& choices, double metres, int stops) {
        for (const TourChoice& one : choices) {
            if (one.metres <= metres && one.stops <= stops) return one.worth;
        }
        return 0.0;
    };
    for (int run = 0; run < 20; ++run) {
        const BudgetedTour tour = someStops(random, 12);
        const double whole = tourCost(tour.metres, tour.order);
        std::vector<double> before(13, 0.0);
        for (double metres = 0.5; metres < 1.1 * whole; metres += random.uniform(0.01, 0.8)) {
            const auto choices = tourChoices({tour}, metres);
            for (int stops = 1; stops <= 12; ++stops) {
                const double worth = most(choices, metres, stops);
                EXPECT_GE(worth, before[stops]) << metres << " m";
                EXPECT_GE(worth, most(choices, metres, stops - 1));
                before[stops] = worth;
            }
        }
    }
}

// With the whole planner, in random rooms: what all key frames on the path show together.
TEST(LengthBudget, ALargerBudgetReachesNoLess) {
    Random random(6, 0);
    for (int run = 0; run < 3; ++run) {
        test::SceneBuilder builder;
        builder.room({0, 0, 0}, {random.uniform(4, 7), 4, 2.5});
        for (int i = 0; i < 14; ++i) {
            const double size = random.uniform(0.15, 0.6);
            builder.object("thing " + std::to_string(i))
                .box({random.uniform(0.5, 3.5), random.uniform(0.5, 3.5),
                      random.uniform(0.5 * size, 1.4)},
                     {size, size, size});
        }
        Pipeline pipeline(std::make_shared<const Scene>(builder.build()));
        const auto worth = [&](int max_frames, double max_length_m) {
            PlanParams params;
            params.timing.max_frames = max_frames;
            params.path.max_length_m = max_length_m;
            const auto plan = pipeline.run(params, JobContext{});
            EXPECT_TRUE(plan.has_value());
            EXPECT_LE((*plan)->trajectory_metrics.path_length_m, max_length_m);
            EXPECT_LE((*plan)->trajectory.frames.size(), static_cast<std::size_t>(max_frames));
            std::set<int> captured;
            std::set<int> well;
            for (const TrajectoryFrame& frame : (*plan)->trajectory.frames) {
                if (frame.position_point < 0) continue;
                const auto& point = (*plan)->position_points[frame.position_point];
                captured.insert(point.captured.begin(), point.captured.end());
                well.insert(point.well_captured.begin(), point.well_captured.end());
            }
            return 3 * well.size() + captured.size();
        };
        std::map<int, std::size_t> before;  // by frames
        for (double metres = 1.0; metres < 25.0; metres += random.uniform(0.3, 2.5)) {
            std::size_t with_fewer = 0;
            for (const int frames : {2, 3, 5, 6, 8, 11, 60}) {
                const std::size_t now = worth(frames, metres);
                EXPECT_GE(now, with_fewer) << frames << " frames, " << metres << " m";
                EXPECT_GE(now, before[frames]) << frames << " frames, " << metres << " m";
                with_fewer = before[frames] = now;
            }
        }
    }
}

TEST(LengthBudget, PinnedPointsStayInIt) {
    const auto all = planned(0.0);
    ASSERT_TRUE(all);
    ASSERT_FALSE(all->key_frames.empty());
    // The key frame that is left out first when nothing is pinned.
    const auto shorter = planned(0.3 * all->trajectory_metrics.path_length_m);
    ASSERT_TRUE(shorter);
    std::set<int> visited;
    for (const TrajectoryFrame& frame : shorter->trajectory.frames) {
        visited.insert(frame.position_point);
    }
    const auto left_out = std::find_if(shorter->key_frames.begin(), shorter->key_frames.end(),
                                       [&](int key) { return visited.count(key) == 0; });
    ASSERT_NE(left_out, shorter->key_frames.end());
    const auto& point = shorter->position_points[*left_out];
    PlanEdits edits;
    PinnedPoint pin;
    pin.name = "stays";
    pin.pose = point.pose;
    edits.pinned.push_back(pin);
    const auto pinned = planned(0.3 * all->trajectory_metrics.path_length_m, edits);
    ASSERT_TRUE(pinned);
    const bool there =
        std::any_of(pinned->trajectory.frames.begin(), pinned->trajectory.frames.end(),
                    [&](const TrajectoryFrame& frame) {
                        return (frame.pose.position - point.pose.position).norm() < 1e-9;
                    });
    EXPECT_TRUE(there);
}

}  // namespace dollytrack::planning::length_budget_test
