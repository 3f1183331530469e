#include "engine/io/datasets/bounded_json.h"

#include "engine/core/clean_text.h"
#include "engine/io/json_depth.h"
#include "engine/io/sandbox/input_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace dollytrack::io {
namespace {

constexpr std::uint64_t kMostJsonBytes = std::uint64_t{512} << 20U;
constexpr std::size_t kMostValues = 50'000'000;

/// Brackets and commas, which bound the number of values; those in texts are counted, too.
bool holdsTooMany(std::string_view text) {
    const auto separates = [](char c) { return c == ',' || c == '[' || c == '{'; };
    return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), separates)) >=
           kMostValues;
}

}  // namespace

Result<nlohmann::json> parseBoundedJson(std::string_view text, const std::string& where) {
    if (nestsTooDeep(text)) {
        return fail(ErrorCode::BadInput,
                    fmt::format("The file is nested more than {} deep; no scene is.", kDeepestJson),
                    where);
    }
    if (holdsTooMany(text)) {
        return fail(ErrorCode::BadInput,
                    fmt::format("The file holds more than {} values.", kMostValues), where);
    }
    try {
        return nlohmann::json::parse(text);
    } catch (const nlohmann::json::exception& error) {
        return fail(
            ErrorCode::BadInput,
            "The file is no JSON (" + cleanText(error.what()) + "); it is damaged or was cut off.",
            where);
    }
}

Result<nlohmann::json> readBoundedJson(const std::filesystem::path& path) {
    const Result<std::string> text = readNamedFile(path, kMostJsonBytes);
    if (!text) return tl::unexpected(text.error());
    return parseBoundedJson(*text, path.string());
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

}  // namespace dollytrack::io
