#include "engine/io/semantics/labelled_reader.h"

#include "engine/core/clean_text.h"
#include "engine/io/datasets/object_names.h"
#include "engine/io/files/percent_text.h"
#include "engine/io/gltf/gltf_reader.h"
#include "engine/io/import/mesh_part_builder.h"
#include "engine/io/import/model_reader.h"
#include "engine/io/import/ply_mesh.h"
#include "engine/io/import/scene_format.h"
#include "engine/io/pictures/picture_decoder.h"
#include "engine/io/sandbox/confined_folder.h"
#include "engine/io/sandbox/input_file.h"
#include "engine/io/semantics/labelled_faces.h"
#include "engine/io/semantics/labelled_surface.h"
#include "engine/io/semantics/name_list.h"
#include "engine/jobs/parallel.h"
#include "engine/scene/label_table.h"
#include "engine/scene/labels.h"
#include "engine/scene/srgb.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <span>
#include <unordered_map>

namespace dollytrack::semantics {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMostMeshBytes = std::uint64_t{4} << 30U;
constexpr std::uint64_t kMostPictureBytes = std::uint64_t{1} << 29U;
constexpr std::size_t kMostTriangles = 60'000'000;  // that placements of glTF meshes may have

Result<PlyMesh> readPlyMesh(const fs::path& path) {
    const Result<std::string> bytes = io::readNamedFile(path, kMostMeshBytes);
    if (!bytes) return tl::unexpected(bytes.error());
    return parsePlyMesh(*bytes, path);
}

/// 0xRRGGBB of an sRGB colour of 0 to 1; no colour of a table where it is no number.
std::uint32_t packedColor(const Eigen::Vector3f& color) {
    if (!color.allFinite()) return 0xFFFFFFFFU;
    std::uint32_t packed = 0;
    for (int i = 0; i < 3; ++i) {
        const float byte = std::round(255.0F * std::clamp(color[i], 0.0F, 1.0F));
        packed = packed << 8U | static_cast<std::uint32_t>(byte);
    }
    return packed;
}

/// Names and classes of objects, in the order in which they come to the scene.
class ObjectList {
  public:
    explicit ObjectList(RawScene& scene) : scene_(scene) {}

    void add(const LabelledObject& labelled, std::vector<std::size_t> parts) {
        if (parts.empty()) return;
        SourceObject object;
        object.category = labelled.category;
        object.nyu40 = labelled.nyu40;
        object.structure = !labelled.target || isStructureClass(labelled.nyu40);
        std::string base = labelled.category;
        if (base.empty()) base = labelled.nyu40 > 0 ? nyu40Name(labelled.nyu40) : "object";
        if (!labelled.target) base = labelled.nyu40 > 0 ? base + " specks" : "unlabelled";
        object.name = names_.next(base);
        object.parts = std::move(parts);
        for (const std::size_t part : object.parts) {
            scene_.nodes[static_cast<std::size_t>(scene_.parts[part].node)].name = object.name;
        }
        if (!labelled.target && labelled.nyu40 == 0) ++unlabelled_;
        scene_.objects.push_back(std::move(object));
    }

    void note(const fs::path& names) const {
        const std::size_t targets = scene_.objects.size() - unlabelled_;
        scene_.notes.push_back(fmt::format(
            "{} by the labels of {}", io::counted(targets, "object", "objects"),
            names.empty() ? std::string("the file itself") : names.filename().string()));
    }

