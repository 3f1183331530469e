#include "engine/io/assimp/assimp_reader.h"

#include "engine/core/clean_text.h"
#include "engine/io/assimp/assimp_files.h"
#include "engine/io/assimp/assimp_folder.h"
#include "engine/io/assimp/collada_asset.h"
#include "engine/io/raw_scene/mesh_part_builder.h"
#include "engine/io/raw_scene/vertex_colors.h"
#include "engine/jobs/parallel.h"
#include "engine/scene/srgb.h"

#include <fmt/format.h>

#include <assimp/BaseImporter.h>
#include <assimp/config.h>
#include <assimp/importerdesc.h>
#include <assimp/scene.h>
#include <assimp/Importer.hpp>
#include <assimp/ProgressHandler.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <exception>
#include <iterator>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string_view>
#include <thread>

namespace dollytrack {
namespace {

using Path = std::filesystem::path;

std::string extensionOf(const Path& path) {
    std::string ext = path.extension().string();
    for (char& c : ext) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return ext;
}

/// Unregisters all readers of assimp except those for our formats, since assimp tries each of its
/// readers on unknown files.
void keepOurReaders(Assimp::Importer& importer) {
    const auto isOurs = [](std::string_view extensions) {
        for (const std::string_view ours : {"obj", "fbx", "dae", "stl"}) {
            for (std::size_t at = extensions.find(ours); at != std::string_view::npos;
                 at = extensions.find(ours, at + 1)) {
                const bool starts = at == 0 || extensions[at - 1] == ' ';
                const std::size_t end = at + ours.size();
                if (starts && (end == extensions.size() || extensions[end] == ' ')) return true;
            }
        }
        return false;
    };
    for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
        const aiImporterDesc* info = importer.GetImporterInfo(i);
        if (info && isOurs(info->mFileExtensions)) continue;
        const std::unique_ptr<Assimp::BaseImporter> not_ours(importer.GetImporter(i));
        importer.UnregisterLoader(not_ours.get());  // passes ownership back
    }
}

class CancelWatch : public Assimp::ProgressHandler {
  public:
    explicit CancelWatch(const JobContext& job) : job_(job) {}
    bool Update(float) override { return !job_.cancelled(); }

  private:
    JobContext job_;
};

/// Frees an importer's scene on a separate thread, because this takes long for many faces. The
/// program waits for it before it ends.
class BackgroundDisposal {
  public:
    ~BackgroundDisposal() {
        if (worker_.joinable()) worker_.join();
    }
    void take(std::unique_ptr<Assimp::Importer> importer) {
        const std::lock_guard lock(mutex_);
        if (worker_.joinable()) worker_.join();
        worker_ = std::thread([done = std::move(importer)]() mutable { done.reset(); });
    }

  private:
    std::mutex mutex_;
    std::thread worker_;
};

Eigen::Affine3d toAffine(const aiMatrix4x4& m) {
    Eigen::Affine3d result = Eigen::Affine3d::Identity();
    for (unsigned row = 0; row < 3; ++row) {
        for (unsigned col = 0; col < 4; ++col) {
            result.matrix()(row, col) = static_cast<double>(m[row][col]);
        }
    }
    return result;
}

ColladaAsset readColladaAsset(Assimp::IOSystem& files, const Path& path) {
    Assimp::IOStream* file = files.Open(path.c_str(), "rb");
    if (!file) return {};
    std::string head(65536, '\0');
    head.resize(file->Read(head.data(), 1, head.size()));
    files.Close(file);
    return parseColladaAsset(head);
}

/// Undoes assimp's conversion of Collada scenes to y up and metres.
Eigen::Affine3d undoCollada(const ColladaAsset& asset) {
    Eigen::Matrix3d assimp_from_file = Eigen::Matrix3d::Identity();
    if (asset.up_axis == 'z') assimp_from_file << 1, 0, 0, 0, 0, 1, 0, -1, 0;
    if (asset.up_axis == 'x') assimp_from_file << 0, -1, 0, 1, 0, 0, 0, 0, 1;
    Eigen::Affine3d back = Eigen::Affine3d::Identity();
    back.linear() = assimp_from_file.transpose() / asset.unit_m;
    return back;
}

void readFbxFrame(const aiScene& scene, RawScene& raw) {
    if (!scene.mMetaData) return;
    double unit_cm = 0.0;
    float unit_cm_float = 0.0F;
    std::int32_t axis = -1;
    if (!scene.mMetaData->Get("UnitScaleFactor", unit_cm) &&
        scene.mMetaData->Get("UnitScaleFactor", unit_cm_float)) {
        unit_cm = static_cast<double>(unit_cm_float);
    }
    if (unit_cm > 0.0 && unit_cm < 1e9) raw.file_unit_m = unit_cm * 0.01;
    if (scene.mMetaData->Get("UpAxis", axis) && axis >= 0 && axis < 3) {
        std::int32_t sign = 1;
        static_cast<void>(scene.mMetaData->Get("UpAxisSign", sign));
        raw.file_up_axis = UpAxis("xyz"[axis], sign < 0);
    }
}

/// Collects the textures of all materials, each once.
class TextureList {
  public:
    TextureList(const aiScene& scene, RawScene& raw) : scene_(scene), raw_(raw) {}

