#include "engine/io/semantics/labelled_reader.h"

#include "engine/geometry/ray_caster.h"
#include "engine/io/datasets/object_names.h"
#include "engine/io/files/percent_text.h"
#include "engine/io/gltf/gltf_reader.h"
#include "engine/io/import/mesh_part_builder.h"
#include "engine/io/import/model_reader.h"
#include "engine/io/import/ply_mesh.h"
#include "engine/io/import/scene_assembly.h"
#include "engine/io/import/scene_format.h"
#include "engine/io/pictures/picture_decoder.h"
#include "engine/io/sandbox/confined_folder.h"
#include "engine/io/sandbox/input_file.h"
#include "engine/io/semantics/labelled_faces.h"
#include "engine/jobs/parallel.h"
#include "engine/scene/label_table.h"
#include "engine/scene/labels.h"
#include "engine/scene/srgb.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <unordered_map>

namespace dollytrack::semantics {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMostMeshBytes = std::uint64_t{4} << 30U;

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

/// The object of each triangle of semantic glTF, as a mesh with numbers: by the colours of its
/// vertices, else by those of its picture.
class ColoredMesh {
  public:
    ColoredMesh(const fs::path& path, const LabelNames& names) : path_(path), names_(names) {}

    Result<PlyMesh> read() {
        Result<std::string> bytes = io::readNamedFile(path_, kMostMeshBytes);
        if (!bytes) return tl::unexpected(bytes.error());
        const io::ConfinedFolder folder(path_.parent_path());
        const auto beside = [&](const std::string& uri) -> Result<std::string> {
            const Result<io::InputFile> file = folder.open(percentDecoded(uri));
            if (!file) return tl::unexpected(file.error());
            return file->readAll(kMostMeshBytes);
        };
        Result<gltf::PlacedPrimitives> read =
            gltf::readPrimitives(std::move(*bytes), beside, path_.string());
        if (!read) return tl::unexpected(read.error());
        pictures_.resize(read->scene.textures.size());
        parallelFor(pictures_.size(),
                    [&](std::size_t i) { decode(read->scene.textures[i], folder, pictures_[i]); });
        for (const gltf::Primitive& primitive : read->primitives) add(primitive, read->scene);
        if (mesh_.face_sizes.empty()) {
            return fail(ErrorCode::BadInput, "the labelled mesh has no triangles",
                        path_.string());
        }
        if (known_ == 0) {
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
    static void decode(const TextureRequest& request, const io::ConfinedFolder& folder,
                       Texture& picture) {
        constexpr int kLargestSide = 1 << 14;  // colours are numbers: they must not be averaged
        std::string bytes;
        std::span<const std::uint8_t> encoded = request.embedded;
        if (encoded.empty()) {
            const Result<io::InputFile> file = folder.open(percentDecoded(request.name));
            if (!file) return;
            Result<std::string> all = file->readAll(kMostMeshBytes);
            if (!all) return;
            bytes = std::move(*all);
            encoded = {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()};
        }
        if (!io::decodePicture(encoded, kLargestSide, true, picture)) picture = Texture{};
    }

    void add(const gltf::Primitive& primitive, const RawScene& scene) {
        const auto base = static_cast<std::uint32_t>(mesh_.positions.size());
        mesh_.positions.insert(mesh_.positions.end(), primitive.positions.begin(),
                               primitive.positions.end());
        const int texture = scene.materials[primitive.material].texture;
        const Texture* picture =
            texture >= 0 ? &pictures_[static_cast<std::size_t>(texture)] : nullptr;
        for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
            mesh_.face_sizes.push_back(3);
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t index = primitive.indices[i + k];
                mesh_.face_indices.push_back(index < primitive.positions.size() ? base + index
                                                                               : 0xFFFFFFFFU);
            }
            const auto found = names_.of_color.find(colorOf(primitive, i, picture));
            known_ += found != names_.of_color.end();
            mesh_.face_objects.push_back(found == names_.of_color.end() ? -1 : found->second);
        }
    }

    static std::uint32_t colorOf(const gltf::Primitive& primitive, std::size_t corner,
                                 const Texture* picture) {
        const std::size_t count = primitive.positions.size();
        for (std::size_t k = 0; k < 3; ++k) {
            if (primitive.indices[corner + k] >= count) return 0xFFFFFFFFU;
        }
        if (picture == nullptr || picture->width == 0 || primitive.uvs.empty()) {
            if (primitive.colors.empty()) return 0xFFFFFFFFU;
            return packedColor(primitive.colors[primitive.indices[corner]]);
        }
        Eigen::Vector3f uv = Eigen::Vector3f::Zero();
        for (std::size_t k = 0; k < 3; ++k) uv += primitive.uvs[primitive.indices[corner + k]];
        uv /= 3.0F;
        if (!uv.allFinite()) return 0xFFFFFFFFU;
        const auto pixel = [](float value, int size) {
            const double part = static_cast<double>(value) - std::floor(static_cast<double>(value));
            return std::min(static_cast<int>(part * size), size - 1);
        };
        const int x = pixel(uv.x(), picture->width);
        const int y = pixel(1.0F - uv.y(), picture->height);  // rows from the top
        const std::uint8_t* rgba =
            &picture->rgba[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(
                                                                  picture->width) +
                                static_cast<std::size_t>(x))];
        return static_cast<std::uint32_t>(rgba[0] << 16 | rgba[1] << 8 | rgba[2]);
    }

