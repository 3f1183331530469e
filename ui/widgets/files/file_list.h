#pragma once

#include "ui/widgets/files/folder_reader.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack::ui {

struct FileListView {
    const FolderListing* listing = nullptr;            // null: the folder is still being read
    const std::vector<std::uint32_t>* rows = nullptr;  // entry indices, from arrange()
    bool takes_keys = true;                            // keyboard input goes to the list
};

struct FileListState {
    int selected = -1;  // index in `rows`; -1: none
    bool scroll = false;
    std::string typed;       // beginning of a name typed to jump to it
    double typed_at = -1e9;  // s
};

struct FileListActions {
    bool selected = false;  // the selection changed
    bool opened = false;    // the selected row was opened by double click or Enter
    bool go_up = false;     // Backspace was pressed
    std::string path;       // typed text that is a path, or matches no name; empty: none
};

/// Draws a folder as a table with sortable columns; only visible rows are drawn, so 100,000 files
/// stay fast.
FileListActions drawFileList(const FileListView& view, FolderOrder& order, FileListState& state);

/// A size as text, in decimal units: "1.2 MB".
std::string sizeText(std::uint64_t bytes);

}  // namespace dollytrack::ui
