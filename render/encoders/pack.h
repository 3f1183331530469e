#pragma once

#include "engine/core/result.h"
#include "render/frame_file.h"

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

/// One file, of bytes that may not have come to be.
inline Result<std::vector<FrameFile>> oneFile(std::string path,
                                              Result<std::vector<std::uint8_t>> bytes) {
    if (!bytes) return tl::unexpected<Error>(std::move(bytes.error()));
    std::vector<FrameFile> files;
    files.push_back({std::move(path), std::move(*bytes)});
    return files;
}

}  // namespace dollytrack::render
