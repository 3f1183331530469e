#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace dollytrack {

/// The end of a sentence about a name that does not exist: "; did you mean 'lamp_3'?", or where
/// none is close what there is, the likest first: "; there are 'lamp_1', 'lamp_2' and 40 more.".
std::string nameHint(std::string_view wrong, const std::vector<std::string>& names);

}  // namespace dollytrack
