#include "engine/io/sandbox/processor_wait.h"

#include "engine/io/sandbox/reading_clock.h"

#include <gtest/gtest.h>

#include <sched.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>

namespace dollytrack::processor_wait_test {
namespace {

using Seconds = ProcessorWait::Seconds;

/// A process that computes or sleeps on one processor until this object is destroyed.
class Child {
  public:
    Child(int processor, bool computes) : process_(::fork()) {
        if (process_ != 0) return;
        cpu_set_t one;
        CPU_ZERO(&one);
        CPU_SET(processor, &one);
        ::sched_setaffinity(0, sizeof(one), &one);
        while (true) {
            // A system call, which the compiler cannot remove.
            if (computes) {
                ::getppid();
            } else {
                ::pause();
            }
        }
    }
    ~Child() {
        ::kill(process_, SIGKILL);
        ::waitpid(process_, nullptr, 0);
    }
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;
    [[nodiscard]] pid_t process() const { return process_; }

  private:
    pid_t process_;
};

int anyProcessor() {
    cpu_set_t mine;
    CPU_ZERO(&mine);
    ::sched_getaffinity(0, sizeof(mine), &mine);
    for (int i = 0; i < CPU_SETSIZE; ++i) {
        if (CPU_ISSET(i, &mine)) return i;
    }
    return 0;
}

bool kernelCounts() {
    std::ifstream in("/proc/self/schedstat");
    std::uint64_t ran = 0;
    return static_cast<bool>(in >> ran) && ran > 0;
}

bool isAsleep(pid_t process) {
    std::ifstream in("/proc/" + std::to_string(process) + "/stat");
    const std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
    const std::size_t state = text.rfind(") ");
    return state != std::string::npos && text.substr(state + 2, 1) == "S";
}

// Four processes on one processor wait for each other; a sleeping one does not wait. There is no
// time limit, because on a busy machine samples may be late.
TEST(ProcessorWait, IsWhatOthersTook) {
    if (!kernelCounts()) GTEST_SKIP() << "the kernel does not count it";
#ifdef __SANITIZE_THREAD__
    GTEST_SKIP() << "ThreadSanitizer's own thread runs in the idle process";
#endif
    const int processor = anyProcessor();
    const Child one(processor, true);
    const Child two(processor, true);
    const Child three(processor, true);
    const Child four(processor, true);
    const Child idle(processor, false);
    while (!isAsleep(idle.process())) std::this_thread::sleep_for(std::chrono::milliseconds(1));

    const auto begin = std::chrono::steady_clock::now();
    ProcessorWait of_one(one.process());
    ProcessorWait of_idle(idle.process());
    Seconds busy{0.0};
    Seconds passed{0.0};
    while (busy < Seconds(0.3) && passed < Seconds(60.0)) {
        std::this_thread::sleep_for(std::chrono::milliseconds(25));
        busy = of_one.update();
        passed = std::chrono::steady_clock::now() - begin;
        ASSERT_LE(busy, passed);
    }
    EXPECT_GE(busy, Seconds(0.3)) << "in " << passed.count() << " s";
    EXPECT_EQ(of_idle.update(), Seconds(0.0));
}

TEST(ReadingClock, StandsStillWhileOthersHaveTheProcessors) {
    ReadingClock clock;
    const Seconds before = clock.left();
    clock.waited(Seconds{1000.0});
    EXPECT_GT(clock.left(), before + Seconds{999.0});
    EXPECT_EQ(clock.allowed(), ReadingClock::kStart);
}

TEST(ReadingClock, GivesALargeFileMoreTime) {
    ReadingClock clock;
    clock.opened(0);
    EXPECT_DOUBLE_EQ(clock.allowed().count(), 2.0);
    clock.opened(1U << 19U);
    EXPECT_DOUBLE_EQ(clock.allowed().count(), 7.0);
    clock.opened(5U << 19U);
    EXPECT_DOUBLE_EQ(clock.allowed().count(), 2.0 + 10.0 + 2.0 * 2.0);
    clock.opened(std::uint64_t{1} << 50U);
    EXPECT_DOUBLE_EQ(clock.allowed().count(), 900.0);
}

TEST(ReadingClock, CountsFromTheFirstFile) {
    ReadingClock clock;
    clock.waited(ReadingClock::Seconds(100.0));
    EXPECT_GT(clock.left().count(), 105.0);
    clock.opened(0);
    EXPECT_LE(clock.left().count(), 2.0);
    clock.waited(ReadingClock::Seconds(101.0));
    EXPECT_GT(clock.left().count(), 2.0);
}

}  // namespace
}  // namespace dollytrack::processor_wait_test
