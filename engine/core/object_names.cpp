#include "engine/core/object_names.h"

#include <algorithm>

namespace dollytrack {

std::string ObjectNames::next(const std::string& base) {
    const int count = ++used_[base];
    return count == 1 ? base : base + "_" + std::to_string(count);
}

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

}  // namespace dollytrack
