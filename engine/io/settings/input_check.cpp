#include "engine/io/settings/input_check.h"

#include "engine/io/datasets/hypersim_annotations.h"
#include "engine/io/import/scene_format.h"
#include "engine/io/sandbox/input_file.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace dollytrack {
namespace {

using Path = std::filesystem::path;

constexpr std::size_t kHeadBytes = 4096;

/// ".obj, .fbx and .stl".
std::string listOfExtensions() {
    const std::vector<std::string> all = sceneExtensions();
    std::string list;
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (i > 0) list += i + 1 < all.size() ? ", " : " and ";
        list += all[i];
    }
    return list;
}

bool has(const SceneFormat& format, const std::string& extension) {
    return std::find(format.extensions.begin(), format.extensions.end(), extension) !=
           format.extensions.end();
}

Status checkExtension(const Path& path, const std::string& where) {
    struct Program {
        std::string_view extension;
        std::string_view name;
    };
    static constexpr std::array<Program, 8> kPrograms = {{{".c4d", "Cinema 4D"},
                                                          {".blend", "Blender"},
                                                          {".max", "3ds Max"},
                                                          {".skp", "SketchUp"},
                                                          {".ma", "Maya"},
                                                          {".mb", "Maya"},
                                                          {".3dm", "Rhino"},
                                                          {".hip", "Houdini"}}};
    const std::string ext = lowerExtension(path);
    if (ext == ".e57" || ext == ".las" || ext == ".laz") {
        return fail(ErrorCode::BadInput,
                    "this kind of point cloud cannot be read; convert it to PLY with \"pdal "
                    "translate in" +
                        ext + " out.ply\", or open and save it with CloudCompare",
                    where);
    }
    if (ext == ".world" || ext == ".sdf") {
        return fail(ErrorCode::BadInput,
                    "worlds of Gazebo cannot be read; name the mesh that its models are made of "
                    "(.dae, .obj, .stl), or put them together in Blender and export glTF",
                    where);
    }
    const std::vector<std::string> known = sceneExtensions();
    if (std::find(known.begin(), known.end(), ext) != known.end()) return {};
    static constexpr std::array<std::string_view, 9> kBlenderReads = {
        ".usd", ".usda", ".usdc", ".usdz", ".3ds", ".x3d", ".wrl", ".abc", ".dxf"};
    if (std::ranges::find(kBlenderReads, ext) != kBlenderReads.end()) {
        return fail(ErrorCode::BadInput,
                    "\"" + ext + "\" files cannot be read; open it in Blender and export glTF",
                    where);
    }
    for (const Program& program : kPrograms) {
        if (ext != program.extension) continue;
        return fail(ErrorCode::BadInput,
                    std::string(program.name) + " files cannot be read; export FBX or glTF from " +
                        std::string(program.name),
                    where);
    }
    return fail(ErrorCode::BadInput,
                (ext.empty() ? std::string("the file has no extension")
                             : "\"" + ext + "\" files cannot be read") +
                    "; scenes are " + listOfExtensions() +
                    " files, and the name of a project ends in .dolly",
                where);
}

Result<const SceneFormat*> formatOf(const Path& path, const std::string& where) {
    const Result<io::InputFile> file = io::openNamedFile(path);
    if (!file) {
        return fail(ErrorCode::BadInput, "the file cannot be read; check its permissions", where);
    }
    std::array<char, kHeadBytes> buffer{};
    const std::string_view head(buffer.data(), file->read(0, buffer.data(), buffer.size()));
    if (head.starts_with("version https://git-lfs")) {
        return fail(ErrorCode::BadInput,
                    "this is a Git-LFS pointer, not the model; run \"git lfs pull\" first", where);
    }
    const std::string extension = lowerExtension(path);
    if (extension == ".xml" && head.find("<scene") != std::string_view::npos) {
        return fail(ErrorCode::BadInput,
                    "scenes of Mitsuba cannot be read; name the OBJ or PLY file that it is made "
                    "of, or put them together in Blender and export glTF",
                    where);
    }
    std::string kinds;
    for (const SceneFormat& format : sceneFormats()) {
        if (!has(format, extension)) continue;
        if (format.begins_like(head)) return &format;
        kinds += (kinds.empty() ? "" : " or ") + std::string(format.name);
    }
    return fail(
        ErrorCode::BadInput,
        "the file does not begin like " + kinds + "; it is damaged or has the wrong extension",
        where);
}

}  // namespace

Result<const SceneFormat*> checkSceneFile(const Path& path) {
    const std::string where = path.string();
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(path, error);
    if (status.type() == std::filesystem::file_type::not_found) {
        return fail(ErrorCode::BadInput, "there is no such file; check the path", where);
    }
    if (error) {
        return fail(ErrorCode::BadInput, "the file cannot be reached (" + error.message() + ")",
                    where);
    }
    if (std::filesystem::is_directory(status)) {
        const std::string hypersim = io::describeHypersimFolder(path);
        if (!hypersim.empty()) return fail(ErrorCode::Usage, hypersim, where);
        return fail(ErrorCode::BadInput,
                    "this is a folder; name the scene file inside it (" + listOfExtensions() + ")",
                    where);
    }
    if (!std::filesystem::is_regular_file(status)) {
        return fail(ErrorCode::BadInput, "this is not an ordinary file", where);
    }
    if (Status known = checkExtension(path, where); !known) {
        return tl::unexpected(known.error());
    }
    const auto size = std::filesystem::file_size(path, error);
    if (!error && size == 0) {
        return fail(ErrorCode::BadInput, "the file is empty; export or download it again", where);
    }
    return formatOf(path, where);
}

}  // namespace dollytrack
