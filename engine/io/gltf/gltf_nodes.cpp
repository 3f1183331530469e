#include "engine/io/gltf/gltf_nodes.h"

#include "engine/core/clean_text.h"
#include "engine/core/text_lists.h"
#include "engine/io/gltf/accessor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

namespace dollytrack::gltf {
namespace {

constexpr int kDeepest = 1000;
/// Limit for a file, because instances may take no bytes of the file.
constexpr std::size_t kMostInstances = std::size_t{1} << 16U;

/// The rotation matrix of a quaternion x, y, z, w, which is normalised if its length clearly
/// differs from 1.
Eigen::Matrix3f rotationOf(Eigen::Vector4f q) {
    constexpr float kRounding = 1e-3F;
    const float length = q.norm();
    if (!(length > 0.0F)) return Eigen::Matrix3f::Identity();
    if (std::abs(length - 1.0F) > kRounding) q /= length;
    const float x = q.x();
    const float y = q.y();
    const float z = q.z();
    const float w = q.w();
    Eigen::Matrix3f rotation;
    rotation << 1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w),  //
        2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w),          //
        2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y);
    return rotation;
}

/// In single precision, as in the file, so that equal scenes give bit-identical results.
Eigen::Affine3d placed(const Eigen::Vector3f& translation, const Eigen::Vector4f& rotation,
                       const Eigen::Vector3f& scale) {
    Eigen::Affine3d transform = Eigen::Affine3d::Identity();
    const Eigen::Matrix3f linear = rotationOf(rotation) * scale.asDiagonal();
    transform.linear() = linear.cast<double>();
    transform.translation() = translation.cast<double>();
    return transform;
}

Eigen::Affine3d transformOf(const Json& node) {
    if (node.contains("matrix")) {
        Eigen::Matrix4f matrix = Eigen::Matrix4f::Identity();
        readNumbers(node, "matrix", matrix);  // both are column-major
        Eigen::Affine3d transform = Eigen::Affine3d::Identity();
        transform.matrix().topRows<3>() = matrix.topRows<3>().cast<double>();
        return transform;
    }
    Eigen::Vector3f translation = Eigen::Vector3f::Zero();
    Eigen::Vector4f rotation = Eigen::Vector4f::UnitW();
    Eigen::Vector3f scale = Eigen::Vector3f::Ones();
    readNumbers(node, "translation", translation);
    readNumbers(node, "rotation", rotation);
    readNumbers(node, "scale", scale);
    return placed(translation, rotation, scale);
}

void checkInstances(std::size_t count) {
    if (count <= kMostInstances) return;
    throw Fault(fmt::format("it contains more than {} mesh instances; split it into several files",
                            kMostInstances));
}

/// The transforms of a node's instances.
std::vector<Eigen::Affine3d> instancesOf(const Document& document, const Json& instancing) {
    const Json& attributes = objectAt(instancing, "attributes");
    std::optional<std::size_t> count;
    const auto read = [&](const char* name, std::size_t components) {
        const auto accessor = findCount(attributes, name);
        if (!accessor) return Elements{};
        Elements elements = readElements(document, *accessor);
        if (elements.components != components || (count && *count != elements.count)) {
            throw damaged(std::string(name) +
                          " has another number of elements than the other instance attributes");
        }
        count = elements.count;
        return elements;
    };
    const Elements translations = read("TRANSLATION", 3);
    const Elements rotations = read("ROTATION", 4);
    const Elements scales = read("SCALE", 3);
    checkInstances(count.value_or(0));
    std::vector<Eigen::Affine3d> instances;
    instances.reserve(count.value_or(0));
    for (std::size_t i = 0; i < count.value_or(0); ++i) {
        Eigen::Vector3f translation = Eigen::Vector3f::Zero();
        Eigen::Vector4f rotation = Eigen::Vector4f::UnitW();
        Eigen::Vector3f scale = Eigen::Vector3f::Ones();
        if (translations.count > 0) {
            translation = Eigen::Map<const Eigen::Vector3f>(translations.values.data() + 3 * i);
        }
        if (rotations.count > 0) {
            rotation = Eigen::Map<const Eigen::Vector4f>(rotations.values.data() + 4 * i);
        }
        if (scales.count > 0) {
            scale = Eigen::Map<const Eigen::Vector3f>(scales.values.data() + 3 * i);
        }
        instances.push_back(placed(translation, rotation, scale));
    }
    return instances;
}

/// The root nodes: those of the default scene, or without scenes all nodes that are not children.
std::vector<std::size_t> rootsOf(const Document& document) {
    std::vector<std::size_t> roots;
    const auto add = [&](const Json::array_t& list) {
        for (const Json& node : list) {
            if (!node.is_number_unsigned())
                throw damaged("a list of nodes contains an entry that is not a number");
            roots.push_back(node.get<std::size_t>());
        }
    };
    if (document.size("scenes") > 0) {
        add(listAt(document.entry("scenes", countOr(document.json(), "scene", 0)), "nodes"));
        return roots;
    }
    for (std::size_t i = 0; i < document.size("nodes"); ++i) {
        add(listAt(document.entry("nodes", i), "children"));
    }
    std::vector<bool> held(document.size("nodes"), false);
    for (const std::size_t child : roots) {
        if (child < held.size()) held[child] = true;
    }
    roots.clear();
    for (std::size_t i = 0; i < held.size(); ++i) {
        if (!held[i]) roots.push_back(i);
    }
    return roots;
}

