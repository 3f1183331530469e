#include "engine/io/settings/annotation_file.h"

#include "engine/core/clean_text.h"
#include "engine/core/field_list.h"
#include "engine/document/json_reader.h"
#include "engine/document/unknown_keys.h"
#include "engine/io/files/bounded_json.h"
#include "engine/io/files/durable_file.h"
#include "engine/scene/labels.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace dollytrack {
namespace {

using nlohmann::json;

constexpr const char* kAnnotationFormat = "dollytrack-objects";
constexpr int kVersion = 1;
constexpr int kMostMeshTriangles = 1'000'000'000;

std::vector<std::string> readNames(const JsonReader& from) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < from.size() && from.good(); ++i) {
        names.push_back(cleanText(from.at(i).text()));
    }
    return names;
}

bool readFlag(const JsonReader& from) {
    if (from.absent()) return false;
    if (!from.json().is_boolean()) from.refuse("This must be true or false.");
    return from.good() && from.json().get<bool>();
}

AnnotatedObject readObject(const JsonReader& from) {
    AnnotatedObject object;
    object.name = cleanText(from.at("name").text());
    object.nodes = readNames(from.at("nodes"));
    object.meshes = readNames(from.at("meshes"));
    const JsonReader ranges = from.at("triangles");
    for (std::size_t i = 0; i < ranges.size() && from.good(); ++i) {
        AnnotatedTriangles& range = object.triangles.emplace_back();
        range.mesh = cleanText(ranges.at(i).at("mesh").text());
        range.first =
            static_cast<std::size_t>(ranges.at(i).at("first").integer(0, kMostMeshTriangles));
        range.count =
            static_cast<std::size_t>(ranges.at(i).at("count").integer(1, kMostMeshTriangles));
    }
    if (object.nodes.empty() && object.meshes.empty() && object.triangles.empty()) {
        from.refuse("Give the parts of the object: nodes, meshes or triangles.");
    }
    if (const JsonReader category = from.at("class"); !category.absent()) {
        object.category = cleanText(category.text());
    }
    if (const JsonReader nyu40 = from.at("nyu40"); !nyu40.absent()) {
        object.nyu40 = nyu40.integer(0, kNyu40Count);
    }
    object.structure = readFlag(from.at("structure"));
    if (const JsonReader front = from.at("front"); !front.absent()) {
        object.front = front.point();
        if (object.front->norm() < 1e-9) front.refuse("A front must not be [0, 0, 0].");
    }
    return object;
}

/// Warns of unknown keys that resemble known ones. Other unknown keys are accepted, because other
/// programs may use them.
void doubtKeys(const json& entry, const std::vector<std::string>& known, const std::string& of,
               std::vector<std::string>& doubts) {
    if (!entry.is_object()) return;
    for (const auto& [key, value] : entry.items()) {
        if (std::ranges::find(known, key) != known.end()) continue;
        const std::string close = closestName(key, known);
        if (close.empty()) continue;
        doubts.push_back("annotations: unknown key \"" + cleanText(key) + "\"" + of +
                         "; did you mean \"" + close + "\"?");
    }
}

AnnotatedRelation readRelation(const JsonReader& from) {
    AnnotatedRelation relation{cleanText(from.at("object").text()), from.at("relation").text(),
                               cleanText(from.at("holder").text())};
    if (relation.relation != "on" && relation.relation != "in" && relation.relation != "hangs_on") {
        from.at("relation").refuse("This must be on, in or hangs_on.");
    }
    return relation;
}

void readAll(const JsonReader& from, Annotations& into) {
    doubtKeys(from.json(),
              {"format", "version", "unit_m", "up_axis", "objects", "relations", "edits"}, "",
              into.doubts);
    if (from.at("format").absent() || from.at("format").text() != kAnnotationFormat) {
        from.at("format").refuse("This must be \"dollytrack-objects\".");
    }
    if (from.at("version").integer(1, 1'000'000) > kVersion && from.good()) {
        from.at("version").refuse(
            "The file was made by a newer version of Dollytrack; use that version.");
    }
    if (const JsonReader unit = from.at("unit_m"); !unit.absent()) {
        into.unit_m = unit.number(1e-9, 1e6 - 1.0);
    }
    if (const JsonReader up = from.at("up_axis"); !up.absent()) {
        into.up_axis = parseUpAxis(up.text());
        if (!into.up_axis) up.refuse(fmt::format("This must be {}.", kUpAxes));
    }
    const JsonReader objects = from.at("objects");
    std::set<std::string> names;
    for (std::size_t i = 0; i < objects.size() && from.good(); ++i) {
        into.objects.push_back(readObject(objects.at(i)));
        if (!from.good()) break;
        doubtKeys(objects.at(i).json(),
                  {"name", "nodes", "meshes", "triangles", "class", "nyu40", "structure", "front"},
                  " of \"" + into.objects.back().name + "\"", into.doubts);
        if (!names.insert(into.objects.back().name).second) {
            objects.at(i).at("name").refuse("Another object has the same name.");
        }
    }
    const JsonReader relations = from.at("relations");
    for (std::size_t i = 0; i < relations.size() && from.good(); ++i) {
        into.relations.push_back(readRelation(relations.at(i)));
    }
    into.edits = from.at("edits").json();
}

}  // namespace

std::filesystem::path annotationFileOf(const std::filesystem::path& scene) {
    std::filesystem::path file = scene;
    file += ".objects.json";
    return file;
}

Result<Annotations> readAnnotations(const std::filesystem::path& file) {
    Result<json> content = readBoundedJson(file);
    if (!content) return tl::unexpected(std::move(content.error()));
    Annotations read;
    Status status;
    const JsonReader from(*content, "", status);
    if (content->is_object()) {
        readAll(from, read);
    } else {
        from.refuse("Annotations are an object: {\"format\": \"dollytrack-objects\", ...}.");
    }
    if (!status) {
        const std::string& place = status.error().where;
        return fail(ErrorCode::BadInput, status.error().message,
                    file.string() + (place.empty() ? "" : ": " + place));
    }
    read.file = file;
    read.content = std::move(*content);
    return read;
}

Result<Annotations> findAnnotations(const std::filesystem::path& scene,
                                    const std::optional<std::filesystem::path>& given) {
    std::error_code error;
    if (given && !std::filesystem::is_directory(*given, error)) return readAnnotations(*given);
    const std::filesystem::path beside = annotationFileOf(scene);
    if (!std::filesystem::exists(beside, error)) return Annotations{};
    return readAnnotations(beside);
}

std::string annotationText(const json& earlier, const json& import, const json& edits) {
    json content = earlier.is_object() ? earlier : json::object();
    content["format"] = kAnnotationFormat;
    content["version"] = kVersion;
    for (const char* key : {"unit_m", "up_axis"}) {
        if (import.contains(key)) content[key] = import[key];
    }
    json& section = content["edits"];
    if (!section.is_object()) section = json::object();
    for (const char* key : {"start", "end"}) section.erase(key);  // absent if not set
    const json before = section;
    section.update(edits);
    keepUnknownKeys(before, section);
    return content.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

Status writeAnnotations(const std::filesystem::path& file, const json& import, const json& edits) {
    json earlier = json::object();
    std::error_code error;
    if (std::filesystem::exists(file, error)) {
        Result<Annotations> read = readAnnotations(file);
        if (!read) return tl::unexpected(std::move(read.error()));
        earlier = std::move(read->content);
    }
    return writeWhole(file, annotationText(earlier, import, edits));
}

}  // namespace dollytrack
