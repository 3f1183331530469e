#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace dollytrack::io {

/// What an importer may use at most.
inline constexpr std::uint64_t kMostAddressSpace = std::uint64_t{4} << 30U;  // bytes, frame apart
inline constexpr std::uint64_t kMostFrameBytes = std::uint64_t{3} << 30U;
inline constexpr int kMostOpenFiles = 64;
inline constexpr int kMostThreads = 4;

/// Layers of isolation, as bits.
enum IsolationLayer : std::uint32_t {
    kLimits = 1U << 0U,       // rlimits, no new privileges, no core file, ends with its parent
    kFolderRules = 1U << 1U,  // Landlock: reads beneath the folders, nothing else of the files
    kCallFilter = 1U << 2U,   // seccomp: only what reading needs
};

/// Locks this process up, for good: limits, then Landlock for `folders` (and the files in them),
/// then seccomp. Call it before the first thread is made. A layer that the kernel or a container
/// refuses is left out; returns the layers that could not be had.
[[nodiscard]] std::uint32_t isolateProcess(const std::vector<std::filesystem::path>& folders);

/// "Landlock and seccomp", for the log.
[[nodiscard]] std::string layerNames(std::uint32_t layers);

}  // namespace dollytrack::io
