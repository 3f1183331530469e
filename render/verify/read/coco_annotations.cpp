#include "render/verify/read/coco_annotations.h"

#include "engine/io/files/bounded_json.h"

namespace dollytrack::verify {

Status forEachAnnotation(std::string_view text, const std::string& where,
                         const std::function<bool(const nlohmann::json&)>& take) {
    using nlohmann::json;
    constexpr int kInList = 2;  // nesting depth of an annotation
    std::string section;
    bool damaged = false;
    const auto keep = [&](int depth, json::parse_event_t event, json& value) {
        if (depth == 1 && event == json::parse_event_t::key) section = value.get<std::string>();
        if (depth != kInList || event != json::parse_event_t::object_end) return true;
        if (section != "annotations") return false;
        try {
            damaged = damaged || !take(value);
        } catch (const json::exception&) {
            damaged = true;
        }
        return false;
    };
    const Result<json> parsed = parseBoundedJson<json>(text, where, keep);
    if (!parsed) return tl::unexpected(parsed.error());
    if (!damaged) return {};
    return fail(
        ErrorCode::BadInput,
        "In an annotation a field is missing or wrong, or a class, object or image does not exist; "
        "export the dataset again.",
        where);
}

}  // namespace dollytrack::verify
