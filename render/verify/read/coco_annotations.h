#pragma once

#include "engine/core/result.h"

#include <nlohmann/json.hpp>

#include <functional>
#include <string>
#include <string_view>

namespace dollytrack::verify {

/// Passes the annotations of a COCO file's text to `take`, one by one, so that the JSON of only one
/// annotation is in memory. `take` returns false for a damaged annotation and may throw nlohmann's
/// exceptions. `where` names the file in errors. Error: BadInput, also after a damaged annotation.
[[nodiscard]] Status forEachAnnotation(std::string_view text, const std::string& where,
                                       const std::function<bool(const nlohmann::json&)>& take);

}  // namespace dollytrack::verify
