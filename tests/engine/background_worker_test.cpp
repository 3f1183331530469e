#include "engine/jobs/background_worker.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <thread>

namespace dollytrack::background_worker_test {
namespace {

using namespace std::chrono_literals;

void waitUntil(const std::function<bool()>& condition) {
    for (int i = 0; i < 2000 && !condition(); ++i) std::this_thread::sleep_for(5ms);
    ASSERT_TRUE(condition());
}

TEST(BackgroundWorker, RunsWhatItIsGivenAndRests) {
    BackgroundWorker worker;
    LatestValue<int> results;
    worker.start([&](const JobContext&) { results.put(7); });
    waitUntil([&] { return !worker.state().busy; });
    EXPECT_EQ(results.take(), 7);
    EXPECT_EQ(results.take(), std::nullopt);
}

// After a hundred requests the running one is cancelled, and only the newest is run.
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

/// A clock that the test advances, for work in single steps.
struct FakeTime {
    std::atomic<std::int64_t> now_ms = 0;

    BackgroundWorker::Clock clock() {
        return [this] {
            return std::chrono::steady_clock::time_point(std::chrono::milliseconds(now_ms.load()));
        };
    }
};

/// Work of ten steps, each started by the test.
struct SteppedWork {
    std::atomic<int> steps_allowed = 0;
    std::atomic<int> steps_done = 0;  // steps of the running task
    std::atomic<int> all_steps_done = 0;
    std::atomic<int> finished = 0;
    std::atomic<int> dropped = 0;
    std::atomic<int> last_value = -1;
    static constexpr int kSteps = 10;

    BackgroundWorker::Work of(int value) {
        return [this, value](const JobContext& job) {
            steps_done = 0;
            for (int step = 1; step <= kSteps; ++step) {
                while (steps_allowed.load() == 0 && !job.cancelled()) std::this_thread::yield();
                if (job.cancelled()) {
                    ++dropped;
                    return;
                }
                --steps_allowed;
                job.report(static_cast<double>(step) / kSteps);
                steps_done = step;
                ++all_steps_done;
            }
            last_value = value;
            ++finished;
        };
    }
};

/// Changes a value every 20 ms for five seconds, while each task takes `piece_ms`. Returns the
/// number of finished tasks.
int finishedWhileDragging(int piece_ms, BackgroundWorker::GracePeriod grace_period) {
    FakeTime time;
    SteppedWork work;
    BackgroundWorker worker({}, grace_period, time.clock());
    const int step_ms = piece_ms / SteppedWork::kSteps;
    for (int now = 0; now <= 5000; now += 20) {
        time.now_ms = now;
        worker.start(work.of(now));
        if (now % step_ms != 0) continue;
        const int before = work.all_steps_done;
        ++work.steps_allowed;
        waitUntil([&] { return work.all_steps_done != before; });
    }
    const int finished = work.finished;
    work.steps_allowed = 100;
    worker.finish();
    EXPECT_EQ(work.last_value, 5000) << "the last value is what remains";
    return finished;
}

// While a slider is dragged for five seconds, there is a result at least once per second if a task
// takes less than that, but none if every change cancels.
TEST(BackgroundWorker, OutdatedWorkFinishesWithinItsGrace) {
    const BackgroundWorker::GracePeriod patient{std::chrono::milliseconds(900), 0.6};
    EXPECT_GE(finishedWhileDragging(600, patient), 5);
    EXPECT_GE(finishedWhileDragging(1000, patient), 4) << "near its end after the grace";
    EXPECT_EQ(finishedWhileDragging(600, {}), 0);
    EXPECT_EQ(finishedWhileDragging(4000, patient), 0) << "too slow: the newest value comes first";
}

TEST(BackgroundWorker, OutdatedWorkThatHasPutOutItsResultMakesWay) {
    FakeTime time;
    SteppedWork work;
    BackgroundWorker worker({}, {std::chrono::milliseconds(900), 0.6}, time.clock());
    worker.start(work.of(1));
    work.steps_allowed = 5;
    waitUntil([&] { return work.steps_done == 5; });
    worker.cancelOutdated();
    EXPECT_EQ(work.dropped, 0) << "nothing newer waits";
    worker.start(work.of(2));
    worker.cancelOutdated();
    waitUntil([&] { return work.dropped == 1; });
    work.steps_allowed = 10;
    worker.finish();
    EXPECT_EQ(work.last_value, 2);
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
}  // namespace dollytrack::background_worker_test
