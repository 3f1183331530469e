#include "engine/core/text_lists.h"

#include <algorithm>

namespace dollytrack {

std::string listOf(const std::vector<std::string>& names, std::size_t most) {
    const std::size_t shown = std::min(names.size(), most);
    std::string text;
    for (std::size_t i = 0; i < shown; ++i) text += (i > 0 ? ", " : "") + names[i];
    if (shown < names.size()) text += " and " + std::to_string(names.size() - shown) + " more";
    return text;
}

std::string counted(std::size_t count, const char* one, const char* many) {
    return std::to_string(count) + " " + (count == 1 ? one : many);
}

std::string frameRanges(const std::vector<int>& frames) {
    constexpr int kMostRanges = 10;
    std::string text = frames.size() == 1 ? "frame " : "frames ";
    int ranges = 0;
    for (std::size_t i = 0, end = 0; i < frames.size(); i = end) {
        if (ranges == kMostRanges) return text + ", ...";
        for (end = i + 1; end < frames.size() && frames[end] == frames[end - 1] + 1;) ++end;
        text += (ranges++ == 0 ? "" : ", ") + std::to_string(frames[i]);
        if (end - i > 1) text += "-" + std::to_string(frames[end - 1]);
    }
    return text;
}

}  // namespace dollytrack
