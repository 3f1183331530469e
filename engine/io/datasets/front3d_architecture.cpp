#include "engine/io/datasets/front3d_architecture.h"

#include "engine/core/object_names.h"
#include "engine/core/text_lists.h"
#include "engine/io/datasets/front3d_materials.h"
#include "engine/io/files/bounded_json.h"
#include "engine/io/raw_scene/mesh_part_builder.h"
#include "engine/scene/labels.h"

#include <limits>
#include <map>
#include <numeric>
#include <string>

namespace dollytrack {
namespace {

using nlohmann::json;

constexpr float kTouching_m = 0.05F;
constexpr std::size_t kMostPieces = 4000;  // compared with each other

/// Reads two or three numbers per vertex. Invalid values become NaN, which later steps handle.
std::vector<Eigen::Vector3f> vectorsIn(const json& mesh, const char* key, std::size_t width) {
    const json::array_t& list = listIn(mesh, key);
    std::vector<Eigen::Vector3f> vectors(list.size() / width, Eigen::Vector3f::Zero());
    for (std::size_t i = 0; i < vectors.size(); ++i) {
        for (std::size_t k = 0; k < width; ++k) {
            const double value =
                numberIn(list[width * i + k]).value_or(std::numeric_limits<double>::quiet_NaN());
            vectors[i][static_cast<Eigen::Index>(k)] = static_cast<float>(value);
        }
    }
    return vectors;
}

std::vector<std::uint32_t> facesIn(const json& mesh) {
    const json::array_t& list = listIn(mesh, "faces");
    std::vector<std::uint32_t> indices(3 * (list.size() / 3));
    for (std::size_t i = 0; i < indices.size(); ++i) {
        const double value = numberIn(list[i]).value_or(-1.0);
        const bool fits = value >= 0.0 && value < 4e9;
        indices[i] =
            fits ? static_cast<std::uint32_t>(value) : std::numeric_limits<std::uint32_t>::max();
    }
    return indices;
}

/// Whether the normals are valid; many scenes contain positions in their place.
bool areNormals(const std::vector<Eigen::Vector3f>& normals) {
    for (const Eigen::Vector3f& normal : normals) {
        if (!(std::abs(normal.norm() - 1.0F) < 0.02F)) return false;
    }
    return !normals.empty();
}

/// A future object: meshes of one type that belong together.
struct Piece {
    std::string type;
    Label label;
    std::vector<std::size_t> parts;
    Eigen::AlignedBox3f bounds;

    [[nodiscard]] bool isStructure() const { return label.kind != LabelKind::Target; }
};

class Architecture {
  public:
    Architecture(const json& document, const LabelTable& labels,
                 const std::vector<std::filesystem::path>& folders, RawScene& scene)
        : labels_(labels), materials_(document, folders, scene), scene_(scene) {
        scene_.nodes.push_back({"architecture", 0, 0});
        node_ = static_cast<int>(scene_.nodes.size()) - 1;
        ++scene_.nodes.front().children;
    }

    void add(const json& mesh) {
        const std::vector<Eigen::Vector3f> positions = vectorsIn(mesh, "xyz", 3);
        std::vector<Eigen::Vector3f> normals = vectorsIn(mesh, "normal", 3);
        std::vector<Eigen::Vector3f> uvs = vectorsIn(mesh, "uv", 2);
        const std::vector<std::uint32_t> indices = facesIn(mesh);
        const std::vector<std::uint32_t> sizes(indices.size() / 3, 3);
        if (!normals.empty() && !areNormals(normals)) {
            ++bad_normals_;
            normals.clear();
        }
        MeshPart part;
        part.name = textIn(mesh, "uid");
        part.node = node_;
        part.material = materials_.indexOf(textIn(mesh, "material"), uvs);
        scene_.repairs.add(buildMeshPart({positions, normals, uvs, sizes, indices},
                                         Eigen::Affine3d::Identity(), part));
        if (part.triangles.empty()) {
            ++empty_;
            return;
        }
        Piece& piece = pieceOf(mesh, textIn(mesh, "uid"));
        piece.bounds.extend(part.bounds);
        piece.parts.push_back(scene_.parts.size());
        scene_.parts.push_back(std::move(part));
    }

