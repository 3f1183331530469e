#include "app/cli/terminal/terminal_text.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>

namespace dollytrack::cli {
namespace {

bool beginsCharacter(char byte) {
    return (static_cast<unsigned char>(byte) & 0xC0U) != 0x80U;
}

std::size_t columns(std::string_view text) {
    return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), beginsCharacter));
}

/// The longest prefix of whole characters that fits.
std::string_view head(std::string_view text, std::size_t width) {
    std::size_t seen = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (beginsCharacter(text[i]) && ++seen > width) return text.substr(0, i);
    }
    return text;
}

}  // namespace

std::size_t terminalWidth() {
    winsize size = {};
    if (isatty(STDOUT_FILENO) == 0 || ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0) return 0;
    return size.ws_col;
}

std::string inColumn(std::string_view text, std::size_t width) {
    const std::size_t taken = columns(text);
    if (taken <= width) return std::string(text) + std::string(width - taken, ' ');
    return std::string(head(text, width - 1)) + "\u2026";
}

std::string wrapped(std::string_view text, std::size_t width, std::size_t indent,
                    std::string_view lead) {
    std::string line = std::string(lead) + std::string(indent - std::min(indent, lead.size()), ' ');
    const std::string blanks(indent, ' ');
    std::string lines;
    bool empty = true;  // whether the line has no word yet
    while (!text.empty()) {
        const std::size_t end = std::min(text.find(' '), text.size());
        const std::string_view word = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        if (!empty && width > 0 && columns(line) + 1 + columns(word) > width) {
            lines += line + "\n";
            line = blanks;
            empty = true;
        }
        if (!empty) line += ' ';
        line += word;
        empty = false;
    }
    return lines + line + "\n";
}

}  // namespace dollytrack::cli
