#pragma once

namespace dollytrack::ui {

/// Says that a widget has asked for the keyboard and does not have it yet: what is typed meanwhile
/// belongs to it. To be repeated in every frame that this holds.
void awaitKeyboard();

/// Whether that was said since the last call.
[[nodiscard]] bool takeKeyboardAwaited();

}  // namespace dollytrack::ui
