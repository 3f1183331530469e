#include "engine/io/import/obj_numbers.h"

#include "engine/io/import/assimp_files.h"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>

namespace dollytrack {
namespace {

constexpr std::size_t kLargest = std::size_t{1} << 31U;  // bytes; larger ones are left as they are

bool isDigit(std::uint8_t c) {
    return c >= '0' && c <= '9';
}

/// Of a number: after a blank or a sign, before a digit. Names of files have neither.
bool isBarePoint(const std::vector<std::uint8_t>& text, std::size_t at) {
    if (at == 0 || at + 1 >= text.size() || !isDigit(text[at + 1])) return false;
    std::size_t before = at - 1;
    if (text[before] == '-' || text[before] == '+') {
        if (before == 0) return false;
        --before;
    }
    return text[before] == ' ' || text[before] == '\t';
}

/// The next bare point from `at` on; the text's size when there is none.
std::size_t nextBarePoint(const std::vector<std::uint8_t>& text, std::size_t at) {
    while (at < text.size()) {
        const void* found = std::memchr(text.data() + at, '.', text.size() - at);
        if (!found) return text.size();
        at = static_cast<std::size_t>(static_cast<const std::uint8_t*>(found) - text.data());
        if (isBarePoint(text, at)) return at;
        ++at;
    }
    return text.size();
}

}  // namespace

bool hasBarePoints(const std::vector<std::uint8_t>& text) {
    return nextBarePoint(text, 0) < text.size();
}

std::vector<std::uint8_t> withLeadingZeros(const std::vector<std::uint8_t>& text) {
    std::vector<std::uint8_t> mended;
    mended.reserve(text.size() + text.size() / 8);
    std::size_t from = 0;
    while (from < text.size()) {
        const std::size_t point = nextBarePoint(text, from);
        mended.insert(mended.end(), text.begin() + static_cast<std::ptrdiff_t>(from),
                      text.begin() + static_cast<std::ptrdiff_t>(point));
        if (point == text.size()) break;
        mended.push_back('0');
        mended.push_back('.');
        from = point + 1;
    }
    return mended;
}

std::size_t dropMissingCoordinates(std::vector<std::uint8_t>& text) {
    const std::string_view all(reinterpret_cast<const char*>(text.data()), text.size());
    const auto eachLine = [&](auto&& visit) {
        for (std::size_t at = 0; at < all.size();) {
            const std::size_t end = std::min(all.find('\n', at), all.size());
            visit(all.substr(at, end - at));
            at = end + 1;
        }
    };
    long long count = 0;
    eachLine([&](std::string_view line) {
        line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
        count += line.starts_with("vt ") || line.starts_with("vt\t") ? 1 : 0;
    });
    // The second number of "7/8/9"; nothing where there is none.
    const auto coordinateOf = [](std::string_view corner) -> std::optional<long long> {
        const auto slash = corner.find('/');
        if (slash == corner.npos) return std::nullopt;
        long long value = 0;
        const auto [end, error] =
            std::from_chars(corner.data() + slash + 1, corner.data() + corner.size(), value);
        if (error != std::errc()) return std::nullopt;
        return value;
    };
    const auto eachCorner = [](std::string_view line, auto&& visit) {
        for (std::size_t at = 1; at < line.size();) {
            const std::size_t begin = line.find_first_not_of(" \t\r", at);
            if (begin == line.npos) return;
            at = std::min(line.find_first_of(" \t\r", begin), line.size());
            visit(line.substr(begin, at - begin));
        }
    };
    const auto isBroken = [&](std::string_view line) {
        bool broken = false;
        if (!line.starts_with("f ")) return broken;
        eachCorner(line, [&](std::string_view corner) {
            const auto value = coordinateOf(corner);
            broken = broken || (value && (*value > count || *value < -count || *value == 0));
        });
        return broken;
    };
    std::size_t mended = 0;
    eachLine([&](std::string_view line) { mended += isBroken(line) ? 1 : 0; });
    if (mended == 0) return 0;
    std::string kept;
    kept.reserve(text.size());
    eachLine([&](std::string_view line) {
        if (!isBroken(line)) {
            kept += line;
        } else {
            kept += 'f';
            eachCorner(line, [&](std::string_view corner) {
                const std::size_t first = corner.find('/');
                const std::size_t second = corner.find('/', first + 1);
                kept += ' ';
                kept += corner.substr(0, first);
                if (second != corner.npos) {
                    kept += "//";
                    kept += corner.substr(second + 1);
                }
            });
        }
        kept += '\n';
    });
    text.assign(kept.begin(), kept.end());
    return mended;
}

void dropBlanksBeforeColors(std::vector<std::uint8_t>& text) {
    constexpr std::string_view kTag = "<color";
    const std::string_view all(reinterpret_cast<const char*>(text.data()), text.size());
    std::string kept;
    std::size_t copied = 0;
    for (std::size_t at = all.find(kTag); at != all.npos; at = all.find(kTag, at)) {
        at = std::min(all.find('>', at), all.size() - 1) + 1;
        const std::size_t number = std::min(all.find_first_not_of(" \t\r\n", at), all.size());
        kept += all.substr(copied, at - copied);
        copied = at = number;
    }
    if (copied == 0) return;
    kept += all.substr(copied);
    text.assign(kept.begin(), kept.end());
}

Assimp::IOStream* mendText(Assimp::IOStream* stream, const std::string& extension,
                           std::size_t& mended_faces) {
    const bool collada = extension == ".dae";
    if (!stream || stream->FileSize() > kLargest || !(collada || extension == ".obj")) {
        return stream;
    }
    std::vector<std::uint8_t> text(stream->FileSize());
    const std::unique_ptr<Assimp::IOStream> old(stream);
    if (!text.empty() && stream->Read(text.data(), 1, text.size()) != text.size()) text.clear();
    if (collada) {
        dropBlanksBeforeColors(text);
    } else {
        if (hasBarePoints(text)) text = withLeadingZeros(text);
        mended_faces += dropMissingCoordinates(text);
    }
    return openBytes(std::move(text));
}

}  // namespace dollytrack
