#pragma once

#include "engine/io/sandbox/input_record.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dollytrack::io {

/// What a reading depends on, as bytes for another process; empty when it is more than is kept.
[[nodiscard]] std::string inputListText(const std::vector<InputUse>& uses);

/// Reads them back; nothing when they are not whole, or more than a scene can have.
[[nodiscard]] std::optional<std::vector<InputUse>> parseInputList(std::string_view text);

}  // namespace dollytrack::io
