#include "engine/io/assimp/model_text_repair.h"

#include "engine/core/name_pattern.h"
#include "engine/io/assimp/assimp_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>

namespace dollytrack {
namespace {

constexpr std::size_t kLargest = std::size_t{1} << 31U;  // bytes; larger files are not repaired

bool isDigit(std::uint8_t c) {
    return c >= '0' && c <= '9';
}

/// Whether this is the decimal point of a number without leading zero: after a blank or a sign, and
/// before a digit. This excludes points in file names.
bool isBarePoint(const std::vector<std::uint8_t>& text, std::size_t at) {
    if (at == 0 || at + 1 >= text.size() || !isDigit(text[at + 1])) return false;
    std::size_t before = at - 1;
    if (text[before] == '-' || text[before] == '+') {
        if (before == 0) return false;
        --before;
    }
    return text[before] == ' ' || text[before] == '\t';
}

/// Position of the next bare point at or after `at`; the text's size if there is none.
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

/// Calls visit(begin, line) for each line of an OBJ text. A backslash at the end of a line
/// continues it.
template <class Visit>
void eachObjLine(std::string_view text, Visit&& visit) {
    for (std::size_t begin = 0; begin < text.size();) {
        std::size_t end = begin;
        while (true) {
            end = std::min(text.find('\n', end), text.size());
            const std::size_t last = text.substr(begin, end - begin).find_last_not_of('\r');
            if (end == text.size() || last == text.npos || text[begin + last] != '\\') break;
            ++end;
        }
        visit(begin, text.substr(begin, end - begin));
        begin = end + 1;
    }
}

std::string_view withoutIndent(std::string_view line) {
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    return line;
}

bool isLineOf(std::string_view keyword, std::string_view line) {
    return line.size() > keyword.size() && line.starts_with(keyword) &&
           (line[keyword.size()] == ' ' || line[keyword.size()] == '\t');
}

template <class Visit>
void eachCorner(std::string_view face, Visit&& visit) {
    constexpr std::string_view kBetween = " \t\r\n\\";
    for (std::size_t at = 1; at < face.size();) {
        const std::size_t begin = face.find_first_not_of(kBetween, at);
        if (begin == face.npos) return;
        at = std::min(face.find_first_of(kBetween, begin), face.size());
        visit(face.substr(begin, at - begin));
    }
}

/// The second number of "7/8/9"; nullopt if there is none.
std::optional<long long> coordinateOf(std::string_view corner) {
    const auto slash = corner.find('/');
    if (slash == corner.npos) return std::nullopt;
    long long value = 0;
    const auto [end, error] =
        std::from_chars(corner.data() + slash + 1, corner.data() + corner.size(), value);
    if (error == std::errc::result_out_of_range) return std::numeric_limits<long long>::max();
    if (error != std::errc()) return std::nullopt;
    return value;
}

/// Whether a face refers to texture coordinates that do not exist. `count`: their number in the
/// file; `before`: their number before the face, from which negative indices count backwards.
bool missesCoordinates(std::string_view face, long long before, long long count) {
    bool missing = false;
    eachCorner(face, [&](std::string_view corner) {
        const auto value = coordinateOf(corner);
        missing = missing || (value && (*value > count || *value < -before || *value == 0));
    });
    return missing;
}

void appendWithoutCoordinates(std::string_view face, std::string& text) {
    text += 'f';
    eachCorner(face, [&](std::string_view corner) {
        const std::size_t first = corner.find('/');
        const std::size_t second = first == corner.npos ? first : corner.find('/', first + 1);
        text += ' ';
        text += corner.substr(0, first);
        if (second == corner.npos) return;
        text += "//";
        text += corner.substr(second + 1);
    });
}

/// The end of the tag, comment or other markup that begins at `at`, behind its '>'; npos if it has
/// none. A DOCTYPE ends at its '[': the declarations in it are markup of their own.
std::size_t markupEnd(std::string_view xml, std::size_t at) {
    struct Section {
        std::string_view begin, end;
    };
    static constexpr std::array<Section, 3> kSections = {
        Section{"<!--", "-->"}, Section{"<![", "]]>"}, Section{"<?", "?>"}};
    for (const Section& section : kSections) {
        if (!xml.substr(at).starts_with(section.begin)) continue;
        at = xml.find(section.end, at + section.begin.size());
        return at == xml.npos ? at : at + section.end.size();
    }
    while (true) {
        at = xml.find_first_of("\"'>[", at);
        if (at == xml.npos) return at;
        if (xml[at] == '>' || xml[at] == '[') return at + 1;
        at = xml.find(xml[at], at + 1);  // the value of an attribute may contain a '>'
        if (at == xml.npos) return at;
        ++at;
    }
}

/// Whether a line of an MTL file without its indent is a statement that assimp reads.
bool isMaterialStatement(std::string_view line) {
    static constexpr std::array<std::string_view, 15> kWithNumbers = {
        "ka", "kd",    "ks", "ke", "ns", "ni", "tf", "tr",
        "d",  "illum", "pr", "pm", "ps", "pc", "pcr"};
    static constexpr std::array<std::string_view, 5> kWithNames = {"newmtl", "bump", "disp", "refl",
                                                                   "norm"};
    const std::size_t length = std::min(line.find_first_of(" \t\r"), line.size());
    const std::string keyword = inSmallLetters(std::string(line.substr(0, length)));
    if (keyword.starts_with("map_") || std::ranges::find(kWithNames, keyword) != kWithNames.end()) {
        return true;
    }
    if (std::ranges::find(kWithNumbers, keyword) == kWithNumbers.end()) return false;
    std::string_view value = withoutIndent(line.substr(length));
    if (value.starts_with('-') || value.starts_with('+')) value.remove_prefix(1);
    if (value.starts_with('.')) value.remove_prefix(1);
    return !value.empty() && isDigit(static_cast<std::uint8_t>(value.front()));
}

struct TextRange {
    std::size_t begin = 0;
    std::size_t size = 0;
};

/// The value of an attribute in the tag from `begin` to `end` of a text.
std::optional<TextRange> attributeIn(std::string_view text, std::size_t begin, std::size_t end,
                                     std::string_view name) {
    constexpr std::string_view kBlanks = " \t\r\n";
    const std::string_view tag = text.substr(begin, end - begin);
    std::size_t at = tag.find_first_of(kBlanks);
    while (true) {
        at = tag.find_first_not_of(kBlanks, at);
        const std::size_t equals = tag.find('=', at);
        if (at == tag.npos || equals == tag.npos) return std::nullopt;
        const std::string_view word = tag.substr(at, tag.find_first_of(" \t\r\n=", at) - at);
        const std::size_t quote = tag.find_first_not_of(kBlanks, equals + 1);
        if (quote == tag.npos || (tag[quote] != '"' && tag[quote] != '\'')) return std::nullopt;
        const std::size_t close = tag.find(tag[quote], quote + 1);
        if (close == tag.npos) return std::nullopt;
        if (word == name) return TextRange{begin + quote + 1, close - quote - 1};
        at = close + 1;
    }
}

/// A whole number of at most 32 bits; the largest of them for any other text, which no array has.
std::size_t countIn(std::string_view text) {
    constexpr std::size_t kMost = std::numeric_limits<std::uint32_t>::max();
    std::size_t count = 0;
    const auto read = std::from_chars(text.data(), text.data() + text.size(), count);
    const bool whole = read.ec == std::errc() && read.ptr == text.data() + text.size();
    return whole ? std::min(count, kMost) : kMost;
}

std::size_t countWords(std::string_view text) {
    constexpr std::string_view kBlanks = " \t\r\n";
    std::size_t words = 0;
    for (std::size_t at = text.find_first_not_of(kBlanks); at != text.npos;) {
        ++words;
        const std::size_t blank = text.find_first_of(kBlanks, at);
        at = blank == text.npos ? blank : text.find_first_not_of(kBlanks, blank);
    }
    return words;
}

/// A count attribute's value, and the right one.
struct CountCorrection {
    TextRange at;
    std::size_t count = 0;
};

/// The arrays and accessors of a Collada text.
class ColladaArrays {
  public:
    explicit ColladaArrays(std::string_view collada) : collada_(collada) {}

