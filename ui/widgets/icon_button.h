#pragma once

#include <string>
#include <string_view>

namespace dollytrack::ui {

/// Signs that are drawn rather than looked up in a font, so that they are always there.
enum class Icon {
    ToStart,
    PreviousMark,
    StepBack,
    Play,
    Pause,
    StepForward,
    NextMark,
    ToEnd,
    Loop,
    Pin,
    Grow,
    Shrink,
    Save,
    Up,
    Down,
    Close,
};

struct IconOptions {
    std::string tip = {};
    std::string why_not = {};  // not empty: disabled, and this says why
    bool on = false;           // of a switch
    bool small = false;        // as high as a line of text
};

/// A square button; `name` is its name in the item map.
bool iconButton(Icon icon, std::string_view name, const IconOptions& options = {});

}  // namespace dollytrack::ui
