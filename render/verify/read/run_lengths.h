#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace dollytrack::verify {

/// Decodes COCO's compressed run lengths; empty for invalid text. Runs go column by column,
/// alternating between outside and inside, starting outside.
std::vector<std::uint32_t> readRunLengths(std::string_view text);

/// A mask column by column: width * height bytes, 1 inside. Empty if the runs do not sum up to
/// that.
std::vector<std::uint8_t> maskFrom(const std::vector<std::uint32_t>& runs, int width, int height);

}  // namespace dollytrack::verify
