#include "engine/io/input_check.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <string>
#include <string_view>

namespace dollytrack {
namespace {

using Path = std::filesystem::path;

std::string lowerExtension(const Path& path) {
    std::string ext = path.extension().string();
    for (char& c : ext) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return ext;
}

Status checkExtension(const Path& path, const std::string& where) {
    static constexpr std::array<std::string_view, 7> kKnown = {".obj", ".fbx", ".gltf", ".glb",
                                                               ".dae", ".ply", ".stl"};
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
    if (std::find(kKnown.begin(), kKnown.end(), ext) != kKnown.end()) return {};
    for (const Program& program : kPrograms) {
        if (ext != program.extension) continue;
        return fail(ErrorCode::BadInput,
                    std::string(program.name) + " files cannot be read; export FBX or glTF from " +
                        std::string(program.name),
                    where);
    }
    return fail(
        ErrorCode::BadInput,
        (ext.empty() ? std::string("the file has no extension")
                     : "\"" + ext + "\" files cannot be read") +
            "; scenes are .obj, .fbx, .gltf, .glb, .dae, .ply and .stl files, and the name of a "
            "project ends in .dolly",
        where);
}

Status checkFirstBytes(const Path& path, const std::string& where) {
    std::ifstream in(path, std::ios::binary);
    if (!in) {
        return fail(ErrorCode::BadInput, "the file cannot be read; check its permissions", where);
    }
    std::array<char, 64> buffer{};
    in.read(buffer.data(), buffer.size());
    const std::string_view head(buffer.data(), static_cast<std::size_t>(in.gcount()));
    if (head.starts_with("version https://git-lfs")) {
        return fail(ErrorCode::BadInput,
                    "this is a Git-LFS pointer, not the model; run \"git lfs pull\" first", where);
    }
    const std::string ext = lowerExtension(path);
    const auto wrong = [&](std::string_view kind) {
        return fail(ErrorCode::BadInput,
                    "the file does not begin like " + std::string(kind) +
                        "; it is damaged or has the wrong extension",
                    where);
    };
    const auto firstLetter = [&] {
        const auto at = head.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
        return at == std::string_view::npos ? '\0' : head[at];
    };
    if (ext == ".glb" && !head.starts_with("glTF")) return wrong("a GLB file");
    if (ext == ".ply" && !head.starts_with("ply")) return wrong("a PLY file");
    if (ext == ".gltf" && firstLetter() != '{') return wrong("a glTF file");
    if (ext == ".dae" && firstLetter() != '<') return wrong("a Collada file");
    return {};
}

}  // namespace

Status checkSceneFile(const Path& path) {
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
        return fail(ErrorCode::BadInput,
                    "this is a folder; name the scene file inside it (.obj, .fbx, .gltf, .glb, "
                    ".dae, .ply or .stl)",
                    where);
    }
    if (!std::filesystem::is_regular_file(status)) {
        return fail(ErrorCode::BadInput, "this is not an ordinary file", where);
    }
    if (Status known = checkExtension(path, where); !known) return known;
    const auto size = std::filesystem::file_size(path, error);
    if (!error && size == 0) {
        return fail(ErrorCode::BadInput, "the file is empty; export or download it again", where);
    }
    return checkFirstBytes(path, where);
}

}  // namespace dollytrack