  private:
    RawScene& scene_;
    io::ObjectNames names_;
    std::size_t unlabelled_ = 0;
};

RawScene sceneOf(const PlyMesh& mesh, const LabelledFaces& faces, const fs::path& names) {
    RawScene scene;
    std::vector<std::vector<std::size_t>> of_object(faces.objects.size());
    for (std::size_t f = 0; f < faces.of_face.size(); ++f) of_object[faces.of_face[f]].push_back(f);
    const std::vector<std::size_t> first = firstIndices(mesh);
    ObjectList list(scene);
    for (std::size_t i = 0; i < of_object.size(); ++i) {
        const std::size_t part = addPlyPart(mesh, of_object[i], first, "", scene);
        if (scene.parts[part].triangles.empty()) continue;
        list.add(faces.objects[i], {part});
    }
    list.note(names);
    return scene;
}

Status checkCount(const LabelledFaces& faces, const fs::path& path) {
    constexpr std::size_t kMostObjects = 100'000;
    if (faces.objects.size() <= kMostObjects) return {};
    return fail(ErrorCode::BadInput,
                fmt::format("its labels make {} objects, and at most {} can be read; check that "
                            "they number objects and not faces",
                            faces.objects.size(), kMostObjects),
                path.string());
}

/// The object of each triangle of semantic glTF, as a mesh with numbers: by the colours of its
/// picture, else by those of its vertices.
class ColoredMesh {
  public:
    ColoredMesh(const fs::path& path, const LabelNames& names) : path_(path), names_(names) {}

    Result<PlyMesh> read(const JobContext& job) {
        Result<std::string> bytes = io::readNamedFile(path_, kMostMeshBytes);
        if (!bytes) return tl::unexpected(bytes.error());
        const io::ConfinedFolder folder(path_.parent_path());
        const auto beside = [&](const std::string& uri) -> Result<std::string> {
            const Result<io::InputFile> file = folder.open(percentDecoded(uri));
            if (!file) return tl::unexpected(file.error());
            return file->readAll(kMostMeshBytes);
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
                            "pictures are in a form that cannot be decoded (KTX2)",
                        path_.string());
        }
        return std::move(mesh_);
    }

  private:
    static constexpr std::int64_t kNone = -1;
    /// Of each mesh, primitive and triangle.
    using Objects = std::vector<std::vector<std::vector<std::int64_t>>>;

    /// Few bytes can ask for many copies of a large mesh.
    [[nodiscard]] Status checkPlacements(const gltf::ColoredMeshes& read,
                                         const Objects& objects) const {
        std::vector<std::size_t> cost(objects.size(), 0);
        for (std::size_t m = 0; m < objects.size(); ++m) {
            // Primitives without triangles take time, too.
            for (const auto& of : objects[m]) cost[m] += std::max(of.size(), std::size_t{1});
        }
        std::size_t placed = 0;
        for (const gltf::MeshPlacement& placement : read.placements) {
            placed += cost[placement.mesh];
            if (placed <= kMostTriangles) continue;
            return fail(ErrorCode::BadInput,
                        fmt::format("the nodes of the labelled mesh place more than {} triangles "
                                    "in all; split the scene",
                                    kMostTriangles),
                        path_.string());
        }
        return {};
    }

    /// Pictures are large: only one of them is decoded at a time, for all that it is on.
    [[nodiscard]] Objects objectsOf(const gltf::ColoredMeshes& read,
                                    const io::ConfinedFolder& folder, const JobContext& job) const {
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
                decode(read.scene.textures[static_cast<std::size_t>(decoded)], folder, picture);
            }
            const gltf::Primitive& primitive = read.meshes[task.mesh][task.primitive];
            const bool painted = picture.width > 0 && !primitive.uvs.empty();
            objects[task.mesh][task.primitive] =
                painted ? byPicture(primitive, picture) : byVertices(primitive);
        }
        return objects;
    }

    static void decode(const TextureRequest& request, const io::ConfinedFolder& folder,
                       Texture& picture) {
        constexpr int kLargestSide = 1 << 14;  // colours are numbers: they must not be averaged
        std::string bytes;
        std::span<const std::uint8_t> encoded = request.embedded;
        if (encoded.empty()) {
            const Result<io::InputFile> file = folder.open(percentDecoded(request.name));
            if (!file) return;
            Result<std::string> all = file->readAll(kMostPictureBytes);
            if (!all) return;
            bytes = std::move(*all);
            encoded = {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()};
        }
        if (!io::decodePicture(encoded, kLargestSide, true, picture)) picture = Texture{};
    }

    [[nodiscard]] std::int64_t objectOf(std::uint32_t color) const {
        const auto found = names_.of_color.find(color);
        return found == names_.of_color.end() ? kNone : found->second;
    }

    /// Calls visit(corners) for each triangle; its result is the triangle's object. Those that name
    /// a vertex which is not there have none.
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
            const auto x = static_cast<std::size_t>(pixel(uv.x(), picture.width));
            const auto y =
                static_cast<std::size_t>(pixel(1.0F - uv.y(), picture.height));  // from the top
            const std::uint8_t* rgba =
                &picture.rgba[4 * (y * static_cast<std::size_t>(picture.width) + x)];
            return objectOf(static_cast<std::uint32_t>(rgba[0] << 16 | rgba[1] << 8 | rgba[2]));
        });
    }

    /// Each placement copies the positions, so those that no triangle uses are dropped before.
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