class NodeWalk {
  public:
    NodeWalk(const Document& document, RawScene& raw)
        : document_(document),
          raw_(raw),
          seen_(document.size("nodes"), false),
          quantized_(usesQuantization(document)) {}

    std::vector<MeshPlacement> walk() {
        const std::vector<std::size_t> roots = rootsOf(document_);
        int parent = -1;
        if (roots.size() != 1) parent = addNode("ROOT", -1);
        push(roots, parent, Eigen::Affine3d::Identity(), 0);
        while (!stack_.empty()) {
            const Visit visit = stack_.back();
            stack_.pop_back();
            enter(visit);
        }
        if (placements_.empty()) {
            throw Fault(
                "no node of its scene has a mesh; export the scene together with its "
                "meshes");
        }
        if (skinned_ > 0) {
            raw_.warnings.push_back(
                counted(skinned_,
                        "mesh is deformed by a skeleton, which is not read; it is shown in its "
                        "rest pose",
                        "meshes are deformed by skeletons, which are not read; they are shown in "
                        "their rest pose"));
        }
        return std::move(placements_);
    }

  private:
    struct Visit {
        std::size_t node;
        int parent;
        Eigen::Affine3d source_from_parent;
        int depth;
    };

    static bool usesQuantization(const Document& document) {
        const auto& used = listAt(document.json(), "extensionsUsed");
        return std::ranges::find(used, Json("KHR_mesh_quantization")) != used.end();
    }

    template <class List>
    void push(const List& children, int parent, const Eigen::Affine3d& here, int depth) {
        if (depth > kDeepest) throw damaged("its nodes are nested too deep");
        for (auto child = children.rbegin(); child != children.rend(); ++child) {
            stack_.push_back({numberOf(*child), parent, here, depth});
        }
    }

    static std::size_t numberOf(std::size_t node) { return node; }
    static std::size_t numberOf(const Json& node) {
        if (!node.is_number_unsigned())
            throw damaged("a list of nodes contains an entry that is not a number");
        return node.get<std::size_t>();
    }

    int addNode(std::string name, int parent) {
        raw_.nodes.push_back({std::move(name), parent, 0});
        holds_quantized_.push_back(false);
        if (parent >= 0) ++raw_.nodes[parent].children;
        return static_cast<int>(raw_.nodes.size()) - 1;
    }

    void enter(const Visit& visit) {
        const Json& node = document_.entry("nodes", visit.node);
        if (seen_[visit.node]) {
            throw damaged(fmt::format("nodes[{}] occurs twice in the scene", visit.node));
        }
        seen_[visit.node] = true;
        const Eigen::Affine3d here = visit.source_from_parent * transformOf(node);
        const auto& children = listAt(node, "children");
        const auto mesh = findCount(node, "mesh");
        if (mesh && node.contains("skin")) ++skinned_;
        std::string name = cleanText(textOr(node, "name"));
        // Quantizers insert a node between an object's node and its mesh, which undoes the scaling
        // of integers.
        if (mesh && name.empty() && children.empty() && visit.parent >= 0 &&
            holds_quantized_[visit.parent]) {
            return place(*mesh, visit.parent, here);
        }
        const bool is_named = !name.empty();
        if (!is_named) name = fmt::format("nodes[{}]", visit.node);
        const int index = addNode(name, visit.parent);
        holds_quantized_.back() = quantized_ && is_named && !mesh;
        const Json& instancing = extensionOf(node, "EXT_mesh_gpu_instancing");
        if (mesh && instancing.is_object()) {
            placeInstances(*mesh, index, is_named ? name : meshName(*mesh, name),
                           instancesOf(document_, instancing), here);
        } else if (mesh) {
            place(*mesh, index, here);
        }
        push(children, index, here, visit.depth + 1);
    }

    [[nodiscard]] std::string meshName(std::size_t mesh, const std::string& otherwise) const {
        const std::string name = cleanText(textOr(document_.entry("meshes", mesh), "name"));
        return name.empty() ? otherwise : name;
    }

    /// Adds instances as siblings of the node, because its children would be parts of one object.
    void placeInstances(std::size_t mesh, int node, const std::string& name,
                        const std::vector<Eigen::Affine3d>& instances,
                        const Eigen::Affine3d& here) {
        instances_ += instances.size();
        checkInstances(instances_);
        const int parent = std::max(raw_.nodes[node].parent, 0);
        for (std::size_t i = 0; i < instances.size(); ++i) {
            place(mesh, addNode(fmt::format("{}_{}", name, i + 1), parent), here * instances[i]);
        }
    }

    void place(std::size_t mesh, int node, const Eigen::Affine3d& here) {
        placements_.push_back({mesh, node, here});
    }

    const Document& document_;
    RawScene& raw_;
    std::vector<bool> seen_;
    bool quantized_;
    std::vector<bool> holds_quantized_;  // by raw node: takes nameless children's meshes
    std::size_t instances_ = 0;
    std::size_t skinned_ = 0;  // nodes whose mesh a skeleton deforms
    std::vector<Visit> stack_;
    std::vector<MeshPlacement> placements_;
};

}  // namespace

std::vector<MeshPlacement> placeMeshes(const Document& document, RawScene& raw) {
    return NodeWalk(document, raw).walk();
}

}  // namespace dollytrack::gltf
