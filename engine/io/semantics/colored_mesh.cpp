#include "engine/io/semantics/colored_mesh.h"

#include "engine/io/files/confined_folder.h"
#include "engine/io/files/input_file.h"
#include "engine/io/files/percent_text.h"
#include "engine/io/gltf/gltf_reader.h"
#include "engine/io/pictures/picture_decoder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace dollytrack::semantics {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMostGltfBytes = std::uint64_t{4} << 30U;
constexpr std::uint64_t kMostPictureBytes = std::uint64_t{1} << 29U;
constexpr std::size_t kMostTriangles = 60'000'000;  // in all placements of glTF meshes together

/// Reads a semantic glTF file as a mesh with an object number per triangle.
class ColoredMesh {
  public:
    ColoredMesh(const fs::path& path, const LabelNames& names) : path_(path), names_(names) {}

    Result<PlyMesh> read(const JobContext& job) {
        Result<std::string> bytes = readNamedFile(path_, kMostGltfBytes);
        if (!bytes) return tl::unexpected(bytes.error());
        const ConfinedFolder folder(path_.parent_path());
        const auto beside = [&](const std::string& uri) -> Result<std::string> {
            const Result<InputFile> file = folder.open(percentDecoded(uri));
            if (!file) return tl::unexpected(file.error());
            return file->readAll(kMostGltfBytes);
        };
        Result<gltf::ColoredMeshes> read =
            gltf::readColoredMeshes(std::move(*bytes), beside, path_.string(), job);
        if (!read) return tl::unexpected(read.error());
        const Objects objects = objectsOf(*read, folder, job);
        if (job.cancelled()) return fail(ErrorCode::Cancelled, "import was cancelled");
        for (std::vector<gltf::Primitive>& primitives : read->meshes) {
            for (gltf::Primitive& primitive : primitives) keepUsedPositions(primitive);
        }
        if (Status few = checkPlacements(*read, objects); !few) return tl::unexpected(few.error());
        for (const gltf::MeshPlacement& placement : read->placements) {
            if (job.cancelled()) return fail(ErrorCode::Cancelled, "import was cancelled");
            const std::vector<gltf::Primitive>& primitives = read->meshes[placement.mesh];
            for (std::size_t i = 0; i < primitives.size(); ++i) {
                add(primitives[i], placement.source_from_mesh, objects[placement.mesh][i]);
            }
        }
        if (mesh_.face_sizes.empty()) {
            return fail(ErrorCode::BadInput, "the labelled mesh has no triangles", path_.string());
        }
        if (std::ranges::all_of(mesh_.face_objects, [](auto object) { return object == kNone; })) {
            return fail(ErrorCode::BadInput,
                        "no colour of the labelled mesh is one of " +
                            std::to_string(names_.of_color.size()) +
                            " in its .semantic.txt; the two files do not belong together, or its "
                            "textures have a format that cannot be decoded (KTX2)",
                        path_.string());
        }
        return std::move(mesh_);
    }

  private:
    static constexpr std::int64_t kNone = -1;
    /// Object numbers by mesh, primitive and triangle.
    using Objects = std::vector<std::vector<std::vector<std::int64_t>>>;

    /// Limits the number of placed triangles: a small file can place a large mesh many times.
    [[nodiscard]] Status checkPlacements(const gltf::ColoredMeshes& read,
                                         const Objects& objects) const {
        std::vector<std::size_t> cost(objects.size(), 0);
        for (std::size_t m = 0; m < objects.size(); ++m) {
            // Primitives without triangles take time as well.
            for (const auto& of : objects[m]) cost[m] += std::max(of.size(), std::size_t{1});
        }
        std::size_t placed = 0;
        for (const gltf::MeshPlacement& placement : read.placements) {
            placed += cost[placement.mesh];
            if (placed <= kMostTriangles) continue;
            return fail(ErrorCode::BadInput,
                        fmt::format("the instances of the labelled mesh have more than {} "
                                    "triangles in total; split the scene",
                                    kMostTriangles),
                        path_.string());
        }
        return {};
    }

    /// The objects of all triangles. Textures are large, so they are decoded one at a time, each
    /// for all primitives that use it.
    [[nodiscard]] Objects objectsOf(const gltf::ColoredMeshes& read, const ConfinedFolder& folder,
                                    const JobContext& job) const {
        struct Task {
            int texture;
            std::size_t mesh;
            std::size_t primitive;
        };
        std::vector<Task> tasks;
        Objects objects(read.meshes.size());
        for (std::size_t m = 0; m < read.meshes.size(); ++m) {
            objects[m].resize(read.meshes[m].size());
            for (std::size_t i = 0; i < read.meshes[m].size(); ++i) {
                tasks.push_back({read.scene.materials[read.meshes[m][i].material].texture, m, i});
            }
        }
        std::ranges::stable_sort(tasks, {}, &Task::texture);
        Texture picture;
        int decoded = -1;
        for (const Task& task : tasks) {
            if (job.cancelled()) return objects;
            if (task.texture != decoded) {
                decoded = task.texture;
                picture = Texture{};
                decode(read.scene.textures[decoded], folder, picture);
            }
            const gltf::Primitive& primitive = read.meshes[task.mesh][task.primitive];
            const bool painted = picture.width > 0 && !primitive.uvs.empty();
            objects[task.mesh][task.primitive] =
                painted ? byPicture(primitive, picture) : byVertices(primitive);
        }
        return objects;
    }