Eigen::AlignedBox3d boundsOf(const RawScene& scene) {
    Eigen::AlignedBox3d box;
    for (const MeshPart& part : scene.parts) {
        if (!part.triangles.empty()) box.extend(part.bounds.cast<double>());
    }
    return box;
}

/// The mean distance of some triangles of a mesh from the labelled surfaces.
double meanDistance(const RawScene& textured, const Eigen::Affine3d& rotation,
                    const LabelledSurface& surface, double radius, const JobContext& job) {
    constexpr std::size_t kEnough = 2000;
    std::size_t count = 0;
    for (const MeshPart& part : textured.parts) count += part.triangles.size();
    const std::size_t step = count / kEnough + 1;
    double sum = 0.0;
    std::size_t at = 0;
    for (const MeshPart& part : textured.parts) {
        for (const Triangle& triangle : part.triangles) {
            if (at++ % step > 0) continue;
            if (job.cancelled()) return 0.0;
            sum += surface.distance(middleOf(cornersOf(part, triangle, rotation)), radius);
        }
    }
    return sum / static_cast<double>((count + step - 1) / step);
}

/// The two meshes of a scan may be stored with different upward axes: the rotation that makes their
/// boxes most alike; of rotations that do so equally well, the one that brings the surfaces
/// together.
Eigen::Affine3d labelledFromTextured(const Eigen::AlignedBox3d& labelled, const RawScene& textured,
                                     const LabelledSurface& surface, double radius,
                                     const JobContext& job) {
    constexpr double kAlike = 0.01;  // of the diagonal
    const Eigen::AlignedBox3d box = boundsOf(textured);
    std::array<Eigen::Affine3d, 3> rotations;
    rotations.fill(Eigen::Affine3d::Identity());
    if (labelled.isEmpty() || box.isEmpty()) return rotations[0];
    rotations[1].linear() << 1, 0, 0, 0, 0, -1, 0, 1, 0;
    rotations[2].linear() << 1, 0, 0, 0, 0, 1, 0, -1, 0;
    std::array<double, 3> apart{};
    for (std::size_t i = 0; i < rotations.size(); ++i) {
        const Eigen::AlignedBox3d rotated = box.transformed(rotations[i]);
        apart[i] =
            (rotated.min() - labelled.min()).norm() + (rotated.max() - labelled.max()).norm();
    }
    const double most = std::ranges::min(apart) + kAlike * box.diagonal().norm();
    std::optional<std::size_t> best;
    double least = 0.0;
    for (std::size_t i = 0; i < rotations.size(); ++i) {
        if (apart[i] > most) continue;
        const double mean = meanDistance(textured, rotations[i], surface, radius, job);
        // A room that looks the same either way stays as it is.
        if (best && mean >= least - 1e-6 * radius) continue;
        best = i;
        least = mean;
    }
    return rotations[best.value_or(0)];
}

/// The triangles of `part` that belong to one object, as a part of their own.
MeshPart pick(const MeshPart& part, const std::vector<std::size_t>& triangles) {
    MeshPart picked;
    picked.name = part.name;
    picked.material = part.material;
    std::unordered_map<std::uint32_t, std::uint32_t> renumbered;
    for (const std::size_t t : triangles) {
        Triangle moved = part.triangles[t];
        for (std::uint32_t& index : moved) {
            const auto [at, is_new] =
                renumbered.try_emplace(index, static_cast<std::uint32_t>(picked.positions.size()));
            if (is_new) {
                picked.positions.push_back(part.positions[index]);
                picked.normals.push_back(part.normals[index]);
                picked.uvs.push_back(part.uvs[index]);
            }
            index = at->second;
        }
        picked.triangles.push_back(moved);
    }
    measurePart(picked);
    return picked;
}

