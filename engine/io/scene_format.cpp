#include "engine/io/scene_format.h"

#include "engine/io/assimp_reader.h"
#include "engine/io/homes/home_reader.h"

#include <algorithm>
#include <cctype>

namespace dollytrack {
namespace {

Result<RawScene> readModel(const std::filesystem::path& path, const ImportOptions& /*options*/,
                           const JobContext& job) {
    return readWithAssimp(path, job);
}

char firstLetter(std::string_view head) {
    const auto at = head.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
    return at == std::string_view::npos ? '\0' : head[at];
}

bool anything(std::string_view /*head*/) {
    return true;
}
bool likeGltf(std::string_view head) {
    return firstLetter(head) == '{';
}
bool likeGlb(std::string_view head) {
    return head.starts_with("glTF");
}
bool likeCollada(std::string_view head) {
    return firstLetter(head) == '<';
}
bool likePly(std::string_view head) {
    return head.starts_with("ply");
}
bool likeZip(std::string_view head) {
    return head.starts_with("PK");
}

}  // namespace

const std::vector<SceneFormat>& sceneFormats() {
    static const std::vector<SceneFormat> formats = {
        {"an OBJ file", {".obj"}, anything, readModel},
        {"an FBX file", {".fbx"}, anything, readModel},
        {"a glTF file", {".gltf"}, likeGltf, readModel},
        {"a GLB file", {".glb"}, likeGlb, readModel},
        {"a Collada file", {".dae"}, likeCollada, readModel},
        {"a PLY file", {".ply"}, likePly, readModel},
        {"an STL file", {".stl"}, anything, readModel},
        {"a Sweet Home 3D home", {".sh3d"}, likeZip, homes::readHome},
        {"a home's Home.xml", {".xml"}, homes::looksLikeHomeXml, homes::readHome},
    };
    return formats;
}

std::vector<std::string> sceneExtensions() {
    std::vector<std::string> all;
    for (const SceneFormat& format : sceneFormats()) {
        for (const std::string_view extension : format.extensions) {
            if (std::find(all.begin(), all.end(), extension) == all.end()) {
                all.emplace_back(extension);
            }
        }
    }
    return all;
}

std::string lowerExtension(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return extension;
}

}  // namespace dollytrack
