#include "planning/path/time_budget.h"

#include <gtest/gtest.h>

namespace dollytrack::planning::time_budget_test {
namespace {

/// A straight path of at most 10 m, or of `max_length_m`.
Result<Paths> straight(double max_length_m) {
    const double length_m = max_length_m > 0.0 ? std::min(max_length_m, 10.0) : 10.0;
    return Paths{{}, {{0, 0, {{{0, 0, 0}}, {{length_m, 0, 0}}}}}};
}

double lengthOf(const Paths& found) {
    return found.paths.front().vertices.back().position.x();
}

/// The length found for 100 frames, where `frames` gives their number by the length.
double lengthFor100(const std::function<double(double)>& frames) {
    const auto found = pathsWithinFrames(
        {straight,
         [&](const Paths& paths) -> Result<std::size_t> { return frames(lengthOf(paths)); }},
        0.0, 100);
    return found && *found ? lengthOf(**found) : -1.0;
}

}  // namespace

TEST(PathsWithinFrames, AreTheLongestThatFit) {
    EXPECT_EQ(lengthFor100([](double length_m) { return 5.0 * length_m; }), 10.0);
    EXPECT_NEAR(lengthFor100([](double length_m) { return 25.0 * length_m; }), 4.0, 0.05);
    EXPECT_EQ(lengthFor100([](double) { return 101.0; }), -1.0);
}

// A stop with a large turn is left out beyond 3 m, and bisection ends before it.
TEST(PathsWithinFrames, MayBeLongerThanOneWithMoreFrames) {
    const double found_m = lengthFor100([](double length_m) {
        const bool has_turn = length_m > 2.0 && length_m < 3.0;
        return 25.0 * length_m + (has_turn ? 100.0 : 0.0);
    });
    EXPECT_GT(found_m, 3.0);
    EXPECT_LE(found_m, 4.0);
}

}  // namespace dollytrack::planning::time_budget_test
