#pragma once

#include <cstddef>
#include <string>

namespace dollytrack::view {

/// The files of the web page (assets/view), which are compiled into the program.
struct PageFiles {
    std::string head;    // from the doctype to the data, with the style
    std::string script;  // all scripts, in their order
    std::string end;

    [[nodiscard]] std::size_t size() const { return head.size() + script.size() + end.size(); }
};

[[nodiscard]] const PageFiles& pageFiles();

}  // namespace dollytrack::view