    void finish() {
        joinTouching();
        ObjectNames names;
        for (const Piece& piece : pieces_) {
            if (piece.parts.empty()) continue;
            SourceObject object;
            object.name = names.next(piece.type);
            object.category = piece.type;
            object.nyu40 = piece.label.nyu40 != 0 ? piece.label.nyu40 : kNyuOtherStructure;
            object.structure = piece.isStructure();
            object.parts = piece.parts;
            scene_.objects.push_back(std::move(object));
        }
        if (bad_normals_ > 0) {
            scene_.notes.push_back(counted(bad_normals_, "mesh has", "meshes have") +
                                   " invalid normals; they were recomputed");
        }
        if (empty_ > 0) {
            scene_.notes.push_back(counted(empty_, "mesh", "meshes") +
                                   " without a drawable triangle were left out");
        }
        if (joined_ > 0) {
            scene_.notes.push_back(counted(joined_, "built-in piece was", "built-in pieces were") +
                                   " merged with the objects that they touch");
        }
    }

  private:
    Piece& pieceOf(const json& mesh, const std::string& uid) {
        std::string type = textIn(mesh, "type");
        if (type.empty()) type = "architecture";
        const auto slash = uid.rfind('/');
        if (slash != std::string::npos) {
            const auto [at, is_new] =
                owners_.try_emplace(type + " " + uid.substr(0, slash), pieces_.size());
            if (!is_new) return pieces_[at->second];
        }
        pieces_.push_back({type, labels_.find(type), {}, {}});
        return pieces_.back();
    }

    void joinTouching() {
        std::vector<std::size_t> built_in;
        for (std::size_t i = 0; i < pieces_.size(); ++i) {
            if (!pieces_[i].isStructure()) built_in.push_back(i);
        }
        if (built_in.size() > kMostPieces) return;
        for (bool changed = true; changed;) {
            changed = false;
            for (std::size_t a = 0; a < built_in.size(); ++a) {
                for (std::size_t b = built_in.size(); b-- > a + 1;) {
                    if (!join(pieces_[built_in[a]], pieces_[built_in[b]])) continue;
                    built_in.erase(built_in.begin() + static_cast<std::ptrdiff_t>(b));
                    changed = true;
                }
            }
        }
    }

    bool join(Piece& into, Piece& from) {
        if (into.label.nyu40 != from.label.nyu40) return false;
        const Eigen::Vector3f gap = Eigen::Vector3f::Constant(kTouching_m);
        const Eigen::AlignedBox3f wide(into.bounds.min() - gap, into.bounds.max() + gap);
        if (!wide.intersects(from.bounds)) return false;
        into.parts.insert(into.parts.end(), from.parts.begin(), from.parts.end());
        into.bounds.extend(from.bounds);
        from.parts.clear();
        ++joined_;
        return true;
    }

    const LabelTable& labels_;
    Front3dMaterials materials_;
    RawScene& scene_;
    int node_ = 0;
    std::vector<Piece> pieces_;
    std::map<std::string, std::size_t> owners_;
    std::size_t bad_normals_ = 0;
    std::size_t empty_ = 0;
    std::size_t joined_ = 0;
};

}  // namespace

void addFront3dArchitecture(const json& document, const LabelTable& labels,
                            const std::vector<std::filesystem::path>& texture_folders,
                            RawScene& scene) {
    Architecture architecture(document, labels, texture_folders, scene);
    for (const json& mesh : listIn(document, "mesh")) {
        if (mesh.is_object()) architecture.add(mesh);
    }
    architecture.finish();
}

}  // namespace dollytrack