    const fs::path& path_;
    const LabelNames& names_;
    std::vector<Texture> pictures_;
    PlyMesh mesh_;
    std::size_t known_ = 0;
};

Eigen::AlignedBox3d boundsOf(const RawScene& scene) {
    Eigen::AlignedBox3d box;
    for (const MeshPart& part : scene.parts) {
        if (!part.triangles.empty()) box.extend(part.bounds.cast<double>());
    }
    return box;
}

/// The two meshes of a scan may be stored with different upward axes: the turn that makes their
/// boxes most alike.
Eigen::Affine3d pictureFromLabelled(const RawScene& labelled, const RawScene& pictured) {
    const Eigen::AlignedBox3d want = boundsOf(pictured);
    const Eigen::AlignedBox3d have = boundsOf(labelled);
    Eigen::Affine3d best = Eigen::Affine3d::Identity();
    if (want.isEmpty() || have.isEmpty()) return best;
    double least = std::numeric_limits<double>::infinity();
    for (const double quarter : {0.0, -0.5, 0.5}) {
        Eigen::Affine3d turn = Eigen::Affine3d::Identity();
        turn.linear() = Eigen::AngleAxisd(quarter * M_PI, Eigen::Vector3d::UnitX())
                            .toRotationMatrix()
                            .array()
                            .round();
        const Eigen::AlignedBox3d turned = have.transformed(turn);
        const double apart =
            (turned.min() - want.min()).norm() + (turned.max() - want.max()).norm();
        if (apart < least - 1e-6) {
            least = apart;
            best = turn;
        }
    }
    return best;
}

/// Which of the labelled scene's objects each triangle of another mesh belongs to: that of the same
/// triangle, else of the nearest surface.
class NearestObject {
  public:
    NearestObject(RawScene& labelled, const Eigen::Affine3d& turn)
        : caster_(moved(labelled, turn, same_)) {}

    /// The object's number from 1 on; 0: none is near.
    [[nodiscard]] int at(const MeshPart& part, const Triangle& triangle, double radius) const {
        const auto same = same_.find(cornersOf(part, triangle));
        if (same != same_.end()) return same->second;
        Eigen::Vector3d middle = Eigen::Vector3d::Zero();
        for (const std::uint32_t i : triangle) middle += part.positions[i].cast<double>() / 3.0;
        return caster_.closest(middle, radius).object_id;
    }

  private:
    /// A triangle's corners to a thousandth of a unit, in an order of their own.
    using Corners = std::array<std::array<std::int64_t, 3>, 3>;
    using ByCorners = std::map<Corners, int>;

    static Corners cornersOf(const MeshPart& part, const Triangle& triangle) {
        Corners corners{};
        for (std::size_t k = 0; k < 3; ++k) {
            const Eigen::Vector3f& p = part.positions[triangle[k]];
            for (int axis = 0; axis < 3; ++axis) {
                corners[k][static_cast<std::size_t>(axis)] =
                    std::llround(1000.0 * static_cast<double>(p[axis]));
            }
        }
        std::ranges::sort(corners);
        return corners;
    }

    static Scene moved(RawScene& labelled, const Eigen::Affine3d& turn, ByCorners& same) {
        moveToWorld(labelled.parts, turn);
        for (std::size_t i = 0; i < labelled.objects.size(); ++i) {
            for (const std::size_t part : labelled.objects[i].parts) {
                for (const Triangle& triangle : labelled.parts[part].triangles) {
                    same.try_emplace(cornersOf(labelled.parts[part], triangle),
                                     static_cast<int>(i) + 1);
                }
            }
        }
        std::vector<ObjectDraft> drafts(labelled.objects.size());
        for (std::size_t i = 0; i < drafts.size(); ++i) drafts[i].parts = labelled.objects[i].parts;
        Scene scene;
        assembleObjects(labelled.parts, drafts, scene);
        return scene;
    }

    ByCorners same_;  // before caster_, which is made with it
    RayCaster caster_;
};

