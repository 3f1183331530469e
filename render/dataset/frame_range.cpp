#include "render/dataset/frame_range.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>

namespace dollytrack::render {

Result<FrameRange> parseFrameRange(const std::string& text) {
    const auto refuse = [&] {
        return fail(ErrorCode::Usage,
                    "\"" + text +
                        "\" is not a frame range; write first:end:step, for example 0:100:2 or ::5",
                    "--range");
    };
    std::array<std::optional<int>, 3> parts;
    std::size_t start = 0;
    std::size_t count = 0;
    while (start <= text.size()) {
        if (count == parts.size()) return refuse();
        const std::size_t colon = std::min(text.find(':', start), text.size());
        if (colon > start) {
            int value = 0;
            const char* last = text.data() + colon;
            const auto [end, error] = std::from_chars(text.data() + start, last, value);
            if (error != std::errc() || end != last || value < 0) return refuse();
            parts[count] = value;
        }
        ++count;
        start = colon + 1;
    }
    // A single number is refused, because it could mean "from" or "only".
    if (count < 2) return refuse();
    FrameRange range;
    range.begin = parts[0].value_or(0);
    range.end = parts[1];
    range.step = parts[2].value_or(1);
    if (range.step < 1) return refuse();
    if (range.end && *range.end <= range.begin) {
        return fail(ErrorCode::Usage,
                    "\"" + text +
                        "\" ends before its first frame; the end, which is excluded, must come "
                        "after the first frame, as in 5:10",
                    "--range");
    }
    return range;
}

std::string toText(const FrameRange& range) {
    return std::to_string(range.begin) + ":" + (range.end ? std::to_string(*range.end) : "") + ":" +
           std::to_string(range.step);
}

std::vector<int> framesOf(const FrameRange& range, int available) {
    std::vector<int> frames;
    const int end = std::min(range.end.value_or(available), available);
    for (std::int64_t i = range.begin; i < end; i += range.step) {
        frames.push_back(static_cast<int>(i));
    }
    return frames;
}

}  // namespace dollytrack::render
