#include "engine/io/sandbox/processor_wait.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>

namespace dollytrack {
namespace {

/// Time in the run queue: the second number of schedstat, in nanoseconds.
ProcessorWait::Seconds waitOf(const std::filesystem::path& thread) {
    std::ifstream in(thread / "schedstat");
    std::uint64_t ran = 0;
    std::uint64_t waited = 0;
    if (!(in >> ran >> waited)) return ProcessorWait::Seconds{0.0};
    return std::chrono::nanoseconds(waited);
}

}  // namespace

ProcessorWait::ProcessorWait(pid_t process)
    : folder_("/proc/" + std::to_string(process) + "/task") {
    waitedSinceLastLook();
}

ProcessorWait::Seconds ProcessorWait::waitedSinceLastLook() {
    Seconds longest{0.0};
    std::error_code error;
    std::filesystem::directory_iterator thread(folder_, error);
    for (; !error && thread != std::filesystem::directory_iterator(); thread.increment(error)) {
        const Seconds waited = waitOf(thread->path());
        Seconds& before = of_thread_[thread->path().filename().string()];
        longest = std::max(longest, waited - before);
        before = std::max(before, waited);
    }
    return longest;
}

ProcessorWait::Seconds ProcessorWait::update() {
    const Seconds waited = waitedSinceLastLook();
    // The kernel counts a wait at its end, so it can be longer than the time between two samples.
    sum_ = std::min<Seconds>(sum_ + waited, Clock::now() - begin_);
    return sum_;
}

}  // namespace dollytrack
