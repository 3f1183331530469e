#include "render/verify/read/json_file.h"

#include "engine/io/files/bounded_json.h"

namespace dollytrack::verify {

Result<nlohmann::json> readJson(const std::filesystem::path& path) {
    Result<nlohmann::json> json = readBoundedJson(path);
    if (!json) return fail(json.error().code, json.error().message);
    return json;
}

Result<nlohmann::json> parseJson(std::string_view text) {
    Result<nlohmann::json> json = parseBoundedJson(text, "");
    if (!json) return fail(json.error().code, json.error().message);
    return json;
}

}  // namespace dollytrack::verify
