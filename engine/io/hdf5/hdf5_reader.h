#pragma once

#include "engine/core/result.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace dollytrack {

/// A table of numbers, rows first.
struct Hdf5Numbers {
    std::vector<std::uint64_t> size;  // one to three lengths
    std::vector<double> values;       // as many as they multiply to
};

/// Returns a sentence if the HDF5 library is not installed, else null. Readers and the writer load
/// it at their first use. Safe to call from many threads.
[[nodiscard]] const char* missingHdf5();

/// A dataset of an HDF5 file, of whatever type of number; Hypersim's files hold one, named
/// "dataset". From any thread. Errors: BadInput, also beyond `most` numbers.
Result<Hdf5Numbers> readHdf5Numbers(const std::filesystem::path& path,
                                    const std::string& name = "dataset",
                                    std::uint64_t most = 10'000'000);

/// A text of fixed length, up to 16 MiB. From any thread. Error: BadInput.
Result<std::string> readHdf5Text(const std::filesystem::path& path, const std::string& name);

}  // namespace dollytrack
