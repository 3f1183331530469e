#include "app/gather/sources/class_map.h"

#include "engine/core/clean_text.h"
#include "engine/io/files/bounded_json.h"
#include "engine/io/files/text_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace dollytrack::gather {
namespace {

Status addName(ClassMap& map, const std::string& from, const std::string& to,
               const std::string& where) {
    if (from.empty() || to.empty() || cleanText(from) != from || cleanText(to) != to) {
        return fail(ErrorCode::BadInput, "A class needs a name; write two names, 'from,to'.",
                    where);
    }
    if (!map.emplace(from, to).second) {
        return fail(ErrorCode::BadInput, fmt::format("'{}' is mapped twice; once is enough.", from),
                    where);
    }
    return {};
}

Result<ClassMap> fromJson(const std::string& text, const std::string& where) {
    const Result<nlohmann::json> json = parseBoundedJson(text, where);
    if (!json) return tl::unexpected(json.error());
    ClassMap map;
    for (const auto& [from, to] : json->items()) {
        if (!to.is_string()) {
            return fail(ErrorCode::BadInput, "The name of a class must be text in quotes.",
                        fmt::format("{}: {}", where, from));
        }
        if (Status added = addName(map, from, to.get<std::string>(), where); !added) {
            return tl::unexpected(added.error());
        }
    }
    return map;
}

Result<ClassMap> fromLines(std::string_view text, const std::string& where) {
    ClassMap map;
    for (int line = 1; !text.empty(); ++line) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string_view whole = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        const std::string_view row = trimmed(whole.substr(0, whole.find('#')));
        if (row.empty()) continue;
        const std::string place = fmt::format("{}:{}", where, line);
        const std::size_t comma = row.find(',');
        if (comma == std::string_view::npos || row.find(',', comma + 1) != std::string_view::npos) {
            return fail(ErrorCode::BadInput, "The line is not 'name,name'.", place);
        }
        Status added = addName(map, std::string(trimmed(row.substr(0, comma))),
                               std::string(trimmed(row.substr(comma + 1))), place);
        if (!added) return tl::unexpected(added.error());
    }
    return map;
}

}  // namespace

Result<ClassMap> readClassMap(const std::filesystem::path& path) {
    const Result<std::string> text = readText(path, 16);
    if (!text) return tl::unexpected(text.error());
    const bool is_json = trimmed(*text).starts_with('{');
    Result<ClassMap> map =
        is_json ? fromJson(*text, path.string()) : fromLines(*text, path.string());
    if (map && map->empty()) {
        return fail(ErrorCode::BadInput, "The class map has no names in it.", path.string());
    }
    return map;
}

}  // namespace dollytrack::gather