/// Gives the textured mesh the objects of the labelled one.
RawScene transfer(RawScene labelled, RawScene textured, const JobContext& job) {
    constexpr double kReach = 0.02;  // of the scene's diagonal: beyond there is no label
    const double radius = kReach * boundsOf(textured).diagonal().norm();
    const std::vector<SourceObject> objects = labelled.objects;
    const std::size_t none = objects.size();
    const LabelledSurface surface(labelled);
    const Eigen::Affine3d rotation =
        labelledFromTextured(boundsOf(labelled), textured, surface, radius, job);
    // The triangles of each part by object. Only objects that a part has triangles of take memory.
    std::vector<std::map<std::size_t, std::vector<std::size_t>>> of_part(textured.parts.size());
    parallelFor(textured.parts.size(), [&](std::size_t p) {
        const MeshPart& part = textured.parts[p];
        for (std::size_t t = 0; t < part.triangles.size(); ++t) {
            if (t % 64 == 0 && job.cancelled()) return;
            const int object =
                surface.objectAt(cornersOf(part, part.triangles[t], rotation), radius);
            of_part[p][object > 0 ? static_cast<std::size_t>(object) - 1 : none].push_back(t);
        }
    });
    std::vector<std::vector<std::size_t>> parts_of(objects.size() + 1);
    for (std::size_t p = 0; p < of_part.size(); ++p) {
        for (const auto& entry : of_part[p]) parts_of[entry.first].push_back(p);
    }
    RawScene scene = std::move(textured);
    const std::vector<MeshPart> parts = std::move(scene.parts);
    scene.parts.clear();
    scene.nodes = {{"", -1, 0}};
    scene.objects.clear();
    std::size_t unlabelled = 0;
    for (std::size_t i = 0; i <= none; ++i) {
        SourceObject object;
        if (i < none) {
            object = objects[i];
        } else {
            object.name = "unlabelled surface";
            object.structure = true;
        }
        object.parts.clear();
        for (const std::size_t p : parts_of[i]) {
            const std::vector<std::size_t>& triangles = of_part[p].at(i);
            if (i == none) unlabelled += triangles.size();
            object.parts.push_back(scene.parts.size());
            scene.parts.push_back(pick(parts[p], triangles));
            scene.parts.back().node = static_cast<int>(scene.nodes.size());
        }
        if (object.parts.empty()) continue;
        scene.nodes.push_back({object.name, 0, 0});
        ++scene.nodes.front().children;
        scene.objects.push_back(std::move(object));
    }
    scene.notes.insert(scene.notes.end(), labelled.notes.begin(), labelled.notes.end());
    if (unlabelled > 0) {
        scene.notes.push_back(io::counted(unlabelled, "triangle has", "triangles have") +
                              " no labelled surface nearby");
    }
    return scene;
}

/// ARKitScenes has boxes around objects beside a mesh without labels.
void noteBoxes(const fs::path& mesh, RawScene& scene) {
    constexpr std::string_view kEnding = "_3dod_mesh.ply";
    std::string name = mesh.filename().string();
    if (!name.ends_with(kEnding)) return;
    name.replace(name.size() - kEnding.size(), kEnding.size(), "_3dod_annotation.json");
    if (!io::hasFile(mesh.parent_path() / name)) return;
    scene.notes.push_back("the boxes of " + cleanText(name) +
                          " are not read; objects are found by their shape");
}

/// Labels under a name that is not known would be lost without a word.
void noteUnreadNumbers(const PlyMesh& mesh, RawScene& scene) {
    if (mesh.unread_numbers.empty()) return;
    scene.notes.push_back(
        "whole numbers that were not read as labels: " + io::listOf(mesh.unread_numbers, 5) +
        "; call the property object_id if they number objects, label if classes");
}

}  // namespace

