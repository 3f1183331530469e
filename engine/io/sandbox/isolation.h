#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace dollytrack {

/// Limits of an importer; sizes in bytes.
inline constexpr std::uint64_t kMostAddressSpace = std::uint64_t{4} << 30U;  // without the scene
inline constexpr std::uint64_t kMostSerializedBytes = std::uint64_t{3} << 30U;
inline constexpr int kMostOpenFiles = 64;
inline constexpr int kMostThreads = 4;

/// Layers of isolation, as bits.
enum IsolationLayer : std::uint32_t {
    kLimits = 1U << 0U,       // rlimits, no new privileges, no core file, dies with its parent
    kFolderRules = 1U << 1U,  // Landlock: can only read files below the folders
    kCallFilter = 1U << 2U,   // seccomp: only system calls that reading needs
};

/// Isolates this process irrevocably: limits, then Landlock for `folders` and the files in them,
/// then seccomp. Must be called before any thread is created. A layer that the kernel or a
/// container refuses is skipped. Returns the layers that are not available.
[[nodiscard]] std::uint32_t isolateProcess(const std::vector<std::filesystem::path>& folders);

/// Lowers a resource limit of this process (RLIMIT_...); a stricter existing limit is kept. Returns
/// false if the system refuses.
[[nodiscard]] bool lowerLimit(int resource, std::uint64_t most);

/// "Landlock and seccomp", for the log.
[[nodiscard]] std::string layerNames(std::uint32_t layers);

}  // namespace dollytrack
