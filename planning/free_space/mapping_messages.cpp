#include "planning/free_space/mapping_messages.h"

#include <fmt/format.h>

namespace dollytrack::planning {

tl::unexpected<Error> mappingCancelled() {
    return fail(ErrorCode::Cancelled, "mapping the free space was cancelled");
}

std::string inMetres(double value) {
    return fmt::format("{:.3g} m", value);
}

}  // namespace dollytrack::planning
