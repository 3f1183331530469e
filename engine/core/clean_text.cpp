#include "engine/core/clean_text.h"

#include <cstddef>

namespace dollytrack {
namespace {

struct Sequence {
    std::size_t length = 1;  // bytes it takes up, at least one
    bool valid = false;
    bool control = false;
};

/// The UTF-8 sequence that `text`, which is not empty, begins with (Unicode 15, table 3-7).
Sequence firstSequence(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned lead = byte(0);
    if (lead < 0x80) return {1, true, lead < 0x20 || lead == 0x7F};
    if (lead < 0xC2 || lead > 0xF4) return {};
    const std::size_t length = lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4;
    // The second byte excludes overlong forms, surrogates and what lies beyond U+10FFFF.
    const unsigned low = lead == 0xE0 ? 0xA0 : lead == 0xF0 ? 0x90 : 0x80;
    const unsigned high = lead == 0xED ? 0x9F : lead == 0xF4 ? 0x8F : 0xBF;
    for (std::size_t i = 1; i < length; ++i) {
        const bool second = i == 1;
        if (i >= text.size() || byte(i) < (second ? low : 0x80U) ||
            byte(i) > (second ? high : 0xBFU)) {
            return {i, false, false};
        }
    }
    return {length, true, lead == 0xC2 && byte(1) < 0xA0};
}

}  // namespace

std::string cleanText(std::string_view text) {
    std::string clean;
    clean.reserve(text.size());
    while (!text.empty()) {
        const Sequence sequence = firstSequence(text);
        if (!sequence.valid) {
            clean += "\xEF\xBF\xBD";
        } else if (!sequence.control) {
            clean += text.substr(0, sequence.length);
        }
        text.remove_prefix(sequence.length);
    }
    return clean;
}

}  // namespace dollytrack
