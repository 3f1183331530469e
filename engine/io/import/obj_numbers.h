#pragma once

#include <assimp/IOStream.hpp>

#include <cstdint>
#include <vector>

namespace dollytrack {

/// Whether a text has numbers without a digit before the point, ".5" or "-.5".
[[nodiscard]] bool hasBarePoints(const std::vector<std::uint8_t>& text);

/// The same text with a zero before each such point.
[[nodiscard]] std::vector<std::uint8_t> withLeadingZeros(const std::vector<std::uint8_t>& text);

/// The stream of an OBJ file as assimp can read it: assimp takes ".5" for no number and drops the
/// corner. Takes the stream over and returns it, or one of the mended text.
[[nodiscard]] Assimp::IOStream* mendObjNumbers(Assimp::IOStream* stream);

}  // namespace dollytrack
