#pragma once

namespace dollytrack {

/// Program version: "0.1.0 (commit c9b6535f1a)". Without the commit if the source was no Git
/// working tree; with "-changed" after the commit if tracked files were modified.
[[nodiscard]] const char* versionText();

}  // namespace dollytrack
