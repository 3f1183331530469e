#pragma once

#include <string_view>

namespace dollytrack {

/// Whether a name comes before another as people count: runs of digits by their value, so that
/// "frame_2" is before "frame_10", the rest by bytes. A strict order: names that differ in leading
/// zeros alone are told apart by their bytes.
bool comesBefore(std::string_view a, std::string_view b);

}  // namespace dollytrack
