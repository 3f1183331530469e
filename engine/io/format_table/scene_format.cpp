#include "engine/io/format_table/scene_format.h"

#include "engine/io/datasets/front3d_reader.h"
#include "engine/io/datasets/hypersim_objects.h"
#include "engine/io/datasets/scenenet_reader.h"
#include "engine/io/files/file_type.h"
#include "engine/io/files/input_file.h"
#include "engine/io/files/number_lines.h"
#include "engine/io/gazebo/sdf_reader.h"
#include "engine/io/gazebo/urdf_reader.h"
#include "engine/io/gazebo/visuals.h"
#include "engine/io/habitat/habitat_reader.h"
#include "engine/io/hdf5/hdf5_functions.h"
#include "engine/io/homes/home_reader.h"
#include "engine/io/models/model_reader.h"
#include "engine/io/pointcloud/cloud_scene.h"
#include "engine/io/pointcloud/files/ply_points.h"
#include "engine/io/pointcloud/files/text_points.h"
#include "engine/io/semantics/label_gaps.h"
#include "engine/io/semantics/labelled_reader.h"

#include <algorithm>
#include <array>

namespace dollytrack {
namespace {

/// The folder with Hypersim's annotations: the given one, otherwise the one beside an OBJ file;
/// empty if there is none.
Result<std::filesystem::path> annotationsFor(const std::filesystem::path& path,
                                             const ImportOptions& options) {
    std::error_code error;
    if (!options.annotations || !std::filesystem::is_directory(*options.annotations, error)) {
        return lowerExtension(path) == ".obj" && !options.annotations ? findHypersimBeside(path)
                                                                      : std::filesystem::path();
    }
    std::filesystem::path found = findHypersimMesh(*options.annotations);
    if (!found.empty()) return found;
    return fail(ErrorCode::BadInput,
                "there is no _detail/mesh/metadata_objects.csv in the folder of annotations",
                options.annotations->string());
}

Result<RawScene> readAnyModel(const std::filesystem::path& path, const ImportOptions& options,
                              const JobContext& job) {
    const Result<std::filesystem::path> folder = annotationsFor(path, options);
    if (!folder) return tl::unexpected(folder.error());
    if (folder->empty()) {
        const std::string extension = lowerExtension(path);
        if (extension == ".ply" || extension == ".glb") {
            const auto labels = semantics::findLabelledFiles(path);
            Result<RawScene> scene = labels                ? semantics::readLabelled(*labels, job)
                                     : extension == ".ply" ? semantics::readPly(path, job)
                                                           : readModel(path, job);
            std::string gap = semantics::missingLabelFile(path);
            if (scene && !gap.empty()) scene->warnings.push_back(std::move(gap));
            return scene;
        }
        return readModel(path, job);
    }
    const Result<HypersimAnnotations> annotations = readHypersimAnnotations(*folder);
    if (!annotations) return tl::unexpected(annotations.error());
    Result<RawScene> scene = readModel(path, job);
    if (scene) applyHypersim(*annotations, *scene);
    return scene;
}

std::vector<std::filesystem::path> modelInputs(const std::filesystem::path& path,
                                               const ImportOptions& options) {
    std::vector<std::filesystem::path> inputs = options.model_folders;  // with textures
    const Result<std::filesystem::path> folder = annotationsFor(path, options);
    if (!folder || folder->empty()) return inputs;
    std::ranges::copy(hypersimInputs(*folder), std::back_inserter(inputs));
    return inputs;
}

constexpr double kCloudWork = 8.0;

bool anything(std::string_view /*head*/) {
    return true;
}
bool likeGltf(std::string_view head) {
    return firstLetter(head) == '{';
}
bool likeGlb(std::string_view head) {
    return head.starts_with("glTF");
}
bool likeXml(std::string_view head) {
    return firstLetter(head) == '<';
}
bool likePcd(std::string_view head) {
    return head.find("VERSION") != std::string_view::npos ||
           head.find("FIELDS") != std::string_view::npos;
}
/// Whether a text has lines of three or more numbers, after a few lines of names and comments.
bool likeText(std::string_view head) {
    if (head.find('\0') != std::string_view::npos) return false;
    int lines = 0;
    for (const std::string_view line : splitLines(head)) {
        if (line.find_first_not_of("0123456789+-.eE,; \t\r") == std::string_view::npos &&
            countPointNumbers(line) >= 3) {
            return true;
        }
        if (++lines > 20) return false;
    }
    return false;
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
        {"an OBJ file", {".obj"}, anything, readAnyModel, modelInputs, false, 1.0, false, 'y'},
        {"an FBX file", {".fbx"}, anything, readAnyModel, modelInputs},
        {"a glTF file", {".gltf"}, likeGltf, readAnyModel, modelInputs},
        {"a GLB file", {".glb"}, likeGlb, readAnyModel, modelInputs},
        {"a Collada file", {".dae"}, likeXml, readAnyModel, modelInputs},
        {"a PLY file of points",
         {".ply"},
         isPlyOfPoints,
         readPointCloud,
         nullptr,
         false,
         kCloudWork},
        {"a PLY file", {".ply"}, likePly, readAnyModel, modelInputs},
        {"an STL file", {".stl"}, anything, readAnyModel, modelInputs},
        {"a world of Gazebo",
         {".world", ".sdf"},
         likeXml,
         gazebo::readSdf,
         gazebo::foldersOfWorld,
         false,
         1.0,
         true},
        {"a URDF file",
         {".urdf"},
         likeXml,
         gazebo::readUrdf,
         gazebo::foldersOfWorld,
         false,
         1.0,
         true},
        {"a scene of Habitat",
         {".json"},
         habitat::likeHabitat,
         habitat::readHabitat,
         habitat::habitatInputs,
         true,
         1.0,
         true},
        {"a 3D-FRONT scene", {".json"}, likeFront3d, readFront3dScene, front3dInputs, true},
        {"a SceneNet RGB-D scene", {".txt"}, likeSceneNet, readSceneNetScene, sceneNetInputs, true},
        {"a Sweet Home 3D home", {".sh3d"}, likeZip, homes::readHome, homes::homeInputs},
        {"a home's Home.xml",
         {".xml"},
         homes::looksLikeHomeXml,
         homes::readHome,
         homes::homeInputs},
        {"a PCD file", {".pcd"}, likePcd, readPointCloud, nullptr, false, kCloudWork},
        {"a text file of points",
         {".xyz", ".txt", ".asc", ".csv", ".pts"},
         likeText,
         readPointCloud,
         nullptr,
         true,
         kCloudWork},
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

bool isSceneFile(const std::filesystem::path& path) {
    if (habitat::isHabitatPart(path)) return false;
    const std::string extension = lowerExtension(path);
    for (const SceneFormat& format : sceneFormats()) {
        const auto& ours = format.extensions;
        if (std::find(ours.begin(), ours.end(), extension) == ours.end()) continue;
        if (!format.shares_extension) return true;
        const Result<InputFile> file = openNamedFile(path);
        std::array<char, 4096> head{};
        const std::size_t length = file ? file->read(0, head.data(), head.size()) : 0;
        if (format.begins_like({head.data(), length})) return true;
    }
    return false;
}

void loadLibrariesFor(const std::filesystem::path& path, const ImportOptions& options) {
    const Result<std::filesystem::path> folder = annotationsFor(path, options);
    if (folder && !folder->empty()) hdf5Functions();
}

}  // namespace dollytrack
