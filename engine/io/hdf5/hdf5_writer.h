#pragma once

#include "engine/core/result.h"

#include <cstdint>
#include <string>
#include <vector>

namespace dollytrack {

enum class Hdf5Type { Uint8, Uint16, Float32 };

/// An array in C order, to be a dataset of an HDF5 file.
struct Hdf5Array {
    std::string name;
    Hdf5Type type = Hdf5Type::Uint8;
    std::vector<std::uint64_t> shape;
    const void* values = nullptr;  // of the shape's size; the caller's
};

/// A text, to be a scalar dataset.
struct Hdf5Text {
    std::string name;
    std::string text;  // not empty
};

/// The bytes of an HDF5 file with these datasets, arrays compressed. They contain no time stamp, so
/// equal input gives equal bytes. May be called from any thread. Failed if memory
/// runs out or the library is missing (see missingHdf5()).
[[nodiscard]] Result<std::vector<std::uint8_t>> packHdf5(const std::vector<Hdf5Array>& arrays,
                                                         const std::vector<Hdf5Text>& texts);

}  // namespace dollytrack