    /// Takes note of the tag from `begin` to `end`.
    void visit(std::size_t begin, std::size_t end) {
        const std::string_view tag = collada_.substr(begin, end - begin);
        const std::string_view name = tag.substr(1, tag.find_first_of(" \t\r\n/>", 1) - 1);
        if (name == "float_array" || name == "Name_array" || name == "IDREF_array") {
            visitArray(begin, end);
        } else if (name == "accessor") {
            visitAccessor(begin, end);
        } else if (name == "param" && in_accessor_) {
            ++accessors_.back().params;
        } else if (tag.starts_with("</accessor")) {
            in_accessor_ = false;
        }
    }

    /// The counts that are wrong. Accessors of unknown arrays get none.
    [[nodiscard]] std::vector<CountCorrection> corrections() const {
        std::vector<CountCorrection> corrections = array_corrections_;
        for (const Accessor& accessor : accessors_) {
            const auto array = length_of_.find(accessor.source);
            const std::size_t length = array == length_of_.end() ? 0 : array->second;
            const std::size_t first = accessor.offset + std::max(accessor.stride, accessor.params);
            const std::size_t readable =
                length < first ? 0 : (length - first) / accessor.stride + 1;
            if (accessor.count > readable) corrections.push_back({accessor.count_at, readable});
        }
        return corrections;
    }

