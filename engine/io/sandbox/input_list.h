#pragma once

#include "engine/io/files/input_record.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dollytrack {

/// Serializes the files that an import read, for another process; empty if there are too many to be
/// cached.
[[nodiscard]] std::string inputListText(const std::vector<InputUse>& uses);

/// Reads what inputListText() wrote; nullopt if it is incomplete, invalid or too long.
[[nodiscard]] std::optional<std::vector<InputUse>> parseInputList(std::string_view text);

}  // namespace dollytrack
