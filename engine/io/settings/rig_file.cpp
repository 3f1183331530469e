#include "engine/io/settings/rig_file.h"

#include "engine/core/clean_text.h"
#include "engine/core/name_hint.h"
#include "engine/document/json_reader.h"
#include "engine/io/files/bounded_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace dollytrack {
namespace {

using nlohmann::json;

constexpr const char* kRigFormat = "dollytrack-rig";

Result<Lens> lensOf(std::string_view name) {
    RigCamera camera;
    const Status status =
        setField(listRigCameraFields(camera), fmt::format("lens={}", cleanText(std::string(name))));
    if (!status) return tl::unexpected(status.error());
    return camera.lens;
}

std::string uselessKey(Lens lens, std::string_view key) {
    return fmt::format("'{}' does not apply to a camera with the lens {}; remove it.", key,
                       lensName(lens));
}

template <class Names>
std::string unknownKey(const std::string& key, const Names& names) {
    return fmt::format("There is no key '{}'{}", cleanText(key),
                       nameHint(key, {names.begin(), names.end()}));
}

/// Reads a field from JSON. Returns an error message; empty if it is valid.
std::string setOne(RigCamera& camera, const std::string& key, const json& value) {
    const Status status = setFromJson(listRigCameraFields(camera), {{"camera", {{key, value}}}});
    return status ? std::string() : status.error().message;
}

RigCamera readCamera(const JsonReader& from) {
    if (!from.json().is_object()) {
        from.refuse("A camera is an object: {\"name\": ..., \"lens\": ...}.");
        return {};
    }
    Lens lens = Lens::Pinhole;
    if (const JsonReader given = from.at("lens"); !given.absent()) {
        const Result<Lens> known = lensOf(given.text());
        if (!known) {
            given.refuse(known.error().message);
            return {};
        }
        lens = *known;
    }
    RigCamera camera = standardCamera(lens);
    camera.name = from.at("name").text();
    std::vector<std::string> names = {"name"};
    for (const Field& field : listRigCameraFields(camera)) names.push_back(field.name);
    for (const auto& [key, value] : from.json().items()) {
        if (!from.good()) break;
        if (key == "name" || key == "lens") continue;
        if (std::find(names.begin(), names.end(), key) == names.end()) {
            from.refuse(unknownKey(key, names));
        } else if (!usesField(lens, key)) {
            from.at(key).refuse(uselessKey(lens, key));
        } else if (const std::string wrong = setOne(camera, key, value); !wrong.empty()) {
            from.at(key).refuse(wrong);
        }
    }
    return camera;
}

void readAll(const JsonReader& from, Rig& rig) {
    if (!from.json().is_object()) {
        return from.refuse(
            "A rig is an object: {\"format\": \"dollytrack-rig\", \"version\": 1, "
            "\"cameras\": [...]}.");
    }
    if (from.at("format").absent() || from.at("format").text() != kRigFormat) {
        from.at("format").refuse("This must be \"dollytrack-rig\".");
    }
    if (from.at("version").integer(1, 1'000'000) > 1 && from.good()) {
        from.at("version").refuse(
            "The file was made by a newer version of Dollytrack; use that version.");
    }
    constexpr std::array<const char*, 4> kKeys = {"format", "version", "cameras", "$schema"};
    for (const auto& [key, value] : from.json().items()) {
        if (std::find(kKeys.begin(), kKeys.end(), key) == kKeys.end()) {
            from.refuse(unknownKey(key, kKeys));
        }
    }
    const JsonReader cameras = from.at("cameras");
    if (from.good() && (!cameras.json().is_array() || cameras.json().empty())) {
        cameras.refuse("A rig needs a list of at least one camera.");
    }
    for (std::size_t i = 0; i < cameras.size() && from.good(); ++i) {
        rig.push_back(readCamera(cameras.at(i)));
        if (!from.good()) return;
        if (const Status status = validate(rig); !status) {
            cameras.at(i).refuse(status.error().message);
        }
    }
}

}  // namespace

Result<Rig> readRig(const std::filesystem::path& file) {
    const Result<json> content = readBoundedJson(file);
    if (!content) return tl::unexpected(content.error());
    Rig rig;
    Status status;
    readAll(JsonReader(*content, "", status), rig);
    if (!status) {
        const std::string& place = status.error().where;
        return fail(ErrorCode::BadInput, status.error().message,
                    file.string() + (place.empty() ? "" : ": " + place));
    }
    return rig;
}

Result<RigCamera> parseRigCamera(std::string_view text) {
    const std::size_t colon = text.find(':');
    const std::string_view name = text.substr(0, colon);
    const std::string where = fmt::format("--camera {}", cleanText(std::string(text)));
    std::vector<std::string> assignments;
    Lens lens = Lens::Pinhole;
    std::string_view rest = colon == std::string_view::npos ? "" : text.substr(colon + 1);
    while (!rest.empty()) {
        const std::size_t comma = std::min(rest.find(','), rest.size());
        const std::string_view one = rest.substr(0, comma);
        rest.remove_prefix(std::min(comma + 1, rest.size()));
        if (!one.starts_with("lens=")) {
            assignments.emplace_back(one);
            continue;
        }
        const Result<Lens> known = lensOf(one.substr(5));
        if (!known) return fail(ErrorCode::Usage, known.error().message, where);
        lens = *known;
    }
    RigCamera camera = standardCamera(lens);
    camera.name = name;
    for (const std::string& assignment : assignments) {
        const std::string key = assignment.substr(0, assignment.find('='));
        if (!usesField(lens, key)) return fail(ErrorCode::Usage, uselessKey(lens, key), where);
        const Status status = setField(listRigCameraFields(camera), assignment);
        if (!status) return fail(ErrorCode::Usage, status.error().message, where);
    }
    if (const Status status = validate(Rig{camera}); !status) {
        return fail(ErrorCode::Usage, status.error().message, where);
    }
    return camera;
}

}  // namespace dollytrack