    int request(const std::string& name, bool opaque) {
        const auto [found, is_new] =
            indices_.try_emplace(name, static_cast<int>(raw_.textures.size()));
        if (is_new) {
            TextureRequest request;
            request.name = name;
            if (const aiTexture* inside = scene_.GetEmbeddedTexture(name.c_str())) {
                embed(*inside, request);
            }
            raw_.textures.push_back(std::move(request));
        }
        TextureRequest& texture = raw_.textures[found->second];
        texture.opaque = texture.opaque && opaque;
        return found->second;
    }

  private:
    static void embed(const aiTexture& inside, TextureRequest& request) {
        if (inside.mFilename.length > 0) request.name = inside.mFilename.C_Str();
        const auto* bytes = reinterpret_cast<const std::uint8_t*>(inside.pcData);
        if (inside.mHeight == 0) {
            request.embedded.assign(bytes, bytes + inside.mWidth);
            return;
        }
        const std::size_t count = std::size_t{inside.mWidth} * inside.mHeight;
        if (count > (std::size_t{1} << 26)) return;
        request.embedded_width = static_cast<int>(inside.mWidth);
        request.embedded_height = static_cast<int>(inside.mHeight);
        request.embedded.reserve(4 * count);
        for (std::size_t i = 0; i < count; ++i) {
            const aiTexel& texel = inside.pcData[i];
            request.embedded.insert(request.embedded.end(), {texel.r, texel.g, texel.b, texel.a});
        }
    }

