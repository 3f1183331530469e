#pragma once

#include <string>
#include <string_view>

namespace dollytrack::ui {

/// Icons drawn as shapes, so that they do not depend on a font.
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
    Float,
    Save,
    Up,
    Down,
    Close,
};

struct IconOptions {
    std::string tip = {};
    std::string why_not = {};  // not empty: the button is disabled, and its tooltip says why
    bool on = false;           // highlighted, for a switch that is on
    bool small = false;        // as high as a line of text
};

/// A square button called `name` in the item map; returns whether it was pressed.
bool iconButton(Icon icon, std::string_view name, const IconOptions& options = {});

}  // namespace dollytrack::ui
