#include "engine/scene/label_table.h"

#include "engine/core/clean_text.h"
#include "engine/core/name_pattern.h"
#include "engine/scene/labels.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <sstream>

namespace dollytrack {

/// The files of assets/labels, embedded as strings at build time.
extern const char* const kLanguageLabels;
extern const char* const kNyu40Labels;
extern const char* const kFront3dLabels;
extern const char* const kShapeNetLabels;

namespace {

bool isUpper(char c) {
    return std::isupper(static_cast<unsigned char>(c)) != 0;
}
bool isLower(char c) {
    return std::islower(static_cast<unsigned char>(c)) != 0;
}
/// Letters of other alphabets (UTF-8 bytes) count as letters.
bool isLetter(char c) {
    return std::isalpha(static_cast<unsigned char>(c)) != 0 ||
           (static_cast<unsigned char>(c) & 0x80U);
}

/// The small letter of a capital: Latin with accents, Greek and Cyrillic.
unsigned smallLetter(unsigned code) {
    const auto isIn = [&](unsigned first, unsigned last) { return code >= first && code <= last; };
    if ((isIn(0xC0, 0xDE) && code != 0xD7) || isIn(0x391, 0x3A9) || isIn(0x410, 0x42F)) {
        return code + 0x20;
    }
    if (isIn(0x400, 0x40F)) return code + 0x50;
    // Here capitals and small letters alternate.
    if (isIn(0x139, 0x148) || isIn(0x179, 0x17E)) return code + code % 2;
    if (isIn(0x100, 0x137) || isIn(0x14A, 0x177)) return code | 1U;
    return code;
}

/// Converts capitals of two bytes in UTF-8; those of ASCII are small already.
std::string withSmallLetters(std::string word) {
    for (std::size_t i = 0; i + 1 < word.size(); ++i) {
        const unsigned lead = static_cast<unsigned char>(word[i]);
        const unsigned next = static_cast<unsigned char>(word[i + 1]);
        if ((lead & 0xE0U) != 0xC0U || (next & 0xC0U) != 0x80U) continue;
        const unsigned code = smallLetter((lead & 0x1FU) << 6U | (next & 0x3FU));
        word[i] = static_cast<char>(0xC0U | code >> 6U);
        word[i + 1] = static_cast<char>(0x80U | (code & 0x3FU));
    }
    return word;
}

/// Reduces plurals: "shelves" to "shelf", "boxes" to "box".
std::string singular(std::string word) {
    const auto endsWith = [&](std::string_view end) {
        return word.size() > end.size() + 1 && word.ends_with(end);
    };
    if (word == "glasses" || word == "clothes" || word == "sunglasses") return word;
    // For this ending, the word may consist of the ending only.
    if (word.ends_with("shelves")) return word.substr(0, word.size() - 3) + "f";
    if (word == "knives") return "knife";
    if (word == "leaves") return "leaf";
    if (endsWith("ies")) return word.substr(0, word.size() - 3) + "y";
    if (endsWith("ches") || endsWith("shes") || endsWith("xes") || endsWith("sses")) {
        return word.substr(0, word.size() - 2);
    }
    if (endsWith("s") && !endsWith("ss") && !endsWith("us") && !endsWith("is")) word.pop_back();
    return word;
}

std::string join(const std::vector<std::string>& words, std::size_t first, std::size_t count) {
    std::string text = words[first];
    for (std::size_t i = 1; i < count; ++i) text += ' ' + words[first + i];
    return text;
}

bool isPreposition(const std::string& word) {
    static constexpr std::array<std::string_view, 6> kWords = {"with", "of", "for",
                                                               "in",   "on", "without"};
    return std::find(kWords.begin(), kWords.end(), word) != kWords.end();
}

/// An adjective of shape, size, state or style. One that follows a noun describes it together with
/// the words behind it: a "bookcase closed doors" is a bookcase.
bool isTrailingAdjective(const std::string& word) {
    static constexpr std::array<std::string_view, 17> kWords = {
        "closed", "open",   "round",   "rounded", "square", "rectangular",
        "oval",   "modern", "vintage", "large",   "narrow", "wide",
        "tall",   "high",   "low",     "long",    "short"};
    return std::find(kWords.begin(), kWords.end(), word) != kWords.end();
}

/// Whether a word of the name ends in "Mat" for material: "orangeMat", "lampMat_0".
bool endsInMat(std::string_view name) {
    constexpr std::string_view kMat = "Mat";
    for (std::size_t at = name.find(kMat); at != std::string_view::npos;
         at = name.find(kMat, at + 1)) {
        const auto isSmall = [&](std::size_t i) {
            return i < name.size() && std::islower(static_cast<unsigned char>(name[i])) != 0;
        };
        if (at > 0 && isSmall(at - 1) && !isSmall(at + kMat.size())) return true;
    }
    return false;
}

}  // namespace

bool isStructureClass(int nyu40) {
    return nyu40 == kNyuWall || nyu40 == kNyuFloor || nyu40 == kNyuCeiling || nyu40 == kNyuDoor ||
           nyu40 == kNyuWindow || nyu40 == kNyuOtherStructure;
}

namespace {

/// A name in the form of patterns: "bunk beds" becomes "bunk bed"; empty if it has no words.
std::string asWords(const std::string& name) {
    std::vector<std::string> words = wordsOfName(name);
    for (std::string& word : words) word = singular(std::move(word));
    return words.empty() ? std::string() : join(words, 0, words.size());
}

}  // namespace

bool namesBackdrop(std::string_view name) {
    static constexpr std::array<std::string_view, 8> kWords = {
        "backdrop", "background", "horizon", "panorama", "sky", "skybox", "skydome", "skyline"};
    const std::vector<std::string> words = wordsOfName(name);
    return std::ranges::any_of(words, [](const std::string& word) {
        return std::ranges::find(kWords, word) != kWords.end();
    });
}

std::vector<std::string> wordsOfName(std::string_view name) {
    std::vector<std::string> words;
    std::string word;
    const auto finish = [&] {
        if (!word.empty()) words.push_back(withSmallLetters(std::move(word)));
        word.clear();
    };
    for (std::size_t i = 0; i < name.size(); ++i) {
        const char c = name[i];
        if (!isLetter(c)) {
            finish();
            continue;
        }
        // "SofaC" and "TVCabinet" are two words each, "TVs" is one.
        if (isUpper(c) && i > 0 && isLower(name[i - 1])) finish();
        if (isUpper(c) && i > 0 && isUpper(name[i - 1]) && i + 2 < name.size() &&
            isLower(name[i + 1]) && isLower(name[i + 2])) {
            finish();
        }
        word += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
    finish();
    return words;
}

std::string withoutNumber(std::string_view name) {
    std::size_t end = name.size();
    while (end > 0) {
        std::size_t at = end;
        while (at > 0 && std::isdigit(static_cast<unsigned char>(name[at - 1]))) --at;
        if (at == end) break;
        while (at > 0 && (name[at - 1] == '_' || name[at - 1] == '.' || name[at - 1] == ' ' ||
                          name[at - 1] == '-' || name[at - 1] == '#')) {
            --at;
        }
        if (at == 0) break;
        end = at;
    }
    return std::string(name.substr(0, end));
}

const LabelTable& LabelTable::builtIn() {
    static const LabelTable table = [] {
        LabelTable made;
        // A test checks every line of these files, so errors cannot occur here.
        static_cast<void>(made.add(kLanguageLabels, "languages.csv"));
        static_cast<void>(made.add(kNyu40Labels, "nyu40.csv"));
        static_cast<void>(made.add(kFront3dLabels, "front3d.csv"));
        static_cast<void>(made.add(kShapeNetLabels, "shapenet.csv"));
        return made;
    }();
    return table;
}

Status LabelTable::add(std::string_view csv, const std::string& where) {
    std::multimap<std::string, std::string> whole_by_words;
    for (const auto& [name, entry] : whole_names_) whole_by_words.emplace(asWords(name), name);
    std::istringstream lines{std::string(csv)};
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number) {
        line = trimmed(std::string_view(line).substr(0, line.find('#')));
        if (line.empty()) continue;
        std::vector<std::string> columns;
        std::istringstream cells(line);
        for (std::string cell; std::getline(cells, cell, ',');) columns.emplace_back(trimmed(cell));
        const std::string place = where + ":" + std::to_string(number);
        if (columns.size() < 2 || columns.size() > 3) {
            return fail(ErrorCode::BadInput,
                        "a label line is \"pattern,class[,structure|target|part|weak|component]\"",
                        place);
        }
        const bool whole_name = columns[0].starts_with('=');
        std::vector<std::string> words = wordsOfName(columns[0]);
        if (whole_name ? columns[0].size() == 1 : words.empty()) {
            return fail(ErrorCode::BadInput, "the pattern has no letters", place);
        }
        for (std::string& word : words) word = singular(std::move(word));

        Entry entry;
        const std::string kind = columns.size() == 3 ? columns[2] : "";
        entry.nyu40 = nyu40FromName(columns[1]);
        if (entry.nyu40 == 0 && !(kind == "part" && columns[1].empty())) {
            return fail(ErrorCode::BadInput,
                        "\"" + columns[1] + "\" is not one of the 40 NYU classes", place);
        }
        if (kind.empty()) {
            entry.kind = isStructureClass(entry.nyu40) ? LabelKind::Structure : LabelKind::Target;
        } else if (kind == "structure") {
            entry.kind = LabelKind::Structure;
        } else if (kind == "target") {
            entry.kind = LabelKind::Target;
        } else if (kind == "part") {
            entry.kind = LabelKind::Part;
        } else if (kind == "weak") {
            entry.kind = LabelKind::Weak;
        } else if (kind == "component") {
            entry.kind = isStructureClass(entry.nyu40) ? LabelKind::Structure : LabelKind::Target;
            entry.component = true;
        } else {
            return fail(ErrorCode::BadInput,
                        "\"" + kind + "\" is not structure, target, part, weak or component",
                        place);
        }
        if (whole_name) {
            const std::string whole =
                inSmallLetters(trimmed(std::string_view(columns[0]).substr(1)));
            whole_names_[whole] = entry;
            whole_by_words.emplace(asWords(whole), whole);
            continue;
        }
        longest_ = std::max(longest_, words.size());
        const std::string text = join(words, 0, words.size());
        entries_[text] = entry;
        const auto [begin, end] = whole_by_words.equal_range(text);
        for (auto at = begin; at != end; ++at) whole_names_.erase(at->second);
        whole_by_words.erase(begin, end);
    }
    return {};
}

const std::string* LabelTable::mostTelling(std::span<const std::string> words) const {
    for (const LabelKind wanted : {LabelKind::Target, LabelKind::Structure, LabelKind::Weak}) {
        for (const std::string& word : words) {
            if (!word.empty() && find(word).kind == wanted) return &word;
        }
    }
    return nullptr;
}

bool LabelTable::mentions(std::string_view name, int nyu40) const {
    const std::vector<std::string> words = wordsOfName(name);
    return std::ranges::any_of(words, [&](const std::string& word) {
        const Label label = find(word);
        return label.kind == LabelKind::Target && label.nyu40 == nyu40;
    });
}

bool LabelTable::beginsPattern(const std::vector<std::string>& words, std::size_t at) const {
    for (std::size_t n = std::min(longest_, words.size() - at); n > 1; --n) {
        if (entries_.contains(join(words, at, n))) return true;
    }
    return false;
}

Label LabelTable::find(std::string_view name) const {
    const auto whole = whole_names_.find(inSmallLetters(trimmed(name)));
    if (whole != whole_names_.end()) {
        return {whole->second.kind, whole->second.nyu40, whole->first};
    }
    std::vector<std::string> words = wordsOfName(name);
    for (std::string& word : words) word = singular(std::move(word));

    Label best;
    Label weak;
    Label part;
    std::size_t best_end = 0;
    std::size_t weak_end = 0;
    bool described = false;   // after a preposition that is not part of a pattern
    std::size_t spanned = 0;  // words before this index belong to a matched pattern
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (i >= spanned && i > 0 && isPreposition(words[i])) described = true;
        if (best.kind == LabelKind::Target && i == best_end && isTrailingAdjective(words[i])) {
            described =
                described || !beginsPattern(words, i);  // 'high chair' is a pattern of its own
        }
        if (described && best.kind != LabelKind::None) break;
        for (std::size_t n = std::min(longest_, words.size() - i); n > 0; --n) {
            const std::string text = join(words, i, n);
            const auto found = entries_.find(text);
            if (found == entries_.end()) continue;
            if (i + n <= weak_end) break;  // "board" in "gypsum board"
            // "DarkWood_Mat", "Glass table mat" and "orangeMat" name materials.
            const bool is_material =
                text == "mat" &&
                (weak.kind != LabelKind::None || best.kind != LabelKind::None || endsInMat(name));
            if (is_material) break;
            const Label label{found->second.kind, found->second.nyu40, text};
            spanned = std::max(spanned, i + n);
            const bool of_thing = found->second.component && i >= best_end &&
                                  best.kind == LabelKind::Target && best.nyu40 != label.nyu40;
            if (of_thing) {  // "chair frame"
                part = {LabelKind::Part, best.nyu40, text};
            } else if (label.kind == LabelKind::Weak) {
                weak = label;
                weak_end = i + n;
            } else if (label.kind == LabelKind::Part) {
                part = label;
            } else if (i + n > best_end) {
                best = label;
                best_end = i + n;
            }
            break;  // the longest match at this word
        }
    }
    if (part.kind != LabelKind::None) {  // "sofa legs": a part, of a known class
        part.nyu40 = best.nyu40 != 0 ? best.nyu40 : part.nyu40;
        return part;
    }
    return best.kind != LabelKind::None ? best : weak;
}

}  // namespace dollytrack
