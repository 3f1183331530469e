#include "engine/jobs/parallel.h"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <exception>
#include <memory>

namespace dollytrack {

void parallelFor(std::size_t count, const std::function<void(std::size_t)>& body) {
    parallelRanges(count, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) body(i);
    });
}

void parallelRanges(std::size_t count, std::size_t grain,
                    const std::function<void(std::size_t, std::size_t)>& body) {
    // Exceptions must not pass through TBB: if memory ran out before all its threads were started,
    // it crashes while cancelling the other tasks.
    std::atomic<bool> failed = false;
    std::exception_ptr first;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain), [&](const auto& range) {
        if (failed.load(std::memory_order_relaxed)) return;
        try {
            body(range.begin(), range.end());
        } catch (...) {
            if (!failed.exchange(true)) first = std::current_exception();
        }
    });
    if (first) std::rethrow_exception(first);
}

void setThreadCount(int count) {
    static std::unique_ptr<tbb::global_control> control;
    control.reset();
    if (count > 0) {
        control = std::make_unique<tbb::global_control>(
            tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(count));
    }
}

}  // namespace dollytrack
