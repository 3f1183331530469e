#include "app/batch/file_pattern.h"

#include <fnmatch.h>

#include <cstddef>
#include <vector>

namespace dollytrack::batch {
namespace {

/// Splits a pattern into elements that match one character each, or "*".
std::vector<std::string> elementsOf(const std::string& pattern) {
    std::vector<std::string> elements;
    for (std::size_t at = 0; at < pattern.size();) {
        std::size_t length = 1;
        if (pattern[at] == '\\' && at + 1 < pattern.size()) length = 2;
        if (pattern[at] == '[') {
            // A leading ']' is a member of the set, and "[:alpha:]" contains one, too.
            std::size_t end = at + 1;
            if (end < pattern.size() && (pattern[end] == '!' || pattern[end] == '^')) ++end;
            if (end < pattern.size() && pattern[end] == ']') ++end;
            while (end < pattern.size() && pattern[end] != ']') {
                const bool group =
                    pattern[end] == '[' && end + 1 < pattern.size() &&
                    std::string_view(":.=").find(pattern[end + 1]) != std::string_view::npos;
                const std::size_t close =
                    group ? pattern.find(std::string{pattern[end + 1], ']'}, end + 2)
                          : std::string::npos;
                end = close != std::string::npos ? close + 2 : end + 1;
            }
            if (end < pattern.size()) length = end + 1 - at;
        }
        std::string element = pattern.substr(at, length);
        // An unclosed bracket matches itself.
        if (element == "[") element = "\\[";
        if (element != "*" || elements.empty() || elements.back() != "*") {
            elements.push_back(std::move(element));
        }
        at += length;
    }
    return elements;
}

bool fitsOne(char c, const std::string& element) {
    if (element.size() == 1) return element[0] == '?' || element[0] == c;
    if (element[0] == '\\') return element[1] == c;
    return ::fnmatch(element.c_str(), std::string(1, c).c_str(), 0) == 0;
}

}  // namespace

bool fitsFilePattern(std::string_view name, const std::string& pattern) {
    const std::vector<std::string> elements = elementsOf(pattern);
    const bool hidden = name.starts_with('.');
    if (hidden && (elements.empty() || (elements[0] != "." && elements[0] != "\\."))) return false;
    // Backtracking is needed for the last '*' only: the shortest matches of the earlier ones leave
    // the longest rest.
    std::size_t at = 0;
    std::size_t element = 0;
    std::size_t star = elements.size();  // the last '*' passed; star_end: end of its match
    std::size_t star_end = 0;
    while (at < name.size()) {
        if (element < elements.size() && elements[element] == "*") {
            star = element++;
            star_end = at;
        } else if (element < elements.size() && fitsOne(name[at], elements[element])) {
            ++at;
            ++element;
        } else if (star < elements.size()) {
            at = ++star_end;
            element = star + 1;
        } else {
            return false;
        }
    }
    while (element < elements.size() && elements[element] == "*") ++element;
    return element == elements.size();
}

}  // namespace dollytrack::batch
