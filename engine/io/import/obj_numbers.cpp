#include "engine/io/import/obj_numbers.h"

#include "engine/io/import/assimp_files.h"

#include <cstring>
#include <memory>

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

Assimp::IOStream* mendObjNumbers(Assimp::IOStream* stream) {
    if (!stream || stream->FileSize() > kLargest) return stream;
    std::vector<std::uint8_t> text(stream->FileSize());
    const bool whole = text.empty() || stream->Read(text.data(), 1, text.size()) == text.size();
    if (!whole || !hasBarePoints(text)) {
        stream->Seek(0, aiOrigin_SET);
        return stream;
    }
    const std::unique_ptr<Assimp::IOStream> old(stream);
    return openBytes(withLeadingZeros(text));
}

}  // namespace dollytrack
