#include "engine/io/files/bounded_json.h"

#include "engine/core/clean_text.h"
#include "engine/io/files/guarded_folder.h"
#include "engine/io/files/text_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

namespace dollytrack {
namespace {

constexpr std::uint64_t kMostMemory = std::uint64_t{2} << 30U;  // bytes of parsed values

/// The position of the quote that closes the string which begins at `quote`; the text's size if
/// none does.
std::size_t stringEnd(std::string_view text, std::size_t quote) {
    std::size_t i = quote + 1;
    while (i < text.size() && text[i] != '"') i += text[i] == '\\' ? 2 : 1;
    return std::min(i, text.size());
}

/// Nesting depth of a text's brackets, the most fields of one of its objects, and a lower bound of
/// the memory of its parsed values with Debian 12's libraries: even a small file of "[],[],..."
/// would need much memory.
struct JsonSize {
    int depth = 0;  // up to kDeepestJson + 1
    int fields = 0;
    std::uint64_t memory = 0;
};

JsonSize sizeOf(std::string_view text) {
    constexpr std::uint64_t kValue = 16;  // bytes in the containing list
    constexpr std::uint64_t kList = 32;   // a list; an object is slightly larger
    constexpr std::uint64_t kKey = 96;    // a tree node of an object
    JsonSize size;
    std::vector<int> fields;  // of each open list or object
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (c == '"') {
            i = stringEnd(text, i);
        } else if (c == '[' || c == '{') {
            size.memory += kList + kValue;
            fields.push_back(0);
            size.depth = std::max(size.depth, static_cast<int>(fields.size()));
            if (size.depth > kDeepestJson) return size;  // refused whatever follows
        } else if ((c == ']' || c == '}') && !fields.empty()) {
            fields.pop_back();
        } else if (c == ',') {
            size.memory += kValue;
        } else if (c == ':') {
            size.memory += kKey;
            if (!fields.empty()) size.fields = std::max(size.fields, ++fields.back());
        }
    }
    return size;
}

/// The position of the bracket that closes the object which begins at `begin`; the text's size if
/// none does.
std::size_t objectEnd(std::string_view text, std::size_t begin) {
    int depth = 0;
    for (std::size_t i = begin; i < text.size(); ++i) {
        const char c = text[i];
        if (c == '"') {
            i = stringEnd(text, i);
        } else if (c == '[' || c == '{') {
            ++depth;
        } else if ((c == ']' || c == '}') && --depth == 0) {
            return i;
        }
    }
    return text.size();
}

/// Line and column of a byte, as ":3:14"; `byte` counts from 1.
std::string placeIn(std::string_view text, std::size_t byte) {
    const std::string_view before = text.substr(0, std::min(byte > 0 ? byte - 1 : 0, text.size()));
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    const std::size_t begins = before.rfind('\n');  // npos + 1 is 0
    return fmt::format(":{}:{}", line, before.size() - (begins + 1) + 1);
}

/// Empties the object in this field of the text of a JSON object; lines and columns stay. Returns
/// the object's text; empty if there is none.
std::string takeField(std::string& text, std::string_view name) {
    std::string taken;
    int depth = 0;
    bool is_key = false;  // the last string, at depth 1, is the name
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (c == '"') {
            const std::size_t begin = i + 1;
            i = stringEnd(text, i);
            is_key = depth == 1 && std::string_view(text).substr(begin, i - begin) == name;
        } else if (c == '{' && depth == 1 && is_key) {
            const std::size_t end = objectEnd(text, i);
            taken = text.substr(i, end + 1 - i);
            std::replace_if(
                text.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                text.begin() + static_cast<std::ptrdiff_t>(end), [](char x) { return x != '\n'; },
                ' ');
            i = end;
        } else if (c == '[' || c == '{') {
            ++depth;
        } else if (c == ']' || c == '}') {
            --depth;
        } else if (c == ',') {
            is_key = false;
        }
    }
    return taken;
}

}  // namespace

JsonFilter<nlohmann::json> onlyField(std::string name) {
    using nlohmann::json;
    return [name = std::move(name)](int depth, json::parse_event_t event, json& parsed) {
        return depth != 1 || event != json::parse_event_t::key || parsed == name;
    };
}

