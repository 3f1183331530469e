#include "engine/jobs/job_phases.h"
#include "engine/jobs/progress_estimate.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace dollytrack::job_progress_test {
namespace {

using Clock = ProgressEstimate::Clock;

Clock::time_point at(double seconds) {
    return Clock::time_point{} +
           std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

}  // namespace

TEST(JobPhases, ShareTheProgressByWeight) {
    std::vector<std::pair<double, std::string>> reports;
    const JobPhases phases(
        JobContext({}, [&](double fraction,
                           std::string_view stage) { reports.emplace_back(fraction, stage); })
            .stage(0.5, 1.0, "all"),
        {{"first", 1.0}, {"left out", 0.0}, {"last", 3.0}});
    phases.of("first").report(1.0);
    phases.of("left out").report(0.5);
    phases.of("last").report(0.5);
    phases.of("last").report(1.0);
    phases.of("unknown").report(0.0);
    EXPECT_EQ(reports, (std::vector<std::pair<double, std::string>>{{0.625, "first"},
                                                                    {0.625, "left out"},
                                                                    {0.8125, "last"},
                                                                    {1.0, "last"},
                                                                    {1.0, "unknown"}}));
}

TEST(ProgressEstimate, NeverFallsNorExceedsOne) {
    ProgressEstimate estimate(at(0.0));
    EXPECT_EQ(estimate.add(0.3, at(1.0)), 0.3);
    EXPECT_EQ(estimate.add(0.1, at(2.0)), 0.3);
    EXPECT_EQ(estimate.add(0.4, at(3.0)), 0.4);
    EXPECT_EQ(estimate.add(1.2, at(4.0)), 1.0);
    EXPECT_EQ(estimate.secondsLeft(at(5.0)), 0.0);
}

TEST(ProgressEstimate, TimeLeftOfSteadyWorkIsExact) {
    ProgressEstimate estimate(at(0.0));
    EXPECT_EQ(estimate.secondsLeft(at(0.0)), std::nullopt);
    estimate.add(0.01, at(1.0));
    EXPECT_EQ(estimate.secondsLeft(at(1.0)), std::nullopt);
    for (int second = 2; second <= 100; ++second) {
        estimate.add(0.01 * second, at(second));
        if (second == 2) continue;  // too early to tell
        ASSERT_NEAR(*estimate.secondsLeft(at(second)), 100.0 - second, 1e-6);
    }
}

// 10 s for the first half of the progress, 100 s for the other.
TEST(ProgressEstimate, TimeLeftFollowsASlowerPhase) {
    ProgressEstimate estimate(at(0.0));
    for (int i = 1; i <= 50; ++i) estimate.add(0.01 * i, at(0.2 * i));
    EXPECT_NEAR(*estimate.secondsLeft(at(10.0)), 10.0, 1e-6);
    for (int i = 1; i <= 50; ++i) {
        const double now = 10.0 + 2.0 * i;
        estimate.add(0.5 + 0.01 * i, at(now));
        if (now < 20.0) continue;
        ASSERT_NEAR(*estimate.secondsLeft(at(now)), 110.0 - now, 10.0) << now;
    }
    EXPECT_NEAR(*estimate.secondsLeft(at(60.0)), 0.0, 1e-6);
}

TEST(ProgressEstimate, TimeLeftRisesSteadilyWhileNothingMoves) {
    ProgressEstimate estimate(at(0.0));
    for (int i = 1; i <= 10; ++i) estimate.add(0.05 * i, at(i));
    double before = *estimate.secondsLeft(at(10.0));
    for (int second = 11; second <= 60; ++second) {
        estimate.add(0.5, at(second));
        const double left = *estimate.secondsLeft(at(second));
        ASSERT_GE(left, before - 1e-6) << second;
        ASSERT_LT(left, before + 3.5) << second;
        before = left;
    }
}

}  // namespace dollytrack::job_progress_test
