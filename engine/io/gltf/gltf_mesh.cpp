#include "engine/io/gltf/gltf_mesh.h"

#include "engine/core/clean_text.h"
#include "engine/io/gltf/accessor.h"
#include "engine/io/gltf/draco_mesh.h"

#include <array>
#include <map>
#include <utility>

namespace dollytrack::gltf {
namespace {

constexpr std::size_t kTriangles = 4;
constexpr std::size_t kStrip = 5;
constexpr std::size_t kFan = 6;

/// The attributes of a primitive, compressed or not.
class Attributes {
  public:
    Attributes(const Document& document, const Json& primitive)
        : document_(document), list_(objectAt(primitive, "attributes")) {
        if (!list_.is_object()) throw damaged("a primitive has no attributes");
        const Json& packed = extensionOf(primitive, "KHR_draco_mesh_compression");
        if (packed.is_object()) draco_ = unpackDraco(document, packed, normalized());
    }

    [[nodiscard]] bool has(const char* name) const { return list_.contains(name); }

    [[nodiscard]] Elements read(const char* name) {
        if (draco_) {
            const auto found = draco_->attributes.find(name);
            if (found != draco_->attributes.end()) return std::move(found->second);
        }
        return readElements(document_, requireCount(list_, name));
    }

    /// Vectors of up to three components; z is 0 for two-component vectors.
    [[nodiscard]] std::vector<Eigen::Vector3f> readVectors(const char* name, std::size_t fewest) {
        const Elements elements = read(name);
        if (elements.components < fewest) {
            throw damaged(std::string(name) + " has too few components per vector");
        }
        std::vector<Eigen::Vector3f> vectors(elements.count, Eigen::Vector3f::Zero());
        const std::size_t kept = std::min<std::size_t>(elements.components, 3);
        for (std::size_t i = 0; i < elements.count; ++i) {
            for (std::size_t c = 0; c < kept; ++c) {
                vectors[i][static_cast<Eigen::Index>(c)] =
                    elements.values[i * elements.components + c];
            }
        }
        return vectors;
    }

    /// Vertex indices of Draco data, which have no index accessor; null without Draco.
    [[nodiscard]] const std::vector<std::uint32_t>* dracoIndices() const {
        return draco_ ? &draco_->indices : nullptr;
    }

  private:
    [[nodiscard]] std::map<std::string, bool> normalized() const {
        std::map<std::string, bool> flags;
        for (const auto& [name, accessor] : list_.items()) {
            const Json& flag = member(
                document_.entry("accessors", requireCount(list_, name.c_str())), "normalized");
            flags[name] = flag.is_boolean() && flag.get<bool>();
        }
        return flags;
    }

    const Document& document_;
    const Json& list_;
    std::optional<DracoMesh> draco_;
};

/// The vertex indices of the triangles in a list, strip or fan.
std::vector<std::uint32_t> asTriangles(std::size_t mode, std::vector<std::uint32_t> order) {
    if (mode == kTriangles) {
        order.resize(order.size() / 3 * 3);
        return order;
    }
    std::vector<std::uint32_t> triangles;
    for (std::size_t i = 2; i < order.size(); ++i) {
        // Every second triangle of a strip has its first two corners swapped, to face the same way.
        const std::size_t odd = i % 2;
        const std::array corners = {mode == kFan ? 0 : i - 2 + odd,
                                    mode == kFan ? i - 1 : i - 1 - odd, i};
        for (const std::size_t corner : corners) triangles.push_back(order[corner]);
    }
    return triangles;
}

/// Number of points or lines of a primitive with this number of vertices.
std::size_t linesOf(std::size_t mode, std::size_t vertices) {
    if (mode == 1) return vertices / 2;
    if (mode == 3) return vertices > 0 ? vertices - 1 : 0;
    return vertices;
}

/// Converts texture coordinates from glTF, where v points down, to v upwards, and applies their
/// transform.
void placePictures(const PictureCoordinates& coordinates, std::vector<Eigen::Vector3f>& uvs) {
    const bool moves = !(coordinates == PictureCoordinates{coordinates.set, {}}) &&
                       !coordinates.transform.isApprox(Eigen::Affine2d::Identity(), 0.0);
    for (Eigen::Vector3f& uv : uvs) {
        if (moves) {
            const Eigen::Vector2d at = uv.head<2>().cast<double>();
            uv.head<2>() = (coordinates.transform * at).cast<float>();
        }
        uv.y() = 1.0F - uv.y();
    }
}

Primitive readPrimitive(const Document& document, const Json& source,
                        const std::vector<PictureCoordinates>& coordinates) {
    Primitive primitive;
    const std::size_t material = countOr(source, "material", coordinates.size() - 1);
    if (material >= coordinates.size()) {
        throw damaged("materials[" + std::to_string(material) + "] is missing");
    }
    primitive.material = static_cast<std::uint32_t>(material);
    const std::size_t mode = countOr(source, "mode", kTriangles);
    Attributes attributes(document, source);
    if (mode > kFan || !attributes.has("POSITION")) return primitive;
    if (mode < kTriangles) {
        const auto indices = findCount(source, "indices");
        const std::size_t vertices = requireCount(
            document.entry(
                "accessors",
                indices ? *indices : requireCount(member(source, "attributes"), "POSITION")),
            "count");
        primitive.lines = linesOf(mode, vertices);
        return primitive;
    }
    primitive.positions = attributes.readVectors("POSITION", 3);
    const std::size_t count = primitive.positions.size();
    if (attributes.has("NORMAL")) primitive.normals = attributes.readVectors("NORMAL", 3);
    const PictureCoordinates& pictures = coordinates[material];
    const std::string set = "TEXCOORD_" + std::to_string(pictures.set);
    if (attributes.has(set.c_str())) primitive.uvs = attributes.readVectors(set.c_str(), 2);
    placePictures(pictures, primitive.uvs);
    if (attributes.has("COLOR_0")) {
        std::vector<Eigen::Vector3f> colors = attributes.readVectors("COLOR_0", 3);
        if (colors.size() == count) primitive.colors = std::move(colors);
    }
    if (primitive.normals.size() != count) primitive.normals.clear();
    if (primitive.uvs.size() != count) primitive.uvs.clear();

    if (const auto* packed = attributes.dracoIndices()) {
        primitive.indices = *packed;
        return primitive;
    }
    std::vector<std::uint32_t> order;
    if (const auto indices = findCount(source, "indices")) {
        order = readIndices(document, *indices);
    } else {
        order.resize(count);
        for (std::size_t i = 0; i < count; ++i) order[i] = static_cast<std::uint32_t>(i);
    }
    primitive.indices = asTriangles(mode, std::move(order));
    return primitive;
}

}  // namespace

std::vector<Primitive> readMesh(const Document& document, std::size_t mesh,
                                const std::vector<PictureCoordinates>& coordinates) {
    const Json& description = document.entry("meshes", mesh);
    std::string name = cleanText(textOr(description, "name"));
    if (name.empty()) name = "meshes[" + std::to_string(mesh) + "]";
    std::vector<Primitive> primitives;
    const auto& sources = listAt(description, "primitives");
    for (const Json& source : sources) {
        primitives.push_back(readPrimitive(document, source, coordinates));
        primitives.back().name =
            sources.size() == 1 ? name : name + "-" + std::to_string(primitives.size() - 1);
    }
    return primitives;
}

}  // namespace dollytrack::gltf