  private:
    struct Accessor {
        std::string_view source;  // id of the array
        TextRange count_at;
        std::size_t count = 0;
        std::size_t offset = 0;
        std::size_t stride = 1;
        std::size_t params = 0;
    };

    [[nodiscard]] std::string_view textOf(const TextRange& range) const {
        return collada_.substr(range.begin, range.size);
    }

    void visitArray(std::size_t begin, std::size_t end) {
        const bool self_closing = collada_[end - 2] == '/';
        const std::size_t close =
            self_closing ? end : std::min(collada_.find('<', end), collada_.size());
        const std::size_t length = countWords(collada_.substr(end, close - end));
        if (const auto id = attributeIn(collada_, begin, end, "id")) {
            length_of_[textOf(*id)] = length;
        }
        const auto count = attributeIn(collada_, begin, end, "count");
        if (count && countIn(textOf(*count)) != length) {
            array_corrections_.push_back({*count, length});
        }
    }

    void visitAccessor(std::size_t begin, std::size_t end) {
        const auto source = attributeIn(collada_, begin, end, "source");
        const auto count = attributeIn(collada_, begin, end, "count");
        in_accessor_ = count && collada_[end - 2] != '/';
        if (!count) return;
        const auto numberOf = [&](std::string_view attribute, std::size_t otherwise) {
            const auto range = attributeIn(collada_, begin, end, attribute);
            return range ? countIn(textOf(*range)) : otherwise;
        };
        std::string_view id = source ? textOf(*source) : std::string_view();
        if (id.starts_with('#')) id.remove_prefix(1);
        accessors_.push_back({id, *count, countIn(textOf(*count)), numberOf("offset", 0),
                              std::max<std::size_t>(1, numberOf("stride", 1)), 0});
    }

