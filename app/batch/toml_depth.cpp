#include "app/batch/toml_depth.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

namespace dollytrack::batch {
namespace {

constexpr int kMostParts = 16;
constexpr int kDeepest = 32;

/// End of the TOML string that begins at `at` (basic or literal, single-line or multi-line). For an
/// unterminated string, the end of its line or of the text.
std::size_t endOfString(std::string_view text, std::size_t at) {
    const char quote = text[at];
    const std::string_view three = quote == '"' ? "\"\"\"" : "'''";
    const bool several_lines = text.substr(at, 3) == three;
    for (std::size_t i = at + (several_lines ? 3 : 1); i < text.size(); ++i) {
        if (text[i] == '\\' && quote == '"') {
            ++i;
        } else if (!several_lines && (text[i] == quote || text[i] == '\n')) {
            return text[i] == quote ? i + 1 : i;
        } else if (several_lines && text.substr(i, 3) == three) {
            // Up to two more quotes before the delimiter belong to the string.
            i += 3;
            for (int more = 0; more < 2 && i < text.size() && text[i] == quote; ++more) ++i;
            return i;
        }
    }
    return text.size();
}

}  // namespace

Status checkTomlDepth(std::string_view text, const std::string& file) {
    int parts = 1;  // parts of the current key or number
    int depth = 0;
    std::size_t at = 0;
    while (at < text.size()) {
        const char c = text[at];
        if (c == '"' || c == '\'') {
            at = endOfString(text, at);
            continue;
        }
        if (c == '#') {
            at = std::min(text.find('\n', at), text.size());
            continue;
        }
        if (c == '.') {
            ++parts;
        } else if (c == '[' || c == '{') {
            ++depth;
            parts = 1;
        } else if (c == ']' || c == '}') {
            depth = std::max(0, depth - 1);
            parts = 1;
        } else if (c == '=' || c == ',' || c == '\n') {
            parts = 1;
        }
        if (parts > kMostParts || depth > kDeepest) {
            const auto line =
                1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
            return fail(
                ErrorCode::BadInput,
                parts > kMostParts
                    ? fmt::format("A key has more than {} parts; put it in quotes if its "
                                  "dots belong to a name.",
                                  kMostParts)
                    : fmt::format("Lists and tables are nested more than {} deep.", kDeepest),
                fmt::format("{}:{}", file, line));
        }
        ++at;
    }
    return {};
}

}  // namespace dollytrack::batch
