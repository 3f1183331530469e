#pragma once

#include <string>
#include <string_view>

namespace dollytrack::editor {

/// This process in the names of files it leaves: "1234-56789", its id and when it began, which no
/// later process of the same id shares.
[[nodiscard]] std::string processMark();

/// Whether the process of a mark still runs. Not for what is no mark.
[[nodiscard]] bool processRuns(std::string_view mark);

}  // namespace dollytrack::editor
