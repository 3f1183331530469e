#pragma once

#include <optional>
#include <string>
#include <vector>

namespace dollytrack::ui {

/// A project or scene that was opened earlier.
struct RecentFile {
    std::string path;
    std::string name;      // "kitchen.dolly"
    std::string folder;    // folder of the file
    std::string date;      // of the last change; empty: unknown
    bool missing = false;  // there is no such file
    unsigned texture = 0;  // its picture, row 0 at the top; 0: none
};

/// Input of the start screen for one window frame.
struct StartView {
    std::vector<RecentFile> recent;     // newest first
    std::optional<RecentFile> example;  // the built-in scene, if it is installed
};

/// Kept between window frames.
struct StartState {
    int chosen = 0;  // row for the keys, counted over all rows
    int frames = 0;  // window frames since it appeared, counted up to 2; 0: it is not shown
};

/// User actions of this frame.
struct StartActions {
    std::string open;          // path to open
    bool choose_file = false;  // show the file dialog
    std::string remove;        // path to remove from the recent files
};

/// Draws the start screen into the current window: recent files with their pictures, the built-in
/// scene, and "Open…". Arrow keys choose a row, Enter opens it, Delete removes a recent file.
StartActions drawStartPanel(const StartView& view, StartState& state);

}  // namespace dollytrack::ui