    const aiScene& scene_;
    RawScene& raw_;
    std::map<std::string, int> indices_;
};

/// A texture with the same texture coordinates as the base colour's; -1: none.
int mapOf(const aiMaterial& source, aiTextureType type, TextureList& textures) {
    aiString file;
    unsigned uv_set = 0;
    const bool found = source.GetTexture(type, 0, &file, nullptr, &uv_set) == AI_SUCCESS;
    return found && file.length > 0 && uv_set == 0 ? textures.request(file.C_Str(), true) : -1;
}

Material readMaterial(const aiMaterial& source, const std::string& format, TextureList& textures) {
    Material material;
    aiString name;
    if (source.Get(AI_MATKEY_NAME, name) == AI_SUCCESS) material.name = cleanText(name.C_Str());

    aiColor4D color(0.8F, 0.8F, 0.8F, 1.0F);
    if (source.Get(AI_MATKEY_BASE_COLOR, color) != AI_SUCCESS) {
        source.Get(AI_MATKEY_COLOR_DIFFUSE, color);
        color = {linearFromSrgb(color.r), linearFromSrgb(color.g), linearFromSrgb(color.b),
                 color.a};
    }
    aiString file;
    if (source.GetTexture(aiTextureType_BASE_COLOR, 0, &file) == AI_SUCCESS ||
        source.GetTexture(aiTextureType_DIFFUSE, 0, &file) == AI_SUCCESS) {
        material.texture = textures.request(file.C_Str(), false);
        // The texture replaces the colour, because exporters write arbitrary colours beside one.
        color = {1.0F, 1.0F, 1.0F, color.a};
    }
    const auto clean = [](float value) {
        return std::isfinite(value) ? std::clamp(value, 0.0F, 1.0F) : 0.8F;
    };
    material.base_color = {clean(color.r), clean(color.g), clean(color.b)};

    float opacity = 1.0F;
    source.Get(AI_MATKEY_OPACITY, opacity);
    // Some exporters write an opacity of 0 for opaque materials; invisible ones are not modelled.
    material.opacity = !(opacity > 0.0F) ? 1.0F : std::min(opacity, 1.0F);

    // Ke in MTL files is more often a default value than a lamp, so it is ignored without a map.
    aiColor3D emission;
    material.emission_map = mapOf(source, aiTextureType_EMISSIVE, textures);
    const bool says = source.Get(AI_MATKEY_COLOR_EMISSIVE, emission) == AI_SUCCESS;
    if (says && material.emission_map >= 0) {
        material.emission = {clean(emission.r), clean(emission.g), clean(emission.b)};
    }
    // Exporters write black together with an emission texture.
    const bool black = material.emission.isZero(0.0F);
    if (material.emission_map >= 0 && black) material.emission.setOnes();

    // Collada's bump map, which assimp reports as a normal map, is a height map.
    if (format != ".dae") material.normal_map = mapOf(source, aiTextureType_NORMALS, textures);
    material.roughness_map = mapOf(source, aiTextureType_DIFFUSE_ROUGHNESS, textures);
    material.metallic_map = mapOf(source, aiTextureType_METALNESS, textures);
    if (material.roughness_map >= 0) material.roughness = 1.0F;
    if (material.metallic_map >= 0) material.metallic = 1.0F;
    source.Get(AI_MATKEY_METALLIC_FACTOR, material.metallic);
    source.Get(AI_MATKEY_ROUGHNESS_FACTOR, material.roughness);
    float shininess = 0.0F;
    if (material.roughness_map < 0 && source.Get(AI_MATKEY_SHININESS, shininess) == AI_SUCCESS) {
        // Blinn exponent to roughness, the usual approximation.
        material.roughness = std::sqrt(2.0F / (std::max(shininess, 0.0F) + 2.0F));
        material.roughness = std::clamp(material.roughness, 0.2F, 0.9F);
    }
    material.metallic = clean(material.metallic);
    material.roughness = clean(material.roughness);
    return material;
}

/// A node of SketchUp's Collada files with at least this many geometries holds a room and is
/// divided.
constexpr std::size_t kRoomInOneNode = 20;

struct Placement {
    const aiMesh* mesh = nullptr;
    Eigen::Affine3d source_from_mesh;
    int node = 0;
};

/// Adds the meshes of a node. If `divide` is set and the node has at least kRoomInOneNode
/// geometries, each becomes a node of its own with all its materials.
void placeMeshes(const aiScene& scene, const aiNode& node, const Eigen::Affine3d& here, bool divide,
                 RawScene& raw, std::vector<Placement>& placements) {
    const auto own = static_cast<int>(raw.nodes.size()) - 1;
    const std::size_t first = placements.size();
    std::map<std::string_view, int> node_of_geometry;
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
        if (node.mMeshes[i] >= scene.mNumMeshes) continue;
        const aiMesh* mesh = scene.mMeshes[node.mMeshes[i]];
        node_of_geometry.emplace(mesh->mName.C_Str(), own);
        placements.push_back({mesh, here, own});
    }
    if (!divide || node_of_geometry.size() < kRoomInOneNode) return;
    for (Placement& one : std::span(placements).subspan(first)) {
        int& geometry = node_of_geometry.at(one.mesh->mName.C_Str());
        if (geometry == own) {
            geometry = static_cast<int>(raw.nodes.size());
            raw.nodes.push_back({cleanText(one.mesh->mName.C_Str()), own, 0});
            ++raw.nodes[own].children;
        }
        one.node = geometry;
    }
}

/// Traverses the nodes with an explicit stack, because a file's nesting depth is not limited.
std::vector<Placement> collectPlacements(const aiScene& scene, const Eigen::Affine3d& root,
                                         bool divide, RawScene& raw) {
    struct Visit {
        const aiNode* node;
        int parent;
        Eigen::Affine3d source_from_parent;
    };
    std::vector<Placement> placements;
    std::vector<Visit> stack = {{scene.mRootNode, -1, root}};
    while (!stack.empty()) {
        const Visit visit = stack.back();
        stack.pop_back();
        const auto index = static_cast<int>(raw.nodes.size());
        raw.nodes.push_back({cleanText(visit.node->mName.C_Str()), visit.parent, 0});
        if (visit.parent >= 0) ++raw.nodes[visit.parent].children;
        const Eigen::Affine3d here =
            visit.source_from_parent * toAffine(visit.node->mTransformation);
        placeMeshes(scene, *visit.node, here, divide, raw, placements);
        for (unsigned i = visit.node->mNumChildren; i-- > 0;) {
            stack.push_back({visit.node->mChildren[i], index, here});
        }
    }
    return placements;
}

