#include "engine/io/project_file.h"

#include "engine/io/durable_file.h"
#include "engine/io/json_depth.h"
#include "engine/io/sha256.h"
#include "engine/io/text_file.h"

#include <fmt/format.h>

#include <algorithm>

namespace dollytrack::io {
namespace {

constexpr std::size_t kMostMebibytes = 1024;

tl::unexpected<Error> badProject(const std::filesystem::path& path, std::string message) {
    return fail(ErrorCode::BadInput, std::move(message), path.string());
}

std::size_t lineOf(const std::string& text, std::size_t byte) {
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(byte, text.size()));
    return static_cast<std::size_t>(std::count(text.begin(), end, '\n')) + 1;
}

}  // namespace

Result<ProjectFile> loadProject(const std::filesystem::path& path) {
    const Result<std::string> text = readText(path, kMostMebibytes);
    if (!text) return tl::unexpected<Error>(text.error());
    if (nestsTooDeep(*text)) {
        return badProject(path, "The JSON is nested too deeply.");
    }
    nlohmann::json json;
    try {
        json = nlohmann::json::parse(*text);
    } catch (const nlohmann::json::parse_error& e) {
        return fail(ErrorCode::BadInput, "This is not valid JSON; restore a backup or plan again.",
                    fmt::format("{}:{}", path.string(), lineOf(*text, e.byte)));
    }
    if (!json.is_object() || !json.contains("dollytrack_project")) {
        return badProject(path, "This is JSON, but no Dollytrack project.");
    }
    try {
        const int version = json.at("dollytrack_project").get<int>();
        if (version > ProjectFile::kVersion) {
            return badProject(path, fmt::format("The project has version {}, this program knows up "
                                                "to {}; use a newer Dollytrack.",
                                                version, ProjectFile::kVersion));
        }
        ProjectFile project;
        const std::filesystem::path scene = json.at("scene").at("path").get<std::string>();
        project.scene = (std::filesystem::absolute(path).parent_path() / scene).lexically_normal();
        project.scene_sha256 = json.at("scene").value("sha256", "");
        project.import = json.at("scene").value("import", nlohmann::json::object());
        project.parameters = json.value("parameters", nlohmann::json::object());
        project.edits = json.value("edits", nlohmann::json::object());
        if (json.contains("result")) project.result = json["result"];
        for (const char* known : {"dollytrack_project", "scene", "parameters", "edits", "result"}) {
            json.erase(known);
        }
        project.others = std::move(json);
        project.file_sha256 = sha256Of(*text);
        return project;
    } catch (const nlohmann::json::exception& e) {
        return badProject(path, fmt::format("A field of the project is missing or of the wrong "
                                            "type ({}).",
                                            e.what()));
    }
}

std::string projectText(const ProjectFile& project, const std::filesystem::path& path) {
    nlohmann::json json = project.others.is_object() ? project.others : nlohmann::json::object();
    const std::filesystem::path folder = std::filesystem::absolute(path).parent_path();
    const std::filesystem::path scene = std::filesystem::absolute(project.scene);
    const std::filesystem::path relative = scene.lexically_relative(folder);
    // Without edits an older program reads the file just as well.
    json["dollytrack_project"] = project.edits.empty() ? 1 : ProjectFile::kVersion;
    json["scene"] = {{"path", (relative.empty() ? scene : relative).generic_string()},
                     {"sha256", project.scene_sha256}};
    if (!project.import.empty()) json["scene"]["import"] = project.import;
    json["parameters"] = project.parameters;
    if (!project.edits.empty()) json["edits"] = project.edits;
    if (!project.result.is_null()) json["result"] = project.result;
    return json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

Status saveProject(const ProjectFile& project, const std::filesystem::path& path) {
    return writeWhole(path, projectText(project, path));
}

}  // namespace dollytrack::io
