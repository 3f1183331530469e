#pragma once

#include "engine/core/result.h"
#include "render/frames/frame_file.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace dollytrack::render {

/// The bytes of trivially copyable values, in native byte order.
template <class Value>
std::span<const std::uint8_t> bytesOf(const std::vector<Value>& values) {
    static_assert(std::is_trivially_copyable_v<Value>);
    return {reinterpret_cast<const std::uint8_t*>(values.data()), sizeof(Value) * values.size()};
}

/// Quantises 0..1 to 16 bits.
inline std::uint16_t inSteps(double share) {
    return static_cast<std::uint16_t>(65535.0 * std::clamp(share, 0.0, 1.0) + 0.5);
}

/// Encodes a unit normal as (n + 1) / 2 in the three channels of a pixel.
inline void putNormal(const Eigen::Vector3d& normal, std::uint16_t* pixel) {
    for (int axis = 0; axis < 3; ++axis) pixel[axis] = inSteps(0.5 * (normal[axis] + 1.0));
}

/// A list of one file, or the error of its bytes.
inline Result<std::vector<FrameFile>> oneFile(std::string path,
                                              Result<std::vector<std::uint8_t>> bytes) {
    if (!bytes) return tl::unexpected(std::move(bytes.error()));
    std::vector<FrameFile> files;
    files.push_back({std::move(path), std::move(*bytes)});
    return files;
}

}  // namespace dollytrack::render
