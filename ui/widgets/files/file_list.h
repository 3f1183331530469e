#pragma once

#include "ui/widgets/files/folder_reader.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack::ui {

struct FileListView {
    const FolderListing* listing = nullptr;            // null: still being read
    const std::vector<std::uint32_t>* rows = nullptr;  // of its entries, as arrange() gives them
    bool takes_keys = true;                            // no text field has the keyboard
};

struct FileListState {
    int selected = -1;  // row
    bool scroll = false;
    std::string typed;       // a name being typed, to jump to
    double typed_at = -1e9;  // s
};

struct FileListActions {
    bool selected = false;  // another row than before
    bool opened = false;    // the selected row: double click or Enter
    bool go_up = false;     // Backspace
    std::string path;       // what was typed is no name but a path: its beginning
};

/// The files of a folder as a table that sorts by its headings; keeps up with 100,000 of them.
FileListActions drawFileList(const FileListView& view, FolderOrder& order, FileListState& state);

/// "1.2 MB".
std::string sizeText(std::uint64_t bytes);

}  // namespace dollytrack::ui
