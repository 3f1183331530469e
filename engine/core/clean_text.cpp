#include "engine/core/clean_text.h"

#include "engine/core/clean_lines.h"

#include <cstddef>

namespace dollytrack {
namespace {

struct Sequence {
    std::size_t length = 1;  // in bytes, at least 1
    bool valid = false;
    bool control = false;
    bool cut_off = false;  // valid, but the text ends before the sequence does
};

/// The UTF-8 sequence at the beginning of `text`, which is not empty (Unicode 15, table 3-7).
Sequence firstSequence(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned lead = byte(0);
    if (lead < 0x80) return {1, true, lead < 0x20 || lead == 0x7F};
    if (lead < 0xC2 || lead > 0xF4) return {};
    const std::size_t length = lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4;
    // The range of the second byte excludes overlong forms, surrogates and code points above
    // U+10FFFF.
    const unsigned low = lead == 0xE0 ? 0xA0 : lead == 0xF0 ? 0x90 : 0x80;
    const unsigned high = lead == 0xED ? 0x9F : lead == 0xF4 ? 0x8F : 0xBF;
    for (std::size_t i = 1; i < length; ++i) {
        const bool second = i == 1;
        if (i >= text.size()) return {i, false, false, true};
        if (byte(i) < (second ? low : 0x80U) || byte(i) > (second ? high : 0xBFU)) {
            return {i, false, false};
        }
    }
    const bool is_bidi_control =
        lead == 0xE2 && ((byte(1) == 0x80 && byte(2) >= 0xAA && byte(2) <= 0xAE) ||
                         (byte(1) == 0x81 && byte(2) >= 0xA6 && byte(2) <= 0xA9));
    return {length, true, is_bidi_control || (lead == 0xC2 && byte(1) < 0xA0)};
}

enum class Breaks { Drop, Keep };  // line breaks and tabs

/// Cleans `text` and removes the cleaned bytes from it: all of it, or, if more text follows, all
/// but an incomplete character at its end.
std::string cleaned(std::string_view& text, Breaks breaks, bool more_comes) {
    std::string clean;
    clean.reserve(text.size());
    while (!text.empty()) {
        const Sequence sequence = firstSequence(text);
        if (sequence.cut_off && more_comes) break;
        const char first = text.front();
        const bool is_break = breaks == Breaks::Keep && (first == '\n' || first == '\t');
        if (!sequence.valid) {
            clean += "\xEF\xBF\xBD";
        } else if (!sequence.control || is_break) {
            clean += text.substr(0, sequence.length);
        }
        text.remove_prefix(sequence.length);
    }
    return clean;
}

}  // namespace

std::string cleanText(std::string_view text) {
    return cleaned(text, Breaks::Drop, false);
}

std::string cleanLines(std::string_view text) {
    return cleaned(text, Breaks::Keep, false);
}

std::string LineCleaner::add(std::string_view piece) {
    const std::string all = pending_ + std::string(piece);
    std::string_view rest = all;
    std::string clean = cleaned(rest, Breaks::Keep, true);
    pending_ = rest;
    return clean;
}

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view kBlank = " \t\r\n";
    const std::size_t first = text.find_first_not_of(kBlank);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(kBlank) + 1 - first);
}

}  // namespace dollytrack
