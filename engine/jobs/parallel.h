#pragma once

#include <cstddef>
#include <functional>

namespace dollytrack {

/// Calls body(i) for 0 <= i < count on all worker threads. The body writes only what belongs to
/// its own i, so the result never depends on the number of threads or the order.
void parallelFor(std::size_t count, const std::function<void(std::size_t)>& body);

/// The same with ranges [begin, end) of at least `grain` items, for bodies that are short.
void parallelRanges(std::size_t count, std::size_t grain,
                    const std::function<void(std::size_t, std::size_t)>& body);

/// Limits the number of worker threads from now on; 0 means one per core.
void setThreadCount(int count);

}  // namespace dollytrack
