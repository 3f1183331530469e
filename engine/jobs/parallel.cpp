#include "engine/jobs/parallel.h"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <memory>
#include <thread>
#include <vector>

namespace dollytrack {
namespace {

using RangeBody = std::function<void(std::size_t, std::size_t)>;

#ifdef __SANITIZE_THREAD__
std::atomic<int> thread_limit = 4;

/// Stands in for TBB in builds with ThreadSanitizer, which does not see the synchronisation inside
/// a TBB that is built without it and would report races in all parallel code. A call within
/// another one runs on the calling thread.
void runOnThreads(std::size_t count, std::size_t grain, const RangeBody& body) {
    thread_local bool inside = false;
    grain = std::max<std::size_t>(grain, 1);
    const auto pieces = (count + grain - 1) / grain;
    const auto threads = std::min<std::size_t>(static_cast<std::size_t>(thread_limit), pieces);
    if (inside || threads < 2) {
        if (count > 0) body(0, count);
        return;
    }
    std::atomic<std::size_t> next = 0;
    std::vector<std::thread> workers;
    for (std::size_t i = 0; i < threads; ++i) {
        workers.emplace_back([&] {
            inside = true;
            for (std::size_t piece = next++; piece < pieces; piece = next++) {
                body(piece * grain, std::min(count, (piece + 1) * grain));
            }
        });
    }
    for (std::thread& worker : workers) worker.join();
}
#else
void runOnThreads(std::size_t count, std::size_t grain, const RangeBody& body) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain),
                      [&](const auto& range) { body(range.begin(), range.end()); });
}
#endif

}  // namespace

void parallelFor(std::size_t count, const std::function<void(std::size_t)>& body) {
    parallelRanges(count, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) body(i);
    });
}

void parallelRanges(std::size_t count, std::size_t grain,
                    const std::function<void(std::size_t, std::size_t)>& body) {
    // An exception must not pass through TBB: it crashes while it cancels the other tasks if memory
    // ran out before all of its threads were there.
    std::atomic<bool> failed = false;
    std::exception_ptr first;
    runOnThreads(count, grain, [&](std::size_t begin, std::size_t end) {
        if (failed.load(std::memory_order_relaxed)) return;
        try {
            body(begin, end);
        } catch (...) {
            if (!failed.exchange(true)) first = std::current_exception();
        }
    });
    if (first) std::rethrow_exception(first);
}

void setThreadCount(int count) {
#ifdef __SANITIZE_THREAD__
    thread_limit = count > 0 ? count : 4;
#endif
    static std::unique_ptr<tbb::global_control> control;
    control.reset();
    if (count > 0) {
        control = std::make_unique<tbb::global_control>(
            tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(count));
    }
}

}  // namespace dollytrack
