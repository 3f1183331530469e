#include "engine/io/models/ply_mesh.h"

#include "engine/core/clean_text.h"
#include "engine/core/name_pattern.h"
#include "engine/io/pointcloud/files/ply_file.h"
#include "engine/io/raw_scene/mesh_part_builder.h"
#include "engine/io/raw_scene/vertex_colors.h"
#include "engine/scene/srgb.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <unordered_map>

namespace dollytrack {
namespace {

enum Slot : std::size_t { X, Y, Z, Nx, Ny, Nz, U, V, Red, Green, Blue, ObjectId, ClassId, kSlots };

struct SlotName {
    std::string_view name;
    Slot slot;
};

/// Names of the properties that are read. If several fill one slot, the first in this list is used.
constexpr std::array<SlotName, 23> kSlotNames = {{{"x", X},
                                                  {"y", Y},
                                                  {"z", Z},
                                                  {"nx", Nx},
                                                  {"ny", Ny},
                                                  {"nz", Nz},
                                                  {"u", U},
                                                  {"s", U},
                                                  {"texture_u", U},
                                                  {"texture_s", U},
                                                  {"v", V},
                                                  {"t", V},
                                                  {"texture_v", V},
                                                  {"texture_t", V},
                                                  {"red", Red},
                                                  {"diffuse_red", Red},
                                                  {"r", Red},
                                                  {"green", Green},
                                                  {"diffuse_green", Green},
                                                  {"g", Green},
                                                  {"blue", Blue},
                                                  {"diffuse_blue", Blue},
                                                  {"b", Blue}}};

/// Names of label properties, in lower case and without CloudCompare's "scalar_". If several fill
/// one slot, the first in this list is used.
constexpr std::array<SlotName, 28> kLabelNames = {
    {{"object_id", ObjectId},  {"objectid", ObjectId},       {"obj_id", ObjectId},
     {"object", ObjectId},     {"instance_id", ObjectId},    {"instanceid", ObjectId},
     {"instance", ObjectId},   {"instance_label", ObjectId}, {"ins_label", ObjectId},
     {"ins_id", ObjectId},     {"inst_id", ObjectId},        {"nyu40", ClassId},
     {"nyu40_id", ClassId},    {"nyu40id", ClassId},         {"nyu_label", ClassId},
     {"label", ClassId},       {"labels", ClassId},          {"label_id", ClassId},
     {"category_id", ClassId}, {"class_id", ClassId},        {"semantic_id", ClassId},
     {"semantic", ClassId},    {"semantics", ClassId},       {"semantic_label", ClassId},
     {"sem_label", ClassId},   {"classid", ClassId},         {"class", ClassId},
     {"category", ClassId}}};

constexpr std::size_t kNowhere = -1;

std::string labelNameOf(const std::string& property) {
    const std::string small = inSmallLetters(property);
    constexpr std::string_view kScalar = "scalar_";
    return small.starts_with(kScalar) ? small.substr(kScalar.size()) : small;
}

/// The index of the property for each slot; kNowhere: none.
std::array<std::size_t, kSlots> slotsOf(const PlyElement& element) {
    std::array<std::size_t, kSlots> properties{};
    properties.fill(kNowhere);
    const auto fill = [&](const SlotName& row, const auto& nameOf) {
        if (properties[row.slot] != kNowhere) return;
        for (std::size_t p = 0; p < element.properties.size(); ++p) {
            const PlyProperty& property = element.properties[p];
            if (!property.count && nameOf(property.name) == row.name) properties[row.slot] = p;
        }
    };
    for (const SlotName& row : kSlotNames) fill(row, [](const std::string& name) { return name; });
    for (const SlotName& row : kLabelNames) fill(row, labelNameOf);
    return properties;
}

/// Whether an element's class numbers are NYU40's, by the name of their property.
bool classesAreNyu40(const PlyElement& element, const std::array<std::size_t, kSlots>& slots) {
    const std::size_t property = slots[ClassId];
    return property != kNowhere &&
           labelNameOf(element.properties[property].name).starts_with("nyu");
}

/// Records integer properties that fill no slot, except those that are known not to be labels.
void noteUnread(const PlyElement& element, const std::array<std::size_t, kSlots>& slots,
                std::vector<std::string>& unread) {
    constexpr std::array<std::string_view, 5> kNoLabels = {"alpha", "a", "flags", "quality",
                                                           "material_index"};
    for (std::size_t p = 0; p < element.properties.size(); ++p) {
        const PlyProperty& property = element.properties[p];
        const bool real = property.kind == PlyKind::Float || property.kind == PlyKind::Double;
        if (property.count || real || std::ranges::find(slots, p) != slots.end()) continue;
        if (std::ranges::find(kNoLabels, property.name) != kNoLabels.end()) continue;
        unread.push_back(cleanText(property.name) +
                         (element.name == "face" ? " of faces" : " of vertices"));
    }
}

float scaleOfColor(PlyKind kind) {
    if (kind == PlyKind::Float || kind == PlyKind::Double) return 1.0F;
    return kind == PlyKind::UInt16 ? 1.0F / 65535.0F : 1.0F / 255.0F;
}

/// An object or class number; -1 (unlabelled) if the value is not an integer.
std::int64_t idOf(double value) {
    constexpr double kMost = 1e15;
    const bool whole = value >= -kMost && value <= kMost && value == std::floor(value);
    return whole ? static_cast<std::int64_t>(value) : -1;
}

class PlyReader {
  public:
    PlyReader(std::string_view bytes, const std::filesystem::path& path)
        : bytes_(bytes), path_(path), numbers_({}, "") {}

