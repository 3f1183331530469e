#include "engine/core/fold_repeats.h"

#include <cctype>
#include <map>
#include <string_view>

namespace dollytrack {
namespace {

bool isNumeral(char c) {
    return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

/// The message without quoted text and numbers.
std::string kindOf(std::string_view message) {
    std::string kind;
    for (std::size_t i = 0; i < message.size(); ++i) {
        const char c = message[i];
        if (c == '"' || c == '\'') {
            const std::size_t end = message.find(c, i + 1);
            if (end == std::string_view::npos) continue;
            i = end;
        } else if (!isNumeral(c)) {
            kind += c;
        } else if (kind.empty() || kind.back() != '#') {
            kind += '#';
        }
    }
    return kind;
}

}  // namespace

std::vector<std::string> foldRepeats(const std::vector<std::string>& messages, std::size_t shown) {
    struct Kind {
        std::size_t count = 0;
        std::size_t last = 0;  // index among the kept messages
    };
    std::vector<std::string> kept;
    std::map<std::string, Kind> kinds;
    for (const std::string& message : messages) {
        Kind& kind = kinds[kindOf(message)];
        if (++kind.count > shown) continue;
        kind.last = kept.size();
        kept.push_back(message);
    }
    for (const auto& [text, kind] : kinds) {
        if (kind.count <= shown) continue;
        kept[kind.last] += " (and " + std::to_string(kind.count - shown) + " more like this)";
    }
    return kept;
}

}  // namespace dollytrack