Result<RawScene> readLabelled(const LabelledFiles& files, const JobContext& job) {
    const Result<LabelNames> names = readLabelNames(files);
    if (!names) return tl::unexpected(names.error());
    const bool is_ply = lowerExtension(files.labelled) == ".ply";
    Result<PlyMesh> mesh =
        is_ply ? readPlyMesh(files.labelled) : ColoredMesh(files.labelled, *names).read(job);
    if (!mesh) return tl::unexpected(mesh.error());
    if (job.cancelled()) return fail(ErrorCode::Cancelled, "import was cancelled");
    if (files.kind == LabelFileKind::HabitatText && is_ply && mesh->face_objects.empty() &&
        mesh->colors.size() == mesh->positions.size()) {
        for (const Eigen::Vector3f& color : mesh->colors) {
            const auto found = names->of_color.find(packedColor(color));
            mesh->position_objects.push_back(found == names->of_color.end() ? -1 : found->second);
        }
    }
    const bool other = !files.textured.empty() && files.textured != files.labelled;
    bool same_vertices = false;
    if (other && is_ply && lowerExtension(files.textured) == ".ply") {
        Result<PlyMesh> textured = readPlyMesh(files.textured);
        if (!textured) return tl::unexpected(textured.error());
        same_vertices = textured->positions.size() == mesh->positions.size();
        if (same_vertices) mesh->colors = std::move(textured->colors);
    }
    if (!names->segments.empty() && names->segments.size() != mesh->positions.size()) {
        return fail(
            ErrorCode::BadInput,
            fmt::format("it lists segments of {} vertices, and the mesh has {} vertices; the two "
                        "files do not belong together",
                        names->segments.size(), mesh->positions.size()),
            files.segments.string());
    }
    const std::optional<LabelledFaces> faces = labelFaces(*mesh, *names, files.nyu40);
    if (!faces) {
        return fail(ErrorCode::BadInput,
                    "the labelled mesh has no numbers of objects (object_id, label); download it "
                    "again together with its file of names",
                    files.labelled.string());
    }
    if (Status few = checkCount(*faces, files.labelled); !few) return tl::unexpected(few.error());
    RawScene scene = sceneOf(*mesh, *faces, files.names);
    if (other && !same_vertices) {
        Result<RawScene> textured = readModel(files.textured, job);
        if (!textured) return textured;
        scene = transfer(std::move(scene), std::move(*textured), job);
        scene.file_up_axis = UpAxis();  // these sets store z up in glTF, too
    } else if (!is_ply) {
        scene.notes.push_back(
            "the mesh with the room's colours is not beside the labelled one; objects have flat "
            "colours");
    }
    if (job.cancelled()) return fail(ErrorCode::Cancelled, "import was cancelled");
    return scene;
}

Result<RawScene> readPly(const fs::path& path, const JobContext& job) {
    const Result<PlyMesh> mesh = readPlyMesh(path);
    if (!mesh) return tl::unexpected(mesh.error());
    if (job.cancelled()) return fail(ErrorCode::Cancelled, "import was cancelled", path.string());
    LabelNames names;
    std::optional<fs::path> list = findNameList(path);
    std::string list_fault;
    if (list) {
        auto read = readNameList(*list);
        if (read) {
            names.categories = std::move(*read);
        } else {
            list_fault = "the names in " + cleanText(list->filename().string()) +
                         " were not read: " + read.error().message;
            list.reset();
        }
    }
    const std::optional<LabelledFaces> faces = labelFaces(*mesh, names, false);
    if (!faces || faces->objects.size() < 2) {
        RawScene scene = sceneOfPly(*mesh);
        noteBoxes(path, scene);
        noteUnreadNumbers(*mesh, scene);
        return scene;
    }
    if (Status few = checkCount(*faces, path); !few) return tl::unexpected(few.error());
    RawScene scene = sceneOf(*mesh, *faces, list.value_or(fs::path()));
    if (!list_fault.empty()) scene.warnings.push_back(list_fault);
    if (!list) {
        scene.notes.push_back(
            "the file has numbers of objects or classes without names; name them in " +
            cleanText(path.stem().string()) + ".labels.json ({\"3\": \"chair\"}) beside it");
    }
    return scene;
}

}  // namespace dollytrack::semantics
