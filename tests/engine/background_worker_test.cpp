#include "engine/jobs/background_worker.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <thread>

namespace dollytrack {
namespace {

using namespace std::chrono_literals;

void waitUntil(const std::function<bool()>& condition) {
    for (int i = 0; i < 2000 && !condition(); ++i) std::this_thread::sleep_for(5ms);
    ASSERT_TRUE(condition());
}

TEST(BackgroundWorker, RunsWhatItIsGivenAndRests) {
    BackgroundWorker worker;
    Outbox<int> results;
    worker.start([&](const JobContext&) { results.put(7); });
    waitUntil([&] { return !worker.state().busy; });
    EXPECT_EQ(results.take(), 7);
    EXPECT_EQ(results.take(), std::nullopt);
}

// Of a hundred requests in a row the running one is cancelled, and only the newest follows it.
TEST(BackgroundWorker, NewestRequestWins) {
    BackgroundWorker worker;
    std::atomic<int> started = 0;
    std::atomic<int> cancelled = 0;
    std::atomic<int> last = -1;
    std::atomic<bool> first_runs = false;
    for (int i = 0; i < 100; ++i) {
        worker.start([&, i](const JobContext& job) {
            ++started;
            if (i == 0) {
                first_runs = true;
                while (!job.cancelled()) std::this_thread::sleep_for(1ms);
                ++cancelled;
            }
            last = i;
        });
        if (i == 0) waitUntil([&] { return first_runs.load(); });
    }
    waitUntil([&] { return !worker.state().busy; });
    EXPECT_EQ(last, 99);
    EXPECT_EQ(cancelled, 1);
    EXPECT_LT(started, 100);
}

TEST(BackgroundWorker, CancelsAndWaitsAtItsEnd) {
    std::atomic<bool> ended = false;
    {
        BackgroundWorker worker;
        std::atomic<bool> runs = false;
        worker.start([&](const JobContext& job) {
            runs = true;
            while (!job.cancelled()) std::this_thread::sleep_for(1ms);
            ended = true;
        });
        waitUntil([&] { return runs.load(); });
    }
    EXPECT_TRUE(ended);
}

TEST(BackgroundWorker, TellsProgressAndWakes) {
    std::atomic<int> woken = 0;
    std::atomic<bool> go_on = false;
    BackgroundWorker worker([&] { ++woken; });
    worker.start([&](const JobContext& job) {
        job.stage(0.5, 1.0, "second half").report(0.5);
        while (!go_on) std::this_thread::sleep_for(1ms);
    });
    waitUntil([&] { return worker.state().fraction > 0.0; });
    EXPECT_DOUBLE_EQ(worker.state().fraction, 0.75);
    EXPECT_EQ(worker.state().stage, "second half");
    EXPECT_GE(woken, 1);
    go_on = true;
    waitUntil([&] { return !worker.state().busy; });
}

}  // namespace
}  // namespace dollytrack