/// The triangles of `part` that belong to one object, as a part of their own.
MeshPart pick(const MeshPart& part, const std::vector<std::size_t>& triangles) {
    MeshPart picked;
    picked.name = part.name;
    picked.material = part.material;
    std::unordered_map<std::uint32_t, std::uint32_t> renumbered;
    for (const std::size_t t : triangles) {
        Triangle moved = part.triangles[t];
        for (std::uint32_t& index : moved) {
            const auto [at, is_new] = renumbered.try_emplace(
                index, static_cast<std::uint32_t>(picked.positions.size()));
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

/// Gives the pictured mesh the objects of the labelled one.
RawScene transfer(RawScene labelled, RawScene pictured, const JobContext& job) {
    constexpr double kReach = 0.02;  // of the scene's diagonal: beyond there is no label
    const double radius = kReach * boundsOf(pictured).diagonal().norm();
    const Eigen::Affine3d turn = pictureFromLabelled(labelled, pictured);
    const std::vector<SourceObject> objects = labelled.objects;
    const NearestObject nearest(labelled, turn);
    std::vector<std::vector<std::vector<std::size_t>>> of_part(pictured.parts.size());
    parallelFor(pictured.parts.size(), [&](std::size_t p) {
        of_part[p].resize(objects.size() + 1);
        const MeshPart& part = pictured.parts[p];
        for (std::size_t t = 0; t < part.triangles.size(); ++t) {
            if (t % 4096 == 0 && job.cancelled()) return;
            const int object = nearest.at(part, part.triangles[t], radius);
            of_part[p][static_cast<std::size_t>(object)].push_back(t);
        }
    });
    RawScene scene = std::move(pictured);
    const std::vector<MeshPart> parts = std::move(scene.parts);
    scene.parts.clear();
    scene.nodes = {{"", -1, 0}};
    scene.objects.clear();
    std::size_t unlabelled = 0;
    for (std::size_t i = 1; i <= objects.size() + 1; ++i) {
        const bool last = i == objects.size() + 1;
        SourceObject object;
        if (!last) object = objects[i - 1];
        if (last) {
            object.name = "unlabelled surface";
            object.structure = true;
        }
        object.parts.clear();
        for (std::size_t p = 0; p < parts.size(); ++p) {
            const std::vector<std::size_t>& triangles = of_part[p][last ? 0 : i];
            if (triangles.empty()) continue;
            if (last) unlabelled += triangles.size();
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

}  // namespace

Result<RawScene> readLabelled(const LabelledFiles& files, const JobContext& job) {
    const Result<LabelNames> names = readLabelNames(files);
    if (!names) return tl::unexpected(names.error());
    const bool is_ply = lowerExtension(files.labelled) == ".ply";
    Result<PlyMesh> mesh = is_ply ? readPlyMesh(files.labelled)
                                  : ColoredMesh(files.labelled, *names).read();
    if (!mesh) return tl::unexpected(mesh.error());
    if (job.cancelled()) return fail(ErrorCode::Cancelled, "import was cancelled");
    if (files.kind == LabelKindOfFile::HabitatText && is_ply && mesh->face_objects.empty() &&
        mesh->colors.size() == mesh->positions.size()) {
        for (const Eigen::Vector3f& color : mesh->colors) {
            const auto found = names->of_color.find(packedColor(color));
            mesh->position_objects.push_back(found == names->of_color.end() ? -1 : found->second);
        }
    }
    const bool other = !files.pictured.empty() && files.pictured != files.labelled;
    bool same_vertices = false;
    if (other && is_ply && lowerExtension(files.pictured) == ".ply") {
        Result<PlyMesh> pictured = readPlyMesh(files.pictured);
        if (!pictured) return tl::unexpected(pictured.error());
        same_vertices = pictured->positions.size() == mesh->positions.size();
        if (same_vertices) mesh->colors = std::move(pictured->colors);
    }
    if (!names->segments.empty() && names->segments.size() != mesh->positions.size()) {
        return fail(ErrorCode::BadInput,
                    fmt::format("it says the segments of {} vertices, and the mesh has {}; the two "
                                "files do not belong together",
                                names->segments.size(), mesh->positions.size()),
                    files.segments.string());
    }
    const std::optional<LabelledFaces> faces = labelFaces(*mesh, *names, files.nyu40);
    if (!faces) {
        return fail(ErrorCode::BadInput,
                    "the faces of the labelled mesh have no numbers (object_id, label); it is not "
                    "the one that its file of names belongs to",
                    files.labelled.string());
    }
    RawScene scene = sceneOf(*mesh, *faces, files.names);
    if (other && !same_vertices) {
        Result<RawScene> pictured = readModel(files.pictured, job);
        if (!pictured) return pictured;
        scene = transfer(std::move(scene), std::move(*pictured), job);
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
    const std::optional<LabelledFaces> faces = labelFaces(*mesh, {}, false);
    if (!faces || faces->objects.size() < 2) return sceneOfPly(*mesh);
    RawScene scene = sceneOf(*mesh, *faces, {});
    scene.notes.push_back(
        "the file has numbers of objects or classes without names; name them by --annotations, or "
        "put the set's file of names beside it");
    return scene;
}

}  // namespace dollytrack::semantics
