#include "render/verify/json_file.h"

#include "engine/io/json_depth.h"
#include "engine/io/text_file.h"

namespace dollytrack::verify {

Result<nlohmann::json> readJson(const std::filesystem::path& path) {
    const Result<std::string> text = io::readText(path);
    if (!text) return fail(text.error().code, text.error().message);
    return parseJson(*text);
}

Result<nlohmann::json> parseJson(std::string_view text) {
    if (io::nestsTooDeep(text)) return fail(ErrorCode::BadInput, "JSON that is nested too deep");
    try {
        return nlohmann::json::parse(text);
    } catch (const nlohmann::json::exception& error) {
        return fail(ErrorCode::BadInput, error.what());
    }
}

}  // namespace dollytrack::verify