std::span<const Eigen::Vector3f> vectors(const aiVector3D* data, unsigned count) {
    static_assert(sizeof(aiVector3D) == sizeof(Eigen::Vector3f));
    if (!data) return {};
    return {reinterpret_cast<const Eigen::Vector3f*>(data), count};
}

/// The vertex colours of a mesh; empty if it has none.
std::vector<Eigen::Vector3f> vertexColorsOf(const aiMesh& mesh) {
    std::vector<Eigen::Vector3f> colors;
    if (!mesh.mColors[0]) return colors;
    colors.reserve(mesh.mNumVertices);
    for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
        const aiColor4D& c = mesh.mColors[0][v];
        colors.emplace_back(c.r, c.g, c.b);
    }
    return colors;
}

struct ReadMesh {
    RepairCounts repairs;
    std::optional<TextureRequest> painted;  // the vertex colours as a texture, if they differ
};

/// `colors`: the vertex colours to be shown; empty: none.
ReadMesh readMesh(const Placement& placement, std::uint32_t material,
                  const std::vector<Eigen::Vector3f>& colors, MeshPart& part) {
    const aiMesh& mesh = *placement.mesh;
    part.name = cleanText(mesh.mName.C_Str());
    part.node = placement.node;
    part.material = material;
    std::vector<std::uint32_t> sizes;
    std::vector<std::uint32_t> indices;
    sizes.reserve(mesh.mNumFaces);
    indices.reserve(std::size_t{4} * mesh.mNumFaces);
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
        const aiFace& face = mesh.mFaces[i];
        sizes.push_back(face.mNumIndices);
        indices.insert(indices.end(), face.mIndices, face.mIndices + face.mNumIndices);
    }
    SourceMesh source;
    source.positions = vectors(mesh.mVertices, mesh.mNumVertices);
    source.normals = vectors(mesh.mNormals, mesh.mNumVertices);
    source.uvs = vectors(mesh.mTextureCoords[0], mesh.mNumVertices);
    source.face_sizes = sizes;
    source.face_indices = indices;
    std::optional<PaintedMesh> painted = paintVertexColors(source, colors);
    if (painted) source = painted->mesh(sizes);
    ReadMesh read;
    read.repairs = buildMeshPart(source, placement.source_from_mesh, part);
    if (painted) read.painted = std::move(painted->texture);
    return read;
}

/// Reads all meshes. Vertex colours are used in scenes with hardly any materials, because they may
/// also be masks or weights.
void readMeshes(const aiScene& scene, const std::vector<Placement>& placements,
                const JobContext& job, RawScene& raw) {
    const auto last_material = static_cast<std::uint32_t>(raw.materials.size() - 1);
    raw.parts.resize(placements.size());
    std::vector<ReadMesh> read(placements.size());
    std::vector<std::vector<Eigen::Vector3f>> colors(placements.size());
    parallelFor(placements.size(), [&](std::size_t i) {
        if (job.cancelled()) return;
        const aiMesh& mesh = *placements[i].mesh;
        const std::uint32_t index = std::min(mesh.mMaterialIndex, last_material);
        const Material& material = raw.materials[index];
        if (material.texture < 0 && !material.hasMaps() && scene.mNumMaterials <= 2) {
            colors[i] = vertexColorsOf(mesh);
        }
        read[i] = readMesh(placements[i], index, colors[i], raw.parts[i]);
        colors[i].resize(std::min<std::size_t>(colors[i].size(), 1));
    });
    for (std::size_t i = 0; i < placements.size(); ++i) {
        raw.repairs.add(read[i].repairs);
        if (colors[i].empty()) continue;
        Material material = raw.materials[raw.parts[i].material];
        if (read[i].painted) {
            material.texture = static_cast<int>(raw.textures.size());
            material.base_color.setOnes();
            raw.textures.push_back(std::move(*read[i].painted));
        } else {
            if (!colors[i].front().allFinite()) continue;
            material.base_color =
                colors[i].front().cwiseMax(0.0F).cwiseMin(1.0F).unaryExpr(&linearFromSrgb);
        }
        raw.parts[i].material = static_cast<std::uint32_t>(raw.materials.size());
        raw.materials.push_back(material);
    }
}