template <class Json>
Result<Json> parseBoundedJson(std::string_view text, const std::string& where,
                              const JsonFilter<Json>& keep) {
    const JsonSize size = sizeOf(text);
    if (size.depth > kDeepestJson) {
        return fail(
            ErrorCode::BadInput,
            fmt::format(
                "The JSON is nested more than {} levels deep, deeper than any supported file.",
                kDeepestJson),
            where);
    }
    if (size.memory > kMostMemory) {
        return fail(
            ErrorCode::BadInput,
            fmt::format("The JSON has too many values: they would need more than {} GiB of memory.",
                        kMostMemory >> 30U),
            where);
    }
    if (std::is_same_v<Json, nlohmann::ordered_json> && size.fields > kMostOrderedFields) {
        return fail(ErrorCode::BadInput,
                    fmt::format("An object of the JSON has {} fields, more than the {} of any "
                                "supported file.",
                                size.fields, kMostOrderedFields),
                    where);
    }
    try {
        return Json::parse(text, keep);
    } catch (const nlohmann::json::parse_error& error) {
        return fail(ErrorCode::BadInput,
                    "This is not valid JSON; the file is damaged or truncated.",
                    where + placeIn(text, error.byte));
    } catch (const nlohmann::json::exception&) {
        return fail(ErrorCode::BadInput, "This JSON file contains a number that is too large.",
                    where);
    }
}

template <class Json>
Result<Json> readBoundedJson(const std::filesystem::path& path, const JsonFilter<Json>& keep) {
    const Result<std::string> text = readText(path);
    if (!text) return tl::unexpected(text.error());
    return parseBoundedJson<Json>(*text, path.string(), keep);
}

template <class Json>
Result<Json> readBoundedJson(const GuardedFolder& folder, const std::string& name,
                             const JsonFilter<Json>& keep) {
    const Result<InputFile> file = folder.openInput(name);
    if (!file) return tl::unexpected(file.error());
    const Result<std::string> text = file->readAll(kMostTextBytes);
    if (!text) return tl::unexpected(text.error());
    return parseBoundedJson<Json>(*text, (folder.path() / name).string(), keep);
}

template Result<nlohmann::json> readBoundedJson(const GuardedFolder&, const std::string&,
                                                const JsonFilter<nlohmann::json>&);
template Result<nlohmann::ordered_json> readBoundedJson(const GuardedFolder&, const std::string&,
                                                        const JsonFilter<nlohmann::ordered_json>&);
template Result<nlohmann::json> readBoundedJson(const std::filesystem::path&,
                                                const JsonFilter<nlohmann::json>&);
template Result<nlohmann::json> parseBoundedJson(std::string_view, const std::string&,
                                                 const JsonFilter<nlohmann::json>&);
template Result<nlohmann::ordered_json> readBoundedJson(const std::filesystem::path&,
                                                        const JsonFilter<nlohmann::ordered_json>&);
template Result<nlohmann::ordered_json> parseBoundedJson(std::string_view, const std::string&,
                                                         const JsonFilter<nlohmann::ordered_json>&);

Result<SplitJson> parseSplitJson(std::string_view text, const std::string& where,
                                 std::string_view name) {
    std::string rest_text(text);
    const std::string part_text = takeField(rest_text, name);
    auto rest = parseBoundedJson<nlohmann::ordered_json>(rest_text, where);
    if (!rest) return tl::unexpected(rest.error());
    if (auto part = parseBoundedJson(part_text, where)) {
        return SplitJson{std::move(*rest), {{name, std::move(*part)}}};
    }
    // The field is no object, or damaged; its place in the whole text is wanted.
    auto part = parseBoundedJson(text, where, onlyField(std::string(name)));
    if (!part) return tl::unexpected(part.error());
    return SplitJson{std::move(*rest), std::move(*part)};
}

std::string plainReason(const std::exception& error) {
    std::string reason = error.what();
    const std::size_t end = reason.find("] ");
    if (reason.starts_with("[json.") && end != std::string::npos) reason.erase(0, end + 2);
    return reason;
}

std::optional<double> numberIn(const nlohmann::json& value) {
    double number = 0.0;
    if (value.is_number()) {
        number = value.get<double>();
    } else if (value.is_string()) {
        const auto& text = value.get_ref<const std::string&>();
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
        if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    } else {
        return std::nullopt;
    }
    if (!std::isfinite(number)) return std::nullopt;
    return number;
}

const nlohmann::json::array_t& listIn(const nlohmann::json& object, const char* key) {
    static const nlohmann::json::array_t nothing;
    if (!object.is_object()) return nothing;
    const auto found = object.find(key);
    return found != object.end() && found->is_array()
               ? found->get_ref<const nlohmann::json::array_t&>()
               : nothing;
}

std::string textIn(const nlohmann::json& object, const char* key) {
    if (!object.is_object()) return {};
    const auto found = object.find(key);
    return found != object.end() && found->is_string()
               ? cleanText(found->get_ref<const std::string&>())
               : std::string();
}

}  // namespace dollytrack
