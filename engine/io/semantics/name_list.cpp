#include "engine/io/semantics/name_list.h"

#include "engine/core/clean_text.h"
#include "engine/io/files/bounded_json.h"
#include "engine/io/files/confined_folder.h"
#include "engine/io/files/input_file.h"
#include "engine/io/files/number_lines.h"

#include <charconv>
#include <cmath>
#include <string_view>

namespace dollytrack::semantics {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using Names = std::map<std::int64_t, std::string>;

constexpr std::uint64_t kMostListBytes = std::uint64_t{64} << 20U;
constexpr double kMostListedNumber = 1e15;

std::optional<std::int64_t> listedNumber(std::string_view text) {
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return value;
}

std::optional<std::int64_t> listedNumber(const json& value) {
    if (!value.is_number()) return std::nullopt;
    const double number = value.get<double>();
    if (!(std::abs(number) < kMostListedNumber) || number != std::floor(number)) {
        return std::nullopt;
    }
    return static_cast<std::int64_t>(number);
}

void takeEntry(const json& entry, Names& names) {
    if (!entry.is_object()) return;
    std::optional<std::int64_t> id;
    for (const char* key : {"id", "object_id", "objectId", "class_id"}) {
        if (!id && entry.contains(key)) id = listedNumber(entry[key]);
    }
    for (const char* key : {"name", "label", "class_name", "category", "class"}) {
        const std::string name = textIn(entry, key);
        if (id && !name.empty()) names.try_emplace(*id, name);
    }
}

Names namesInJson(const json& document) {
    Names names;
    if (document.is_array()) {
        for (const json& entry : document) takeEntry(entry, names);
        return names;
    }
    if (!document.is_object()) return names;
    for (const char* key : {"objects", "classes", "labels"}) {
        for (const json& entry : listIn(document, key)) takeEntry(entry, names);
    }
    for (const auto& [key, value] : document.items()) {
        if (value.is_string()) {
            const auto id = listedNumber(std::string_view(key));
            if (id) names.try_emplace(*id, cleanText(value.get<std::string>()));
        } else if (const auto id = listedNumber(value)) {
            names.try_emplace(*id, cleanText(key));
        }
    }
    return names;
}

Names namesInLines(std::string_view text) {
    constexpr std::string_view kBetween = " \t,;:\"\r";
    Names names;
    for (const std::string_view line : splitLines(text)) {
        const auto begin = line.find_first_not_of(kBetween);
        if (begin == line.npos) continue;
        const auto end = line.find_first_of(kBetween, begin);
        if (end == line.npos) continue;
        const auto id = listedNumber(line.substr(begin, end - begin));
        const auto word = line.find_first_not_of(kBetween, end);
        if (!id || word == line.npos) continue;
        const auto last = line.find_last_not_of(kBetween);
        names.try_emplace(*id, cleanText(line.substr(word, last - word + 1)));
    }
    return names;
}

}  // namespace

std::optional<fs::path> findNameList(const fs::path& ply) {
    const std::string name = ply.stem().string();
    for (const char* ending : {".labels.json", "_labels.json", ".labels.csv", "_labels.csv",
                               ".labels.txt", "_labels.txt"}) {
        const fs::path file = ply.parent_path() / (name + ending);
        if (hasFile(file)) return file;
    }
    return std::nullopt;
}

Result<std::map<std::int64_t, std::string>> readNameList(const fs::path& file) {
    const Result<std::string> text = readNamedFile(file, kMostListBytes);
    if (!text) return tl::unexpected(text.error());
    Names names;
    if (file.extension() == ".json") {
        const Result<json> document = parseBoundedJson(*text, file.string());
        if (!document) return tl::unexpected(document.error());
        names = namesInJson(*document);
    } else {
        names = namesInLines(*text);
    }
    if (!names.empty()) return names;
    return fail(
        ErrorCode::BadInput,
        "it contains no numbers with names; write {\"3\": \"chair\"} as JSON, or lines \"3,chair\"",
        file.string());
}

}  // namespace dollytrack::semantics
