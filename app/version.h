#pragma once

namespace dollytrack {

/// "0.1.0 (commit c9b6535f1a)"; without the commit where the source is no Git working tree, with
/// "-changed" after it where files differ from it.
[[nodiscard]] const char* versionText();

}  // namespace dollytrack