    Result<PlyMesh> read() {
        const Result<PlyHeader> header = readPlyHeader(path_, bytes_);
        if (!header) return tl::unexpected(header.error());
        mesh_.texture = header->texture;
        if (header->by_blender) mesh_.up_axis = 'z';
        numbers_ = PlyNumbers(bytes_.substr(header->size), header->format);
        for (const PlyElement& element : header->elements) {
            if (element.count == 0) continue;
            // A record has at least one byte, which limits their number.
            if (element.properties.empty() || element.count > bytes_.size()) {
                return ends(element, 0);
            }
            const bool whole = element.name == "vertex"      ? readVertices(element)
                               : element.name == "face"      ? readFaces(element)
                               : element.name == "tristrips" ? readStrips(element)
                                                             : skip(element);
            if (!whole) return ends(element, at_);
        }
        splitCorners();
        return std::move(mesh_);
    }

  private:
    [[nodiscard]] tl::unexpected<Error> ends(const PlyElement& element, std::size_t at) const {
        return fail(ErrorCode::BadInput,
                    fmt::format("The file ends within {} {} of {}, or a value there is not a "
                                "number; export or download it again.",
                                element.name, at, element.count),
                    path_.string());
    }

    /// Reads a record; lists go to `lists`. Returns false at the end of the file.
    bool readRecord(const PlyElement& element) {
        values_.resize(element.properties.size());
        lists_.resize(element.properties.size());
        for (std::size_t p = 0; p < element.properties.size(); ++p) {
            const PlyProperty& property = element.properties[p];
            if (!property.count) {
                const auto value = numbers_.next(property.kind);
                if (!value) return false;
                values_[p] = *value;
                continue;
            }
            const auto count = numbers_.next(*property.count);
            // A number has at least one byte, which limits their number.
            if (!count || !(*count >= 0.0 && *count <= static_cast<double>(bytes_.size()))) {
                return false;
            }
            lists_[p].clear();
            for (std::size_t i = 0; i < static_cast<std::size_t>(*count); ++i) {
                const auto value = numbers_.next(property.kind);
                if (!value) return false;
                lists_[p].push_back(*value);
            }
        }
        return true;
    }

    bool skip(const PlyElement& element) {
        for (at_ = 0; at_ < element.count; ++at_) {
            if (!readRecord(element)) return false;
        }
        return true;
    }

    bool readVertices(const PlyElement& element) {
        const auto slots = slotsOf(element);
        const auto has = [&](Slot first, Slot last) {
            for (std::size_t s = first; s <= last; ++s) {
                if (slots[s] == kNowhere) return false;
            }
            return true;
        };
        const auto vector = [&](Slot first) {
            return Eigen::Vector3f(static_cast<float>(values_[slots[first]]),
                                   static_cast<float>(values_[slots[first + 1]]),
                                   static_cast<float>(values_[slots[first + 2]]));
        };
        if (!has(X, Z)) return skip(element);
        noteUnread(element, slots, mesh_.unread_numbers);
        mesh_.position_classes_are_nyu40 = classesAreNyu40(element, slots);
        const float color_scale =
            has(Red, Blue) ? scaleOfColor(element.properties[slots[Red]].kind) : 0.0F;
        for (at_ = 0; at_ < element.count; ++at_) {
            if (!readRecord(element)) return false;
            mesh_.positions.push_back(vector(X));
            if (has(Nx, Nz)) mesh_.normals.push_back(vector(Nx));
            if (has(U, V)) {
                mesh_.uvs.emplace_back(static_cast<float>(values_[slots[U]]),
                                       static_cast<float>(values_[slots[V]]), 0.0F);
            }
            if (color_scale > 0.0F) mesh_.colors.emplace_back(color_scale * vector(Red));
            if (has(ObjectId, ObjectId)) {
                mesh_.position_objects.push_back(idOf(values_[slots[ObjectId]]));
            }
            if (has(ClassId, ClassId)) {
                mesh_.position_classes.push_back(idOf(values_[slots[ClassId]]));
            }
        }
        return true;
    }

