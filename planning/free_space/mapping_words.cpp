#include "planning/free_space/mapping_words.h"

#include <array>
#include <cstdio>

namespace dollytrack::planning {

tl::unexpected<Error> mappingCancelled() {
    return fail(ErrorCode::Cancelled, "mapping the free space was cancelled");
}

std::string inMetres(double value) {
    std::array<char, 32> text = {};
    std::snprintf(text.data(), text.size(), "%.3g m", value);
    return text.data();
}

}  // namespace dollytrack::planning
