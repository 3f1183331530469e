#include "engine/io/format_table/input_check.h"
#include "engine/io/files/file_type.h"

#include "engine/core/clean_text.h"
#include "engine/core/name_pattern.h"
#include "engine/core/text_lists.h"
#include "engine/io/datasets/hypersim_annotations.h"
#include "engine/io/files/input_file.h"
#include "engine/io/format_table/scene_format.h"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dollytrack {
namespace {

using Path = std::filesystem::path;

constexpr std::size_t kHeadBytes = 4096;

/// A list of extensions, such as ".obj, .fbx and .stl".
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

/// Advice for unsupported formats, by extension or first bytes; empty for others.
std::string_view adviceFor(std::string_view extension, std::string_view head) {
    struct Kind {
        std::array<std::string_view, 4> extensions;
        std::string_view beginning;
        std::string_view advice;
    };
    using namespace std::string_view_literals;
    static constexpr std::array<Kind, 5> kKinds = {
        {{{".blend"},
          "BLENDER",
          "this is a Blender file; pass --convert, or convert it with: blender -b in.blend "
          "--python-expr \"import "
          "bpy; bpy.ops.export_scene.gltf(filepath='out.glb', export_apply=True)\""},
         {{".ifc", ".ifczip"},
          "ISO-10303-21",
          "this is an IFC building model; convert it with \"assimp export in.ifc out.glb\" "
          "(Debian's assimp-utils); if assimp fails, which it does for many IFC4 files, use "
          "IfcConvert from ifcopenshell.org"},
         {{".usd", ".usda", ".usdc", ".usdz"},
          "PXR-USDC",
          "USD cannot be read, and Debian's Blender lacks it, too; open it in Blender 4 from "
          "blender.org and export glTF"},
         {{},
          "#usda",
          "USD cannot be read, and Debian's Blender lacks it, too; open it in Blender "
          "4 from blender.org and export glTF"},
         {{".skp"},
          "\xFF\xFE\xFF\x0ES\0k\0e\0t\0c\0h\0U\0p"sv,
          "SketchUp files cannot be read; in SketchUp export a 3D model as glTF (.glb) or "
          "Collada"}}};
    for (const Kind& kind : kKinds) {
        const bool named = !extension.empty() &&
                           std::ranges::find(kind.extensions, extension) != kind.extensions.end();
        if (named || (!head.empty() && head.starts_with(kind.beginning))) return kind.advice;
    }
    return {};
}

/// Advice for JSON files that are not scenes.
std::string_view adviceForJson(std::string_view head) {
    const auto all = [&](std::initializer_list<std::string_view> keys) {
        return std::ranges::all_of(
            keys, [&](std::string_view key) { return head.find(key) != head.npos; });
    };
    if (all({"\"assetId\"", "\"object_selection_plan\""}) ||
        all({"\"assetId\"", "\"floor_objects\""})) {
        return "this is a house of Holodeck, which names models of Objaverse without containing "
               "them; load it in AI2-THOR with its Objaverse assets, and export it as glTF from "
               "Unity";
    }
    if (all({"\"proceduralParameters\""}) || all({"\"assetId\"", "\"room0\""}) ||
        all({"\"roomType\"", "\"floorPolygon\""})) {
        return "this is a house of ProcTHOR (AI2-THOR), whose meshes are in Unity's files; use the "
               "same house as a Habitat scene instance (AI2-THOR-Hab)";
    }
    if (all({"\"means\"", "\"shape\""}) || all({"\"means\"", "\"codebook\""})) {
        return "this lists the files of Gaussian splats in the SOG format; save them as an "
               "uncompressed PLY, for example in SuperSplat";
    }
    if (all({"\"dimensions\"", "\"transform\"", "\"confidence\""})) {
        return "this is a scan of RoomPlan as boxes without meshes; export the scan's USDZ, and "
               "from that glTF with Blender 4";
    }
    return "this JSON is not a supported scene; JSON scenes are 3D-FRONT houses and Habitat's "
           "scene instances and dataset configs";
}

/// Advice for files that belong to a scene but are not scenes, by their ending; empty for others.
std::string_view adviceForPart(const Path& path) {
    struct Part {
        std::string_view ending;
        std::string_view advice;
    };
    static constexpr std::array<Part, 30> kParts = {
        {{".mtl", "this is the table of materials of an OBJ file; name the .obj beside it"},
         {".bin", "this is likely the data of a glTF file; name the .gltf beside it"},
         {".zip", "this is an archive; unpack it and name the scene file inside"},
         {".tar", "this is an archive; unpack it and name the scene file inside"},
         {".gz", "this is an archive; unpack it and name the scene file inside"},
         {".tgz", "this is an archive; unpack it and name the scene file inside"},
         {".7z", "this is an archive; unpack it and name the scene file inside"},
         {".rar", "this is an archive; unpack it and name the scene file inside"},
         {".sh3f", "this is a library of furniture, not a home; pass it as --library to generate"},
         {".png", "this is an image; open the scene that uses it"},
         {".jpg", "this is an image; open the scene that uses it"},
         {".jpeg", "this is an image; open the scene that uses it"},
         {".hdr", "this is an image; open the scene that uses it"},
         {".exr", "this is an image; open the scene that uses it"},
         {".ktx2", "this is an image; open the scene that uses it"},
         {".dds", "this is an image; open the scene that uses it"},
         {".navmesh", "this is Habitat's navigation mesh; name the scene instance or the stage"},
         {".semantic.txt", "this names the colours of an HM3D scene; name its .glb"},
         {".house", "this names the objects of a Matterport3D scene; name its .glb"},
         {"info_semantic.json",
          "this names the objects of a Replica scene; name the mesh_semantic.ply beside it"},
         {".aggregation.json",
          "this lists the objects of a ScanNet scan; name its _vh_clean_2.ply"},
         {".segs.json", "this lists the segments of a ScanNet scan; name its _vh_clean_2.ply"},
         {"semseg.v2.json",
          "this lists the objects of a 3RScan scan; name its labels.instances.annotated.v2.ply"},
         {"segments_anno.json",
          "this lists the objects of a ScanNet++ scan; name its mesh_aligned_0.05.ply"},
         {"_3dod_annotation.json",
          "this holds boxes of an ARKitScenes scan; name its _3dod_mesh.ply"},
         {".semantic_config.json",
          "this is a part of a Habitat dataset; name a .scene_instance.json"},
         {".ao_config.json", "this is a part of a Habitat dataset; name a .scene_instance.json"},
         {".lighting_config.json",
          "this is a part of a Habitat dataset; name a .scene_instance.json"},
         {".physics_config.json",
          "this is a part of a Habitat dataset; name a .scene_instance.json"},
         {"semantic_lexicon.json",
          "this is the semantic lexicon of a Habitat dataset; name a .scene_instance.json"}}};
    const std::string name = inSmallLetters(path.filename().string());
    for (const Part& part : kParts) {
        if (name.ends_with(part.ending)) return part.advice;
    }
    return {};
}

/// Advice for files of other programs, by extension; empty for others.
std::string adviceForProgram(const std::string& extension) {
    struct Program {
        std::string_view extension;
        std::string_view name;
    };
    static constexpr std::array<Program, 10> kPrograms = {{{".c4d", "Cinema 4D"},
                                                           {".max", "3ds Max"},
                                                           {".ma", "Maya"},
                                                           {".mb", "Maya"},
                                                           {".3dm", "Rhino"},
                                                           {".hip", "Houdini"},
                                                           {".rvt", "Revit"},
                                                           {".rfa", "Revit"},
                                                           {".pln", "Archicad"},
                                                           {".lxo", "Modo"}}};
    struct Converted {
        std::string_view extension;
        std::string_view advice;
    };
    static constexpr std::string_view kAssimp =
        "convert it to glTF with \"assimp export IN out.glb\" (Debian's assimp-utils)";
    static constexpr std::string_view kOsg =
        "convert it to OBJ with \"osgconv IN out.obj\" (Debian's openscenegraph)";
    static constexpr std::string_view kSplats =
        "save the Gaussian splats as an uncompressed PLY, for example in SuperSplat";
    static constexpr std::string_view kFreeCad = "open it in FreeCAD and export OBJ";
    static constexpr std::string_view kCloudCompare =
        "save it as PLY with CloudCompare from cloudcompare.org (Debian's CloudCompare does not "
        "open it)";
    static constexpr std::string_view kGodot =
        "export the scene from Godot (Scene > Export As > glTF 2.0 Scene)";
    static constexpr std::string_view kUnity =
        "export the scene from Unity as glTF with its package glTFast";
    static constexpr std::array<Converted, 20> kConverted = {
        {{".3ds", kAssimp},
         {".spz", kSplats},
         {".sog", kSplats},
         {".ksplat", kSplats},
         {".dxf", kAssimp},
         {".x3d", kAssimp},
         {".wrl", kOsg},
         {".abc", "open it in Blender 4 from blender.org and export glTF; Debian's lacks Alembic"},
         {".dwg", "export FBX or DXF from AutoCAD, and convert DXF with Debian's assimp-utils"},
         {".step", kFreeCad},
         {".stp", kFreeCad},
         {".iges", kFreeCad},
         {".igs", kFreeCad},
         {".tscn", kGodot},
         {".scn", kGodot},
         {".unity", kUnity},
         {".prefab", kUnity},
         {".e57", kCloudCompare},
         {".las", kCloudCompare},
         {".laz", kCloudCompare}}};
    for (const Converted& kind : kConverted) {
        if (extension != kind.extension) continue;
        return "\"" + extension + "\" files cannot be read; " + std::string(kind.advice);
    }
    for (const Program& program : kPrograms) {
        if (extension != program.extension) continue;
        return std::string(program.name) + " files cannot be read; export FBX or glTF from " +
               std::string(program.name);
    }
    return {};
}

Status checkExtension(const Path& path, const std::string& where) {
    const std::string ext = lowerExtension(path);
    if (ext == ".xacro") {
        return fail(ErrorCode::BadInput,
                    "xacro files cannot be read; expand it with ROS's \"xacro in.urdf.xacro -o "
                    "out.urdf\", or with PyPI's \"xacrodoc\" and the same options",
                    where);
    }
    if (const std::string_view advice = adviceForPart(path); !advice.empty()) {
        return fail(ErrorCode::BadInput, std::string(advice), where);
    }
    const std::vector<std::string> known = sceneExtensions();
    if (std::find(known.begin(), known.end(), ext) != known.end()) return {};
    std::string advice(adviceFor(ext, {}));
    if (advice.empty()) advice = adviceForProgram(ext);
    if (!advice.empty()) return fail(ErrorCode::BadInput, std::move(advice), where);
    return fail(ErrorCode::BadInput,
                (ext.empty() ? std::string("the file has no extension")
                             : "\"" + ext + "\" files cannot be read") +
                    "; scenes are " + listOfExtensions() +
                    " files, and the name of a project ends in .dolly",
                where);
}

Result<const SceneFormat*> formatOf(const Path& path, const std::string& where) {
    const Result<InputFile> file = openNamedFile(path);
    if (!file) {
        return fail(ErrorCode::BadInput, "the file cannot be read; check its permissions", where);
    }
    std::array<char, kHeadBytes> buffer{};
    const std::string_view head(buffer.data(), file->read(0, buffer.data(), buffer.size()));
    if (head.starts_with("version https://git-lfs")) {
        return fail(ErrorCode::BadInput,
                    "this is a Git-LFS pointer, not the model; run \"git lfs pull\" first", where);
    }
    if (const std::string_view advice = adviceFor({}, head); !advice.empty()) {
        return fail(ErrorCode::BadInput, std::string(advice), where);
    }
    const std::string extension = lowerExtension(path);
    if (extension == ".xml" && head.find("<scene") != std::string_view::npos) {
        return fail(ErrorCode::BadInput,
                    "Mitsuba scenes cannot be read; open the OBJ or PLY file of its mesh, or "
                    "combine its meshes in Blender and export glTF",
                    where);
    }
    if (extension == ".xml" && head.find("<mujoco") != std::string_view::npos) {
        return fail(
            ErrorCode::BadInput,
            "MuJoCo models cannot be read; open its mesh files (.obj, .stl) in Blender, place "
            "them, and export glTF, or use the same scene as URDF if there is one",
            where);
    }
    std::string kinds;
    for (const SceneFormat& format : sceneFormats()) {
        if (!has(format, extension)) continue;
        if (format.begins_like(head)) return &format;
        kinds += (kinds.empty() ? "" : " or ") + std::string(format.name);
    }
    const char first = firstLetter(head);
    if (extension == ".json" && (first == '{' || first == '[')) {
        return fail(ErrorCode::BadInput, std::string(adviceForJson(head)), where);
    }
    return fail(
        ErrorCode::BadInput,
        "the file does not start like " + kinds + "; it is damaged or has the wrong extension",
        where);
}

/// The scene files in a folder and up to three levels below, those in the upper levels first. Looks
/// at a limited number of files, because the folder may be any folder of the disk.
std::vector<std::string> sceneFilesIn(const Path& folder) {
    constexpr int kDeepest = 3;
    constexpr int kMostEntries = 5000;
    std::vector<std::pair<int, std::string>> found;
    std::error_code error;
    namespace fs = std::filesystem;
    fs::recursive_directory_iterator entry(folder, fs::directory_options::skip_permission_denied,
                                           error);
    for (int visited = 0;
         !error && entry != fs::recursive_directory_iterator() && visited < kMostEntries;
         ++visited, entry.increment(error)) {
        std::error_code unreadable;
        if (entry.depth() >= kDeepest) entry.disable_recursion_pending();
        if (!entry->is_regular_file(unreadable) || !isSceneFile(entry->path())) continue;
        found.emplace_back(entry.depth(),
                           cleanText(entry->path().lexically_relative(folder).string()));
    }
    std::ranges::sort(found);
    std::vector<std::string> names;
    for (auto& [depth, name] : found) names.push_back(std::move(name));
    return names;
}

std::string describeFolder(const Path& folder) {
    constexpr std::size_t kShown = 5;
    const std::vector<std::string> scenes = sceneFilesIn(folder);
    if (scenes.empty()) {
        return "this is a folder without a scene file; scenes are " + listOfExtensions() + " files";
    }
    return "this is a folder; give the scene file inside it: " + listOf(scenes, kShown);
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
        const std::string hypersim = describeHypersimFolder(path);
        if (!hypersim.empty()) return fail(ErrorCode::Usage, hypersim, where);
        return fail(ErrorCode::BadInput, describeFolder(path), where);
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