    static std::uint32_t indexOf(double value) {
        return value >= 0.0 && value < 4294967295.0 ? static_cast<std::uint32_t>(value)
                                                    : 0xFFFFFFFFU;
    }

    static std::size_t listNamed(const PlyElement& element, std::string_view name,
                                 std::string_view other) {
        for (std::size_t p = 0; p < element.properties.size(); ++p) {
            const PlyProperty& property = element.properties[p];
            if (property.count && (property.name == name || property.name == other)) return p;
        }
        return kNowhere;
    }

    bool readFaces(const PlyElement& element) {
        const auto slots = slotsOf(element);
        const std::size_t corners = listNamed(element, "vertex_indices", "vertex_index");
        const std::size_t places = listNamed(element, "texcoord", "texcoord");
        if (corners == kNowhere) return skip(element);
        noteUnread(element, slots, mesh_.unread_numbers);
        mesh_.face_classes_are_nyu40 = classesAreNyu40(element, slots);
        for (at_ = 0; at_ < element.count; ++at_) {
            if (!readRecord(element)) return false;
            const std::vector<double>& face = lists_[corners];
            mesh_.face_sizes.push_back(static_cast<std::uint32_t>(face.size()));
            for (const double index : face) mesh_.face_indices.push_back(indexOf(index));
            if (slots[ObjectId] != kNowhere) {
                mesh_.face_objects.push_back(idOf(values_[slots[ObjectId]]));
            }
            if (slots[ClassId] != kNowhere) {
                mesh_.face_classes.push_back(idOf(values_[slots[ClassId]]));
            }
            if (places == kNowhere) continue;
            const std::vector<double>& uvs = lists_[places];
            for (std::size_t i = 0; i < face.size(); ++i) {
                const bool there = 2 * i + 1 < uvs.size();
                corner_uvs_.emplace_back(there ? static_cast<float>(uvs[2 * i]) : 0.0F,
                                         there ? static_cast<float>(uvs[2 * i + 1]) : 0.0F, 0.0F);
            }
        }
        return true;
    }

    /// Reads triangle strips, which are separated by -1.
    bool readStrips(const PlyElement& element) {
        const std::size_t corners = listNamed(element, "vertex_indices", "vertex_index");
        if (corners == kNowhere) return skip(element);
        for (at_ = 0; at_ < element.count; ++at_) {
            if (!readRecord(element)) return false;
            std::size_t length = 0;
            const std::vector<double>& strip = lists_[corners];
            for (std::size_t i = 0; i < strip.size(); ++i) {
                length = strip[i] < 0.0 ? 0 : length + 1;
                if (length < 3) continue;
                const bool odd = length % 2 == 0;
                mesh_.face_sizes.push_back(3);
                for (const std::size_t back : odd ? std::array<std::size_t, 3>{1, 2, 0}
                                                  : std::array<std::size_t, 3>{2, 1, 0}) {
                    mesh_.face_indices.push_back(indexOf(strip[i - back]));
                }
            }
        }
        return true;
    }

    /// For texture coordinates per corner, makes each corner a position of its own.
    void splitCorners() {
        if (corner_uvs_.size() != mesh_.face_indices.size() || corner_uvs_.empty()) return;
        const auto spread = [&](auto& values) {
            if (values.empty()) return;
            auto old = std::move(values);
            values.clear();
            for (const std::uint32_t index : mesh_.face_indices) {
                values.push_back(old[std::min<std::size_t>(index, old.size() - 1)]);
            }
        };
        const std::size_t count = mesh_.positions.size();
        spread(mesh_.positions);
        spread(mesh_.normals);
        spread(mesh_.colors);
        spread(mesh_.position_objects);
        spread(mesh_.position_classes);
        mesh_.uvs = std::move(corner_uvs_);
        for (std::size_t i = 0; i < mesh_.face_indices.size(); ++i) {
            // Invalid indices stay invalid.
            const bool there = mesh_.face_indices[i] < count;
            mesh_.face_indices[i] = there ? static_cast<std::uint32_t>(i) : 0xFFFFFFFFU;
        }
    }

