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

/// The bytes of plain values, in the machine's order.
template <class Value>
std::span<const std::uint8_t> bytesOf(const std::vector<Value>& values) {
    static_assert(std::is_trivially_copyable_v<Value>);
    return {reinterpret_cast<const std::uint8_t*>(values.data()), sizeof(Value) * values.size()};
}

/// A share of 0 to 1 in the steps of 16 bits.
inline std::uint16_t inSteps(double share) {
    return static_cast<std::uint16_t>(65535.0 * std::clamp(share, 0.0, 1.0) + 0.5);
}

/// A unit normal in the three values of a pixel, (n + 1) / 2 each.
inline void putNormal(const Eigen::Vector3d& normal, std::uint16_t* pixel) {
    for (int axis = 0; axis < 3; ++axis) pixel[axis] = inSteps(0.5 * (normal[axis] + 1.0));
}

/// One file, of bytes that may not have come to be.
inline Result<std::vector<FrameFile>> oneFile(std::string path,
                                              Result<std::vector<std::uint8_t>> bytes) {
    if (!bytes) return tl::unexpected<Error>(std::move(bytes.error()));
    std::vector<FrameFile> files;
    files.push_back({std::move(path), std::move(*bytes)});
    return files;
}

}  // namespace dollytrack::render