Result<RawScene> convert(const aiScene& scene, Assimp::IOSystem& files, const Path& path,
                         const JobContext& job) {
    RawScene raw;
    const std::string ext = extensionOf(path);
    Eigen::Affine3d root = Eigen::Affine3d::Identity();
    bool by_sketchup = false;
    if (ext == ".fbx") {
        readFbxFrame(scene, raw);
    } else if (ext == ".dae") {
        const ColladaAsset asset = readColladaAsset(files, path);
        raw.file_unit_m = asset.unit_m;
        raw.file_up_axis = asset.up_axis;
        by_sketchup = asset.by_sketchup;
        raw.up_is_certain = by_sketchup && asset.up_axis == 'z';
        root = undoCollada(asset);
    }
    TextureList textures(scene, raw);
    for (unsigned i = 0; i < scene.mNumMaterials; ++i) {
        raw.materials.push_back(readMaterial(*scene.mMaterials[i], ext, textures));
    }
    if (raw.materials.empty()) raw.materials.emplace_back();

    const std::vector<Placement> placements = collectPlacements(scene, root, by_sketchup, raw);
    readMeshes(scene, placements, job, raw);
    return raw;
}

void noteRepairs(const ModelTextRepairs& repairs, const Path& path,
                 std::vector<std::string>& notes) {
    if (const std::size_t faces = repairs.mended_faces; faces > 0) {
        notes.push_back(
            fmt::format("{} texture coordinates that are not in the file; without them {} a single "
                        "colour of the texture",
                        faces == 1 ? "1 face names" : fmt::format("{} faces name", faces),
                        faces == 1 ? "it has" : "they have"));
    }
    std::set<std::string> missing = repairs.missingMaterials();
    // In place of a missing material file, assimp tries one with the model's name.
    if (missing.size() > 1) missing.erase(path.stem().string() + ".mtl");
    constexpr std::ptrdiff_t kMostNamed = 10;
    if (missing.empty()) return;
    const auto end = std::next(missing.begin(),
                               std::min(kMostNamed, static_cast<std::ptrdiff_t>(missing.size())));
    notes.push_back(fmt::format(
        "material files are missing or cannot be read: {}{}", fmt::join(missing.begin(), end, ", "),
        end == missing.end() ? "" : fmt::format(" and {} more", missing.size() - kMostNamed)));
}

/// Reads `path` with an importer that has a file system for it.
Result<RawScene> read(std::unique_ptr<Assimp::Importer> importer, const Path& path,
                      ModelTextRepairs& repairs, const JobContext& job) {
    const std::string where = path.string();
    try {
        keepOurReaders(*importer);
        importer->SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, false);
        importer->SetProgressHandler(new CancelWatch(job));  // the importer owns it
        const aiScene* scene = importer->ReadFile(path.string(), 0);
        if (job.cancelled()) return fail(ErrorCode::Cancelled, "import was cancelled", where);
        if (!scene || !scene->mRootNode) {
            std::string reason =
                repairs.refusal.empty() ? importer->GetErrorString() : repairs.refusal;
            std::replace(reason.begin(), reason.end(), '\n', ' ');
            reason = cleanText(reason);
            return fail(ErrorCode::BadInput,
                        "the file cannot be read as a 3D scene (" + reason +
                            "); export it again, preferably as glTF",
                        where);
        }
        Result<RawScene> raw = convert(*scene, *importer->GetIOHandler(), path, job);
        if (raw) noteRepairs(repairs, path, raw->notes);
        static BackgroundDisposal disposal;
        disposal.take(std::move(importer));
        if (job.cancelled()) return fail(ErrorCode::Cancelled, "import was cancelled", where);
        return raw;
    } catch (const std::exception& e) {
        return fail(ErrorCode::BadInput,
                    std::string("the file cannot be read as a 3D scene (") + e.what() +
                        "); export it again, preferably as glTF",
                    where);
    }
}

}  // namespace

Result<RawScene> readWithAssimp(const Path& path, const JobContext& job) {
    auto importer = std::make_unique<Assimp::Importer>();
    // The importer may live on after this function, but opens nothing then.
    ModelTextRepairs repairs;
    importer->SetIOHandler(new AssimpFolder(path, repairs));  // the importer owns it
    return read(std::move(importer), path, repairs, job);
}

Result<RawScene> readWithAssimp(const FileSource& files, const std::string& name,
                                const JobContext& job) {
    auto importer = std::make_unique<Assimp::Importer>();
    ModelTextRepairs repairs;
    importer->SetIOHandler(new AssimpFiles(files, repairs));  // the importer owns it
    return read(std::move(importer), name, repairs, job);
}

}  // namespace dollytrack