    std::string_view bytes_;
    const std::filesystem::path& path_;
    PlyNumbers numbers_;
    PlyMesh mesh_;
    std::vector<double> values_;
    std::vector<std::vector<double>> lists_;
    std::vector<Eigen::Vector3f> corner_uvs_;
    std::size_t at_ = 0;
};

}  // namespace

Result<PlyMesh> parsePlyMesh(std::string_view bytes, const std::filesystem::path& path) {
    return PlyReader(bytes, path).read();
}

std::vector<std::size_t> firstIndices(const PlyMesh& mesh) {
    std::vector<std::size_t> first(mesh.face_sizes.size());
    std::exclusive_scan(mesh.face_sizes.begin(), mesh.face_sizes.end(), first.begin(),
                        std::size_t{0});
    return first;
}

std::size_t addPlyPart(const PlyMesh& mesh, std::span<const std::size_t> faces,
                       std::span<const std::size_t> first_index, const std::string& name,
                       RawScene& scene) {
    std::unordered_map<std::uint32_t, std::uint32_t> renumbered;
    std::vector<std::uint32_t> used;
    std::vector<std::uint32_t> sizes;
    std::vector<std::uint32_t> indices;
    for (const std::size_t face : faces) {
        sizes.push_back(mesh.face_sizes[face]);
        for (std::size_t i = 0; i < mesh.face_sizes[face]; ++i) {
            const std::uint32_t index = mesh.face_indices[first_index[face] + i];
            if (index >= mesh.positions.size()) {
                indices.push_back(0xFFFFFFFFU);
                continue;
            }
            const auto [at, is_new] =
                renumbered.try_emplace(index, static_cast<std::uint32_t>(used.size()));
            if (is_new) used.push_back(index);
            indices.push_back(at->second);
        }
    }
    const auto take = [&](const std::vector<Eigen::Vector3f>& values) {
        std::vector<Eigen::Vector3f> taken;
        if (values.size() != mesh.positions.size()) return taken;
        taken.reserve(used.size());
        for (const std::uint32_t index : used) taken.push_back(values[index]);
        return taken;
    };

    const std::vector<Eigen::Vector3f> positions = take(mesh.positions);
    const std::vector<Eigen::Vector3f> normals = take(mesh.normals);
    const std::vector<Eigen::Vector3f> uvs = take(mesh.uvs);
    SourceMesh source{positions, normals, uvs, sizes, indices};
    Material material;
    std::optional<PaintedMesh> painted;
    if (!mesh.texture.empty() && !mesh.uvs.empty()) {
        if (scene.textures.empty()) {
            scene.textures.emplace_back();
            scene.textures.back().name = mesh.texture;
        }
        material.texture = 0;
        material.base_color.setOnes();
    } else if (const std::vector<Eigen::Vector3f> colors = take(mesh.colors); !colors.empty()) {
        painted = paintVertexColors(source, colors);
        if (painted) {
            material.texture = static_cast<int>(scene.textures.size());
            material.base_color.setOnes();
            scene.textures.push_back(std::move(painted->texture));
            source = painted->mesh(sizes);
        } else if (const Eigen::Vector3f& color = colors.front(); color.allFinite()) {
            for (int i = 0; i < 3; ++i) {
                material.base_color[i] = linearFromSrgb(std::clamp(color[i], 0.0F, 1.0F));
            }
        }
    }
    if (scene.nodes.empty()) scene.nodes.push_back({"", -1, 0});
    MeshPart part;
    part.node = static_cast<int>(scene.nodes.size());
    part.material = static_cast<std::uint32_t>(scene.materials.size());
    scene.nodes.push_back({name, 0, 0});
    ++scene.nodes.front().children;
    scene.materials.push_back(material);
    scene.repairs.add(buildMeshPart(source, Eigen::Affine3d::Identity(), part));
    scene.parts.push_back(std::move(part));
    return scene.parts.size() - 1;
}

RawScene sceneOfPly(const PlyMesh& mesh) {
    RawScene scene;
    scene.file_up_axis = mesh.up_axis;
    std::vector<std::size_t> faces(mesh.face_sizes.size());
    std::iota(faces.begin(), faces.end(), std::size_t{0});
    addPlyPart(mesh, faces, firstIndices(mesh), "", scene);
    return scene;
}

}  // namespace dollytrack
