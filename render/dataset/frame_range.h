#pragma once

#include "engine/core/result.h"

#include <optional>
#include <string>
#include <vector>

namespace dollytrack::render {

/// Frames begin, begin + step, ... below end; without end up to the last.
struct FrameRange {
    int begin = 0;
    std::optional<int> end;
    int step = 1;
};

/// Parses "a:b:s" with optional parts ("10:", ":50", "::5"). Returns Usage for other text.
[[nodiscard]] Result<FrameRange> parseFrameRange(const std::string& text);

/// The range in the syntax of parseFrameRange().
[[nodiscard]] std::string toText(const FrameRange& range);

/// The range's frames among `available` ones.
[[nodiscard]] std::vector<int> framesOf(const FrameRange& range, int available);

}  // namespace dollytrack::render
