#pragma once

namespace dollytrack::ui {

/// Announces that a widget has requested the keyboard but does not have it yet, so that typed
/// characters are kept for it. To be called in every such frame.
void awaitKeyboard();

/// Returns whether awaitKeyboard() was called since the last call, and resets it.
[[nodiscard]] bool takeKeyboardAwaited();

}  // namespace dollytrack::ui
