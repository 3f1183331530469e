#pragma once

#include "engine/core/result.h"

#include <cstdint>
#include <filesystem>
#include <vector>

namespace dollytrack::io {

/// A table of numbers, rows first.
struct Hdf5Numbers {
    std::vector<std::uint64_t> size;  // one to three lengths
    std::vector<double> values;       // as many as they multiply to
};

/// The dataset named "dataset" of an HDF5 file, of whatever type of number: Hypersim's files hold
/// nothing else. Errors: BadInput, also beyond 1e7 numbers.
Result<Hdf5Numbers> readHdf5Numbers(const std::filesystem::path& path);

}  // namespace dollytrack::io