    std::string_view collada_;
    std::map<std::string_view, std::size_t> length_of_;  // of arrays, by id
    std::vector<Accessor> accessors_;
    std::vector<CountCorrection> array_corrections_;
    bool in_accessor_ = false;
};

std::vector<CountCorrection> findWrongCounts(std::string_view collada) {
    ColladaArrays arrays(collada);
    std::size_t end = 0;
    for (std::size_t at = collada.find('<'); at != collada.npos; at = collada.find('<', end)) {
        end = markupEnd(collada, at);
        if (end == collada.npos) return {};  // no XML; assimp refuses it
        arrays.visit(at, end);
    }
    return arrays.corrections();
}

}  // namespace

void ModelTextRepairs::noteMaterial(const std::filesystem::path& file, bool opened) {
    const std::string name = file.filename().string();
    sought_materials.insert(name);
    if (opened) opened_materials.insert(name);
}

std::set<std::string> ModelTextRepairs::missingMaterials() const {
    std::set<std::string> missing;
    std::ranges::set_difference(sought_materials, opened_materials,
                                std::inserter(missing, missing.end()));
    return missing;
}

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

bool mendObjLines(std::vector<std::uint8_t>& text, std::size_t& mended_faces) {
    const std::string_view all(reinterpret_cast<const char*>(text.data()), text.size());
    long long count = 0;
    eachObjLine(all, [&](std::size_t /*begin*/, std::string_view line) {
        count += isLineOf("vt", withoutIndent(line)) ? 1 : 0;
    });
    long long before = 0;
    std::string kept;
    bool changed = false;
    eachObjLine(all, [&](std::size_t begin, std::string_view line) {
        const std::string_view words = withoutIndent(line);
        before += isLineOf("vt", words) ? 1 : 0;
        const bool missing = isLineOf("f", words) && missesCoordinates(words, before, count);
        const bool indented =
            words.size() < line.size() && words.find_first_of("\r#") != 0 && !words.empty();
        if (!changed && !missing && !indented) return;
        if (!changed) {
            kept.reserve(all.size());
            kept = all.substr(0, begin);
            changed = true;
        }
        mended_faces += missing ? 1 : 0;
        if (missing) {
            appendWithoutCoordinates(words, kept);
        } else {
            kept += words;
        }
        kept += '\n';
    });
    if (changed) text.assign(kept.begin(), kept.end());
    return changed;
}

bool dropUnknownMaterialLines(std::vector<std::uint8_t>& text) {
    const std::string all(reinterpret_cast<const char*>(text.data()), text.size());
    bool changed = false;
    for (std::size_t begin = 0; begin < all.size();) {
        const std::size_t end = std::min(all.find('\n', begin), all.size());
        const std::string_view words =
            withoutIndent(std::string_view(all).substr(begin, end - begin));
        const bool is_empty = words.find_first_of("\r#") == 0 || words.empty();
        if (!is_empty && !isMaterialStatement(words)) {
            text[begin] = '#';
            changed = true;
        }
        begin = end + 1;
    }
    return changed;
}

bool removeBlanksBeforeColors(std::vector<std::uint8_t>& text) {
    constexpr std::string_view kTag = "<color";
    const std::string_view all(reinterpret_cast<const char*>(text.data()), text.size());
    std::string kept;
    std::size_t copied = 0;
    for (std::size_t at = all.find(kTag); at != all.npos; at = all.find(kTag, at)) {
        at = std::min(all.find('>', at), all.size() - 1) + 1;
        const std::size_t number = std::min(all.find_first_not_of(" \t\r\n", at), all.size());
        if (number == at) continue;
        kept += all.substr(copied, at - copied);
        copied = at = number;
    }
    if (copied == 0) return false;
    kept += all.substr(copied);
    text.assign(kept.begin(), kept.end());
    return true;
}

bool mendArrayCounts(std::vector<std::uint8_t>& text) {
    const std::string_view collada(reinterpret_cast<const char*>(text.data()), text.size());
    std::vector<CountCorrection> corrections = findWrongCounts(collada);
    if (corrections.empty()) return false;
    std::ranges::sort(corrections, {}, [](const auto& one) { return one.at.begin; });
    std::string mended;
    std::size_t done = 0;
    for (const auto& [at, count] : corrections) {
        mended += collada.substr(done, at.begin - done);
        mended += std::to_string(count);
        done = at.begin + at.size;
    }
    mended += collada.substr(done);
    text.assign(mended.begin(), mended.end());
    return true;
}

std::size_t lineOfBadIndices(std::string_view collada) {
    static constexpr std::array<std::string_view, 7> kPrimitives = {
        "triangles", "polylist", "polygons", "lines", "linestrips", "trifans", "tristrips"};
    std::size_t open_primitives = 0;
    std::size_t end = 0;
    for (std::size_t at = collada.find('<'); at != collada.npos; at = collada.find('<', end)) {
        end = markupEnd(collada, at);
        if (end == collada.npos) return 0;  // no XML; assimp refuses it
        const std::string_view tag = collada.substr(at + 1, end - at - 2);
        const bool closing = tag.starts_with('/');
        const bool empty = tag.ends_with('/');
        const std::string_view word = tag.substr(closing ? 1 : 0);
        const std::string_view name = word.substr(0, word.find_first_of(" \t\r\n/"));
        if (std::ranges::find(kPrimitives, name) != kPrimitives.end() && !empty) {
            if (!closing) ++open_primitives;
            if (closing && open_primitives > 0) --open_primitives;
        }
        if (name != "p" || closing || empty || open_primitives == 0) continue;
        const std::size_t other = collada.find_first_not_of("0123456789+- \t\r\n", end);
        if (other == collada.npos) return 0;
        if (collada.substr(other).starts_with("</")) continue;
        return 1 +
               static_cast<std::size_t>(std::count(collada.begin(), collada.begin() + other, '\n'));
    }
    return 0;
}

Assimp::IOStream* mendText(Assimp::IOStream* stream, const std::string& extension,
                           ModelTextRepairs& repairs) {
    const bool collada = extension == ".dae";
    const bool material = extension == ".mtl";
    if (!stream || stream->FileSize() > kLargest || !(collada || material || extension == ".obj")) {
        return stream;
    }
    std::unique_ptr<Assimp::IOStream> old(stream);
    std::vector<std::uint8_t> text(stream->FileSize());
    bool changed = false;
    if (!text.empty() && stream->Read(text.data(), 1, text.size()) == text.size()) {
        if (collada) {
            const std::size_t line =
                lineOfBadIndices({reinterpret_cast<const char*>(text.data()), text.size()});
            if (line > 0) {
                repairs.refusal = fmt::format("an index in line {} is not a whole number", line);
                return nullptr;
            }
            changed = removeBlanksBeforeColors(text);
            changed = mendArrayCounts(text) || changed;
        } else if (material) {
            changed = dropUnknownMaterialLines(text);
        } else {
            changed = hasBarePoints(text);
            if (changed) text = withLeadingZeros(text);
            repairs.mended_faces = 0;  // assimp may open the file again; its faces count once
            changed = mendObjLines(text, repairs.mended_faces) || changed;
        }
    }
    if (changed) return openBytes(std::move(text));
    stream->Seek(0, aiOrigin_SET);
    return old.release();
}

}  // namespace dollytrack
