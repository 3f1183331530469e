#include "engine/io/settings/project_file.h"

#include "engine/document/json_reader.h"
#include "engine/io/files/bounded_json.h"
#include "engine/io/files/durable_file.h"
#include "engine/io/files/sha256.h"
#include "engine/io/files/text_file.h"
#include "engine/io/settings/stored_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

namespace dollytrack {
namespace {

tl::unexpected<Error> badProject(const std::filesystem::path& path, std::string message,
                                 const std::string& field = {}) {
    return fail(ErrorCode::BadInput, std::move(message),
                path.string() + (field.empty() ? "" : ": " + field));
}

/// A member that must be an object; empty if it is absent.
nlohmann::json objectAt(const JsonReader& from, const char* key) {
    const JsonReader member = from.at(key);
    if (member.absent()) return nlohmann::json::object();
    if (!member.json().is_object()) member.refuse("This must be an object.");
    return member.json();
}

/// The folder of a file, without links and "..", which lexically_relative() would take for names.
std::filesystem::path folderOf(const std::filesystem::path& file) {
    const std::filesystem::path folder = std::filesystem::absolute(file).parent_path();
    std::error_code error;
    const std::filesystem::path real = std::filesystem::weakly_canonical(folder, error);
    return error ? folder.lexically_normal() : real;
}

bool climbs(const std::filesystem::path& path) {
    return std::ranges::find(path, "..") != path.end();
}

/// The path of a scene as its project stores it: as it was given if it lies below the project's
/// folder, so that a folder with links can be moved; else from folder to folder without links.
std::filesystem::path storedPath(const std::filesystem::path& scene,
                                 const std::filesystem::path& project) {
    const std::filesystem::path file = std::filesystem::absolute(scene);
    const std::filesystem::path folder = std::filesystem::absolute(project).parent_path();
    if (!climbs(file) && !climbs(folder)) {
        const std::filesystem::path below = file.lexically_relative(folder);
        if (!below.empty() && !climbs(below)) return below;
    }
    const std::filesystem::path real = folderOf(scene) / scene.filename();
    const std::filesystem::path relative = real.lexically_relative(folderOf(project));
    return relative.empty() ? real : relative;
}

/// The scene of a project by its stored path. Projects written by version 0.1.0 may count from the
/// folder as it was given, with links.
std::filesystem::path sceneAt(const std::filesystem::path& stored,
                              const std::filesystem::path& project) {
    const std::filesystem::path scene = (folderOf(project) / stored).lexically_normal();
    std::error_code error;
    if (std::filesystem::exists(scene, error)) return scene;
    const std::filesystem::path folder = std::filesystem::absolute(project).parent_path();
    const std::filesystem::path other = (folder / stored).lexically_normal();
    return std::filesystem::exists(other, error) ? other : scene;
}

/// Reads all fields; the result's structure is checked by checkStoredPlan().
void readFields(const JsonReader& from, const std::filesystem::path& path, ProjectFile& project) {
    const JsonReader scene = from.at("scene");
    project.scene = sceneAt(scene.at("path").text(), path);
    if (const JsonReader sum = scene.at("sha256"); !sum.absent()) {
        project.scene_sha256 = sum.text();
    }
    project.import = objectAt(scene, "import");
    project.parameters = objectAt(from, "parameters");
    project.edits = objectAt(from, "edits");
    project.result = from.at("result").json();
}

/// Checks that a plan can be read again once it is written, where numbers that are not finite
/// become null.
Status checkWrittenPlan(const nlohmann::json& result) {
    const std::string text = result.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    const Result<nlohmann::json> read = parseBoundedJson(text, "result");
    const Status readable =
        read ? checkStoredPlan(*read, "result") : Status(tl::unexpected(read.error()));
    if (readable) return {};
    return fail(ErrorCode::CannotWrite,
                "the plan contains a value that a project cannot store, so it was not saved; check "
                "the scene's unit and its farthest objects: " +
                    readable.error().message,
                readable.error().where);
}

}  // namespace

Result<ProjectFile> loadProject(const std::filesystem::path& path) {
    const Result<std::string> text = readText(path);
    if (!text) return tl::unexpected(text.error());
    Result<nlohmann::json> json = parseBoundedJson(*text, path.string());
    if (!json) return tl::unexpected(std::move(json.error()));
    if (!json->is_object() || !json->contains("dollytrack_project")) {
        return badProject(path, "This is JSON, but not a Dollytrack project.");
    }
    ProjectFile project;
    Status status;
    const JsonReader from(*json, "", status);
    const int version = from.at("dollytrack_project").integer(1, 1'000'000);
    if (from.good() && version > ProjectFile::kVersion) {
        return badProject(path,
                          fmt::format("The project has format version {}, but this program reads "
                                      "versions up to {}; use a newer version of Dollytrack.",
                                      version, ProjectFile::kVersion));
    }
    readFields(from, path, project);
    if (status) status = checkStoredPlan(project.result, "result");
    if (!status) return badProject(path, status.error().message, status.error().where);
    for (const char* known : {"dollytrack_project", "scene", "parameters", "edits", "result"}) {
        json->erase(known);
    }
    project.others = std::move(*json);
    project.file_sha256 = sha256Of(*text);
    return project;
}

Result<std::string> projectText(const ProjectFile& project, const std::filesystem::path& path) {
    if (Status readable = checkWrittenPlan(project.result); !readable) {
        return tl::unexpected(readable.error());
    }
    nlohmann::json json = project.others.is_object() ? project.others : nlohmann::json::object();
    // Older programs can read files without edits, so write the older version for these.
    json["dollytrack_project"] = project.edits.empty() ? 1 : ProjectFile::kVersion;
    json["scene"] = {{"path", storedPath(project.scene, path).generic_string()},
                     {"sha256", project.scene_sha256}};
    if (!project.import.empty()) json["scene"]["import"] = project.import;
    json["parameters"] = project.parameters;
    if (!project.edits.empty()) json["edits"] = project.edits;
    if (!project.result.is_null()) json["result"] = project.result;
    return json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

Status saveProject(const ProjectFile& project, const std::filesystem::path& path) {
    const Result<std::string> text = projectText(project, path);
    if (!text) return tl::unexpected(text.error());
    return writeWhole(path, *text);
}

}  // namespace dollytrack
