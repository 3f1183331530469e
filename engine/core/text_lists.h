#pragma once

#include <string>
#include <vector>

namespace dollytrack {

/// A list of at most `most` names as text: "a, b and 7 more".
std::string listOf(const std::vector<std::string>& names, std::size_t most = 20);

/// A count with the singular or plural: "1 model was", "2 models were".
std::string counted(std::size_t count, const char* one, const char* many);

/// Frame numbers in increasing order as at most ten ranges: "frames 3-9, 17".
std::string frameRanges(const std::vector<int>& frames);

}  // namespace dollytrack
