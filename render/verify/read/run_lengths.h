#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace dollytrack::verify {

/// The run lengths in COCO's compressed text; empty for text that is none. Runs go column by
/// column, alternately outside and inside, beginning outside.
std::vector<std::uint32_t> readRunLengths(std::string_view text);

/// A mask, column by column: width * height bytes, 1 inside. Empty when the runs do not sum up to
/// that.
std::vector<std::uint8_t> maskFrom(const std::vector<std::uint32_t>& runs, int width, int height);

}  // namespace dollytrack::verify
