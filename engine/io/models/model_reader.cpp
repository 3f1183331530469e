#include "engine/io/models/model_reader.h"

#include "engine/io/assimp/assimp_reader.h"
#include "engine/io/files/confined_folder.h"
#include "engine/io/files/file_type.h"
#include "engine/io/files/percent_text.h"
#include "engine/io/gltf/gltf_reader.h"
#include "engine/io/models/ply_mesh.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace dollytrack {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMostBytes = std::uint64_t{4} << 30U;  // the format's limit for .glb

bool isGltf(const fs::path& path) {
    const std::string extension = lowerExtension(path);
    return extension == ".gltf" || extension == ".glb";
}

bool isPly(const fs::path& path) {
    return lowerExtension(path) == ".ply";
}

Result<RawScene> readPlyBytes(const std::string& bytes, const fs::path& path) {
    const Result<PlyMesh> mesh = parsePlyMesh(bytes, path);
    if (!mesh) return tl::unexpected(mesh.error());
    return sceneOfPly(*mesh);
}

Result<std::string> readBeside(const ConfinedFolder& folder, const std::string& uri) {
    for (const std::string& name : {uri, percentDecoded(uri)}) {
        const Result<InputFile> file = folder.open(name);
        if (file) return file->readAll(kMostBytes);
    }
    return fail(ErrorCode::BadInput, "there is no such file", uri);
}

Result<std::string> readBeside(const FileSource& files, const fs::path& folder,
                               const std::string& uri) {
    for (const std::string& name : {uri, percentDecoded(uri)}) {
        const auto bytes = files.read((folder / name).generic_string());
        if (!bytes) return tl::unexpected(bytes.error());
        if (*bytes) return std::string((*bytes)->begin(), (*bytes)->end());
    }
    return fail(ErrorCode::BadInput, "there is no such file", uri);
}

}  // namespace

Result<RawScene> readModel(const fs::path& path, const JobContext& job) {
    if (!isGltf(path) && !isPly(path)) return readWithAssimp(path, job);
    Result<std::string> bytes = readNamedFile(path, kMostBytes);
    if (!bytes) return tl::unexpected(bytes.error());
    if (isPly(path)) return readPlyBytes(*bytes, path);
    const ConfinedFolder folder(path.parent_path());
    return gltf::readGltf(
        std::move(*bytes), [&](const std::string& uri) { return readBeside(folder, uri); },
        path.string(), job);
}

Result<RawScene> readModel(const FileSource& files, const std::string& name,
                           const JobContext& job) {
    const fs::path folder = fs::path(name).parent_path();
    Result<RawScene> raw;
    if (isPly(name)) {
        const Result<std::string> bytes = readBeside(files, {}, name);
        if (!bytes) return tl::unexpected(bytes.error());
        raw = readPlyBytes(*bytes, name);
    } else if (isGltf(name)) {
        Result<std::string> bytes = readBeside(files, {}, name);
        if (!bytes) return tl::unexpected(bytes.error());
        raw = gltf::readGltf(
            std::move(*bytes),
            [&](const std::string& uri) { return readBeside(files, folder, uri); }, name, job);
    } else {
        raw = readWithAssimp(files, name, job);
    }
    if (!raw) return raw;
    for (TextureRequest& request : raw->textures) {
        if (!request.embedded.empty()) continue;
        std::string relative = request.name;
        std::replace(relative.begin(), relative.end(), '\\', '/');
        const auto bytes = files.read((folder / relative).generic_string());
        if (bytes && *bytes) request.embedded = **bytes;
    }
    return raw;
}

}  // namespace dollytrack
