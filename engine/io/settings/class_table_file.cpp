#include "engine/io/settings/class_table_file.h"

#include "engine/core/clean_text.h"
#include "engine/core/name_hint.h"
#include "engine/core/name_pattern.h"
#include "engine/document/json_reader.h"
#include "engine/io/files/bounded_json.h"
#include "engine/io/files/file_type.h"
#include "engine/io/files/input_file.h"
#include "engine/scene/labels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace dollytrack {
namespace {

using nlohmann::json;
using Color = std::array<std::uint8_t, 3>;

constexpr const char* kLabelFormat = "dollytrack-labels";
constexpr const char* kIgnore = "ignore";
constexpr std::size_t kLongestName = 100;

/// Rejects unknown keys, which are probably misspelt and would have no effect.
void checkKeys(const JsonReader& from, const std::vector<std::string>& known) {
    if (!from.json().is_object()) return from.refuse("This must be an object.");
    for (const auto& [key, value] : from.json().items()) {
        if (std::ranges::find(known, key) != known.end()) continue;
        from.refuse(fmt::format("There is no key '{}'{}", cleanText(key), nameHint(key, known)));
    }
}

/// A name that can be written in all formats, on one line.
std::string readName(const JsonReader& from) {
    std::string name = from.text();
    const bool blank = name.find_first_not_of(' ') == std::string::npos;
    if (from.good() && (blank || name.size() > kLongestName || name != cleanText(name))) {
        from.refuse(fmt::format(
            "A name has 1 to {} bytes, is not blank and has no control characters.", kLongestName));
    }
    return name;
}

Color readColor(const JsonReader& from) {
    constexpr const char* kForms = "A colour is \"#rrggbb\" or three numbers from 0 to 255.";
    Color color{};
    if (from.json().is_string()) {
        const std::string text = from.text();
        const bool digits = text.find_first_not_of("0123456789abcdefABCDEF", 1) == text.npos;
        if (text.size() != 7 || text[0] != '#' || !digits) {
            from.refuse(kForms);
            return color;
        }
        const unsigned long all = std::stoul(text.substr(1), nullptr, 16);
        return {static_cast<std::uint8_t>(all >> 16U), static_cast<std::uint8_t>(all >> 8U),
                static_cast<std::uint8_t>(all)};
    }
    if (!from.json().is_array() || from.json().size() != 3) {
        from.refuse(kForms);
        return color;
    }
    for (std::size_t i = 0; i < 3; ++i) {
        color[i] = static_cast<std::uint8_t>(from.at(i).integer(0, 255));
    }
    return color;
}

/// A key that is equal for names that some format would write alike; KITTI replaces blanks by `_`.
std::string comparable(const std::string& name) {
    std::string result = inSmallLetters(name);
    std::ranges::replace(result, ' ', '_');
    return result;
}

class TableReader {
  public:
    explicit TableReader(const JsonReader& from) : from_(from) {}

    /// The table; valid only if `from` has no error afterwards.
    ClassTable read() {
        const JsonReader classes = from_.at("classes");
        if (!classes.json().is_array() || classes.json().empty()) {
            classes.refuse("A class table needs a list of at least one class.");
        }
        for (std::size_t i = 0; i < classes.size() && from_.good(); ++i) {
            readClass(classes.at(i));
        }
        fillColors();
        const std::optional<std::size_t> other = readOther(from_.at("other"));
        const int void_id = readVoid(from_.at("void"));
        return {std::move(rules_), other, void_id};
    }

  private:
    void readClass(const JsonReader& from) {
        checkKeys(from, {"id", "name", "color", "supercategory", "matches"});
        if (!from.good()) return;
        ClassRule rule;
        rule.made.id = from.at("id").integer(0, ClassTable::kLargestId);
        rule.made.name = readName(from.at("name"));
        if (!from.good()) return;
        const auto [owner, is_new_id] = by_id_.emplace(rule.made.id, rules_.size());
        if (!is_new_id) {
            return from.at("id").refuse(
                fmt::format("The class '{}' also has the id {}; give each class its own id.",
                            rules_[owner->second].made.name, rule.made.id));
        }
        const std::string name = comparable(rule.made.name);
        if (name == ClassTable::kVoidName || name == kIgnore) {
            return from.at("name").refuse(
                "The names void and ignore mean that there is no class; set the id of void with "
                "\"void\".");
        }
        if (!by_name_.emplace(name, rules_.size()).second) {
            return from.at("name").refuse(fmt::format(
                "Another class is also named '{}'; names must differ in more than case and blanks.",
                rule.made.name));
        }
        const JsonReader color = from.at("color");
        colors_.push_back(color.absent() ? std::nullopt : std::optional(readColor(color)));
        if (const JsonReader above = from.at("supercategory"); !above.absent()) {
            rule.made.supercategory = readName(above);
        }
        const JsonReader matches = from.at("matches");
        if (matches.absent()) rule.patterns.push_back(rule.made.name);
        for (std::size_t i = 0; i < matches.size() && from.good(); ++i) {
            rule.patterns.push_back(readName(matches.at(i)));
        }
        rules_.push_back(std::move(rule));
    }

    void fillColors() {
        std::vector<Color> taken = {Color{0, 0, 0}};
        for (const auto& color : colors_) {
            if (color) taken.push_back(*color);
        }
        for (std::size_t i = 0; i < rules_.size() && i < colors_.size(); ++i) {
            rules_[i].made.color = colors_[i] ? *colors_[i] : distinctColor(i, taken);
            if (!colors_[i]) taken.push_back(rules_[i].made.color);
        }
    }

