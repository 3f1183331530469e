#pragma once

#include <assimp/IOStream.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace dollytrack {

/// Whether a text has numbers without a digit before the point, ".5" or "-.5".
[[nodiscard]] bool hasBarePoints(const std::vector<std::uint8_t>& text);

/// The same text with a zero before each such point.
[[nodiscard]] std::vector<std::uint8_t> withLeadingZeros(const std::vector<std::uint8_t>& text);

/// Drops the texture coordinates of each face of an OBJ text that names one which is not there;
/// assimp gives up the file. Returns how many faces that were.
std::size_t dropMissingCoordinates(std::vector<std::uint8_t>& text);

/// Drops blanks behind each <color> of a Collada text, at which assimp gives up the file.
void dropBlanksBeforeColors(std::vector<std::uint8_t>& text);

/// The stream of an OBJ or Collada file as assimp can read it, by the file's extension: assimp
/// takes ".5" for no number and drops the corner. Takes the stream over and returns it, or one of
/// the mended text. Adds the faces that lost their texture coordinates to `mended_faces`.
[[nodiscard]] Assimp::IOStream* mendText(Assimp::IOStream* stream, const std::string& extension,
                                         std::size_t& mended_faces);

}  // namespace dollytrack
