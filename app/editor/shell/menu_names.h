#pragma once

#include <string>

namespace dollytrack::editor {

/// A message of an import or export with the editor's menus and panels in place of the options and
/// operations of the command line.
[[nodiscard]] std::string withMenuNames(std::string message);

}  // namespace dollytrack::editor
