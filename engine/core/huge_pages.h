#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace dollytrack {

/// Resizes an empty vector that will be filled at once. Where it is large its memory comes in pages
/// of 2 MiB if the system has some: a million vertices else cost ten thousand page faults.
template <class T>
void resizeLarge(std::vector<T>& values, std::size_t size) {
    constexpr std::uintptr_t kPage = std::uintptr_t{2} << 20U;
    values.reserve(size);
    const auto begin = reinterpret_cast<std::uintptr_t>(values.data());
    const std::uintptr_t first = (begin + kPage - 1) / kPage * kPage;
    const std::uintptr_t end = (begin + size * sizeof(T)) / kPage * kPage;
    // Only a wish: small pages do as well.
    if (end > first) ::madvise(reinterpret_cast<void*>(first), end - first, MADV_HUGEPAGE);
    values.resize(size);
}

}  // namespace dollytrack