    /// The class with a name or id; none for "ignore" and a missing value.
    std::optional<std::size_t> readOther(const JsonReader& from) {
        if (!from.good() || from.absent() || from.json() == kIgnore) return std::nullopt;
        if (from.json().is_number()) {
            const auto found = by_id_.find(from.integer(0, ClassTable::kLargestId));
            if (found != by_id_.end()) return found->second;
            from.refuse("No class of the table has this id.");
            return std::nullopt;
        }
        const std::string name = from.text();
        if (!from.good()) return std::nullopt;
        const auto found = by_name_.find(comparable(name));
        if (found != by_name_.end()) return found->second;
        std::vector<std::string> names = {kIgnore};
        for (const ClassRule& rule : rules_) names.push_back(rule.made.name);
        from.refuse(
            fmt::format("The table has no class '{}'{}", cleanText(name), nameHint(name, names)));
        return std::nullopt;
    }

    /// The id of void: the given one, otherwise 0 if no class has it, otherwise 255 or 65535.
    int readVoid(const JsonReader& from) {
        if (!from.good()) return 0;
        if (!from.absent()) {
            const int id = from.integer(0, ClassTable::kLargestId);
            if (const auto owner = by_id_.find(id); from.good() && owner != by_id_.end()) {
                from.refuse(fmt::format("The class '{}' has this id; give void another one.",
                                        rules_[owner->second].made.name));
            }
            return id;
        }
        if (!by_id_.contains(0)) return 0;
        for (const int id : {255, ClassTable::kLargestId}) {
            if (by_id_.rbegin()->first < id) return id;
        }
        from_.refuse(
            "Set \"void\", the id of pixels without a class, to a number that no class has.");
        return 0;
    }

    const JsonReader& from_;
    std::vector<ClassRule> rules_;
    std::vector<std::optional<Color>> colors_;
    std::map<int, std::size_t> by_id_;
    std::map<std::string, std::size_t> by_name_;
};

std::optional<ClassTable> readTable(const JsonReader& from) {
    checkKeys(from, {"$schema", "format", "version", "classes", "other", "void", "words"});
    if (!from.good()) return std::nullopt;
    if (const JsonReader format = from.at("format");
        !format.absent() && format.json() != kLabelFormat) {
        format.refuse(fmt::format("This must be \"{}\".", kLabelFormat));
    }
    if (const JsonReader version = from.at("version"); !version.absent()) {
        if (version.integer(1, 1'000'000) > 1 && from.good()) {
            version.refuse("The file was made by a newer version of Dollytrack; use that version.");
        }
    }
    // A file with only words uses NYU40's classes.
    const bool words_alone = from.at("classes").absent() && !from.at("words").absent();
    if (words_alone) {
        for (const char* key : {"other", "void"}) {
            if (!from.at(key).absent())
                from.at(key).refuse("This key is only allowed together with \"classes\".");
        }
        return std::nullopt;
    }
    return TableReader(from).read();
}

Error atPlace(const Error& error, const std::string& where) {
    return {error.code, error.message, where + (error.where.empty() ? "" : ": " + error.where)};
}

}  // namespace

Result<ClassTable> classTableFromJson(const json& content, const std::string& where) {
    Status status;
    const JsonReader from(content, "", status);
    std::optional<ClassTable> table = readTable(from);
    if (!status) return tl::unexpected(atPlace(status.error(), where));
    if (!table)
        return fail(ErrorCode::BadInput, "A class table needs a list of at least one class.",
                    where);
    return std::move(*table);
}

Result<LabelFile> readLabelFile(const std::filesystem::path& path) {
    constexpr std::uint64_t kMostBytes = std::uint64_t{4} << 20U;
    Result<std::string> text = readNamedFile(path, kMostBytes);
    if (!text) return tl::unexpected(text.error());
    LabelFile file;
    file.word_place = path.string();
    if (firstLetter(*text) != '{') {
        file.word_lines = std::move(*text);
        return file;
    }
    const Result<json> content = parseBoundedJson(*text, path.string());
    if (!content) return tl::unexpected(content.error());
    Status status;
    const JsonReader from(*content, "", status);
    if (std::optional<ClassTable> table = readTable(from)) {
        file.classes = std::make_shared<const ClassTable>(std::move(*table));
    }
    const JsonReader words = from.at("words");
    for (std::size_t i = 0; i < words.size() && from.good(); ++i) {
        file.word_lines += readName(words.at(i)) + "\n";
    }
    file.word_place += ": words";
    if (!status) return tl::unexpected(atPlace(status.error(), path.string()));
    return file;
}

nlohmann::ordered_json classTableToJson(const ClassTable& table) {
    nlohmann::ordered_json classes = nlohmann::ordered_json::array();
    for (const ClassRule& rule : table.rules()) {
        const DatasetClass& made = rule.made;
        nlohmann::ordered_json one = {{"id", made.id}, {"name", made.name}, {"color", made.color}};
        if (!made.supercategory.empty()) one["supercategory"] = made.supercategory;
        one["matches"] = rule.patterns;
        classes.push_back(std::move(one));
    }
    return {{"format", kLabelFormat},
            {"version", 1},
            {"classes", std::move(classes)},
            {"other", table.other() ? table.rules()[*table.other()].made.name : kIgnore},
            {"void", table.voidClass().id}};
}

}  // namespace dollytrack