    static void decode(const TextureRequest& request, const ConfinedFolder& folder,
                       Texture& picture) {
        constexpr int kLargestSide = 1 << 14;  // large, since scaling would mix the label colours
        std::string bytes;
        std::span<const std::uint8_t> encoded = request.embedded;
        if (encoded.empty()) {
            const Result<InputFile> file = folder.open(percentDecoded(request.name));
            if (!file) return;
            Result<std::string> all = file->readAll(kMostPictureBytes);
            if (!all) return;
            bytes = std::move(*all);
            encoded = {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()};
        }
        if (!decodePicture(encoded, kLargestSide, true, picture)) picture = Texture{};
    }

    [[nodiscard]] std::int64_t objectOf(std::uint32_t color) const {
        const auto found = names_.of_color.find(color);
        return found == names_.of_color.end() ? kNone : found->second;
    }

    /// Calls visit(corners) for each triangle and returns the results, which are object numbers.
    /// Triangles with an invalid vertex index get kNone.
    template <class Visit>
    static std::vector<std::int64_t> ofTriangles(const gltf::Primitive& primitive, Visit&& visit) {
        std::vector<std::int64_t> objects;
        for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
            const std::span<const std::uint32_t, 3> corners(&primitive.indices[i], 3);
            const bool whole = std::ranges::max(corners) < primitive.positions.size();
            objects.push_back(whole ? visit(corners) : kNone);
        }
        return objects;
    }

    [[nodiscard]] std::vector<std::int64_t> byVertices(const gltf::Primitive& primitive) const {
        std::vector<std::int64_t> of_vertex(primitive.positions.size(), kNone);
        for (std::size_t i = 0; i < primitive.colors.size(); ++i) {
            of_vertex[i] = objectOf(packedColor(primitive.colors[i]));
        }
        return ofTriangles(primitive, [&](std::span<const std::uint32_t, 3> corners) {
            const std::int64_t second = of_vertex[corners[1]];
            return second == of_vertex[corners[2]] ? second : of_vertex[corners[0]];
        });
    }

    [[nodiscard]] std::vector<std::int64_t> byPicture(const gltf::Primitive& primitive,
                                                      const Texture& picture) const {
        const auto pixel = [](float value, int size) {
            const double part = static_cast<double>(value) - std::floor(static_cast<double>(value));
            return std::min(static_cast<int>(part * size), size - 1);
        };
        return ofTriangles(primitive, [&](std::span<const std::uint32_t, 3> corners) {
            Eigen::Vector3f uv = Eigen::Vector3f::Zero();
            for (const std::uint32_t corner : corners) uv += primitive.uvs[corner] / 3.0F;
            if (!uv.allFinite()) return kNone;
            const std::size_t x = pixel(uv.x(), picture.width);
            const auto y =
                static_cast<std::size_t>(pixel(1.0F - uv.y(), picture.height));  // from the top
            const std::uint8_t* rgba =
                &picture.rgba[4 * (y * static_cast<std::size_t>(picture.width) + x)];
            return objectOf(static_cast<std::uint32_t>(rgba[0] << 16 | rgba[1] << 8 | rgba[2]));
        });
    }

    /// Drops positions that no triangle uses, because each placement copies all positions.
    static void keepUsedPositions(gltf::Primitive& primitive) {
        constexpr std::uint32_t kUnused = 0xFFFFFFFFU;
        std::vector<std::uint32_t> renumbered(primitive.positions.size(), kUnused);
        std::vector<Eigen::Vector3f> used;
        for (std::uint32_t& index : primitive.indices) {
            if (index >= renumbered.size()) {
                index = kUnused;
                continue;
            }
            if (renumbered[index] == kUnused) {
                renumbered[index] = static_cast<std::uint32_t>(used.size());
                used.push_back(primitive.positions[index]);
            }
            index = renumbered[index];
        }
        primitive.positions = std::move(used);
    }

    void add(const gltf::Primitive& primitive, const Eigen::Affine3d& source_from_mesh,
             const std::vector<std::int64_t>& objects) {
        const auto base = static_cast<std::uint32_t>(mesh_.positions.size());
        for (const Eigen::Vector3f& p : primitive.positions) {
            mesh_.positions.emplace_back((source_from_mesh * p.cast<double>()).cast<float>());
        }
        for (const std::uint32_t index : std::span(primitive.indices).first(3 * objects.size())) {
            const bool there = index < primitive.positions.size();
            mesh_.face_indices.push_back(there ? base + index : 0xFFFFFFFFU);
        }
        mesh_.face_sizes.insert(mesh_.face_sizes.end(), objects.size(), 3);
        mesh_.face_objects.insert(mesh_.face_objects.end(), objects.begin(), objects.end());
    }

    const fs::path& path_;
    const LabelNames& names_;
    PlyMesh mesh_;
};

}  // namespace

std::uint32_t packedColor(const Eigen::Vector3f& color) {
    if (!color.allFinite()) return 0xFFFFFFFFU;
    std::uint32_t packed = 0;
    for (int i = 0; i < 3; ++i) {
        const float byte = std::round(255.0F * std::clamp(color[i], 0.0F, 1.0F));
        packed = packed << 8U | static_cast<std::uint32_t>(byte);
    }
    return packed;
}

Result<PlyMesh> readColoredMesh(const fs::path& path, const LabelNames& names,
                                const JobContext& job) {
    return ColoredMesh(path, names).read(job);
}

}  // namespace dollytrack::semantics
