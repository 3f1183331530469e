#include "app/batch/markup.h"

#include "engine/core/clean_text.h"

#include <fmt/format.h>

#include <cctype>

namespace dollytrack::batch {

std::string asMarkup(std::string_view text) {
    std::string clean = cleanText(text);
    // UTF-8 of U+FFFE and U+FFFF, which XML does not allow.
    for (const char* none : {"\xEF\xBF\xBE", "\xEF\xBF\xBF"}) {
        for (std::size_t at = clean.find(none); at != std::string::npos; at = clean.find(none)) {
            clean.erase(at, 3);
        }
    }
    std::string escaped;
    for (const char c : clean) {
        switch (c) {
            case '&':
                escaped += "&amp;";
                break;
            case '<':
                escaped += "&lt;";
                break;
            case '>':
                escaped += "&gt;";
                break;
            case '"':
                escaped += "&quot;";
                break;
            case '\'':
                escaped += "&#39;";
                break;
            default:
                escaped += c;
        }
    }
    return escaped;
}

std::string asLink(std::string_view path) {
    std::string link;
    for (const char c : path) {
        const auto byte = static_cast<unsigned char>(c);
        const bool plain = (byte < 128 && std::isalnum(byte) != 0) ||
                           std::string_view("-_.~/").find(c) != std::string_view::npos;
        link += plain ? std::string(1, c) : fmt::format("%{:02X}", byte);
    }
    return link;
}

}  // namespace dollytrack::batch
