#pragma once

#include <cstddef>
#include <string>

namespace dollytrack::view {

/// The page's own files of assets/view, which are inside the program.
struct PageFiles {
    std::string head;    // from the doctype to the data, with the style
    std::string script;  // all scripts, in their order
    std::string end;

    [[nodiscard]] std::size_t size() const { return head.size() + script.size() + end.size(); }
};

[[nodiscard]] const PageFiles& pageFiles();

}  // namespace dollytrack::view
