#include "app/process/child_process.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <thread>

namespace {
bool stops_on_the_way = false;
volatile std::sig_atomic_t woken = 0;
}  // namespace

/// Replaces libc's execv() for every program that this test starts.
extern "C" int execv(const char* path, char* const* arguments) noexcept {
    if (stops_on_the_way) {
        // The starting process sends SIGCONT once; a stop before that would not last.
        while (woken == 0) usleep(1000);
        raise(SIGSTOP);
    }
    return execve(path, arguments, environ);
}

namespace dollytrack::child_process_test {
namespace {

using std::chrono::milliseconds;

std::optional<ProcessEnd> endOf(ChildProcess& process) {
    for (int i = 0; i < 1000 && !process.end(); ++i) std::this_thread::sleep_for(milliseconds(10));
    return process.end();
}

TEST(ChildProcess, TellsHowItsProgramEnded) {
    auto process = ChildProcess::start({"/bin/sh", "-c", "echo heard >&2; exit 7"});
    ASSERT_TRUE(process) << describe(process.error());
    const auto end = endOf(*process);
    ASSERT_TRUE(end);
    EXPECT_EQ(end->exit_code, 7);
    EXPECT_EQ(process->read(milliseconds(1000)), "heard\n");
}

TEST(ChildProcess, WhatCannotBeRunIsSaidAtOnce) {
    const auto process = ChildProcess::start({"/bin/no such program"});
    ASSERT_FALSE(process);
    EXPECT_EQ(process.error().where, "/bin/no such program");
}

// The starter can still end the stopped process or let it continue; waiting for it in start() would
// block both.
TEST(ChildProcess, OneThatIsStoppedBeforeItsProgramBeginsIsNotWaitedFor) {
    std::signal(SIGCONT, [](int) { woken = 1; });
    stops_on_the_way = true;
    auto process = ChildProcess::start({"/bin/sh", "-c", "exit 7"});
    auto killed = ChildProcess::start({"/bin/sh", "-c", "exit 7"});
    stops_on_the_way = false;
    ASSERT_TRUE(process && killed);
    EXPECT_FALSE(process->end());
    process->send(SIGCONT);
    killed->send(SIGKILL);
    const auto end = endOf(*process);
    ASSERT_TRUE(end);
    EXPECT_EQ(end->exit_code, 7);
    const auto killed_end = endOf(*killed);
    ASSERT_TRUE(killed_end);
    EXPECT_EQ(killed_end->signal, SIGKILL);
}

}  // namespace
}  // namespace dollytrack::child_process_test
