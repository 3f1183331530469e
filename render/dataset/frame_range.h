#pragma once

#include "engine/core/result.h"

#include <optional>
#include <string>
#include <vector>

namespace dollytrack::render {

/// Frames begin, begin + step, ... below end of a trajectory; no end: to the last.
struct FrameRange {
    int begin = 0;
    std::optional<int> end;
    int step = 1;
};

/// "a:b:s" with every part optional ("10:", ":50", "::5"). Usage error otherwise.
[[nodiscard]] Result<FrameRange> parseFrameRange(const std::string& text);

/// The range as parseFrameRange() reads it.
[[nodiscard]] std::string toText(const FrameRange& range);

/// Its frames among the `available` ones.
[[nodiscard]] std::vector<int> framesOf(const FrameRange& range, int available);

}  // namespace dollytrack::render
