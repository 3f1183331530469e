#pragma once

#include <filesystem>
#include <vector>

namespace dollytrack::editor {

/// The entries of a folder, unsorted, as far as they can be read. Throws only bad_alloc; a
/// range-for over directory_iterator may throw on a failing disk.
[[nodiscard]] inline std::vector<std::filesystem::directory_entry> entriesOf(
    const std::filesystem::path& folder) {
    std::vector<std::filesystem::directory_entry> entries;
    std::error_code error;
    for (std::filesystem::directory_iterator at(folder, error), end; !error && at != end;
         at.increment(error)) {
        entries.push_back(*at);
    }
    return entries;
}

}  // namespace dollytrack::editor
