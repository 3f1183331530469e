#include "engine/io/import/redundant_parts.h"

#include "engine/core/name_pattern.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <string_view>
#include <tuple>
#include <utility>

namespace dollytrack {
namespace {

enum class Proxy { No, Maybe, Yes };

/// A name in lower case without trailing numbers: "ucx_sofa" for "UCX_sofa_01".
std::string plainName(const std::string& name) {
    std::string plain = inSmallLetters(name);
    const std::size_t end = plain.find_last_not_of("0123456789_.- ");
    plain.resize(end == std::string::npos ? 0 : end + 1);
    return plain;
}

Proxy judge(const std::string& name) {
    static constexpr std::array<std::string_view, 6> kPrefixes = {"ucx_", "ubx_",      "usp_",
                                                                  "ucp_", "ctrl_hole", "hitbox"};
    static constexpr std::array<std::string_view, 7> kSuffixes = {
        "_collision", "_collider", "_colonly", "-colonly", "-convcolonly", "navmesh", "nav_mesh"};
    // These may also be real objects (a boat's hull), so they must coincide with another part.
    static constexpr std::array<std::string_view, 4> kDoubtful = {"_col", "_hull", "_physics",
                                                                  "trigger"};
    const std::string plain = plainName(name);
    const auto begins = [&](std::string_view part) { return plain.starts_with(part); };
    const auto ends = [&](std::string_view part) { return plain.ends_with(part); };
    if (plain == "collision" || plain == "collisions" || plain == "collider" ||
        plain == "colliders") {
        return Proxy::Yes;
    }
    if (std::any_of(kPrefixes.begin(), kPrefixes.end(), begins)) return Proxy::Yes;
    if (std::any_of(kSuffixes.begin(), kSuffixes.end(), ends)) return Proxy::Yes;
    return std::any_of(kDoubtful.begin(), kDoubtful.end(), ends) ? Proxy::Maybe : Proxy::No;
}

/// Intersection over union of two boxes.
float overlap(const Eigen::AlignedBox3f& a, const Eigen::AlignedBox3f& b) {
    const Eigen::Array3f flat = Eigen::Array3f::Constant(1e-3F * (a.sizes().norm() + 1e-9F));
    const auto volume = [&](const Eigen::AlignedBox3f& box) {
        return box.isEmpty() ? 0.0F : (box.sizes().array() + flat).prod();
    };
    const float common = volume(a.intersection(b));
    return common / std::max(1e-30F, volume(a) + volume(b) - common);
}

bool sameShape(const MeshPart& a, const MeshPart& b) {
    const auto same = [](const auto& one, const auto& other) {
        return one.size() == other.size() &&
               (one.empty() ||
                std::memcmp(one.data(), other.data(), one.size() * sizeof(one[0])) == 0);
    };
    return same(a.positions, b.positions) && same(a.triangles, b.triangles);
}

/// One of the faces that may coincide.
struct OrientedFace {
    std::array<std::array<float, 3>, 3> corners;  // in ascending order
    bool keeps_direction = true;  // whether the normal of the corners in that order is the face's
    std::size_t part = 0;
    std::size_t triangle = 0;
};

OrientedFace orientedFace(const MeshPart& mesh, std::size_t part, std::size_t triangle) {
    OrientedFace face;
    face.part = part;
    face.triangle = triangle;
    for (std::size_t i = 0; i < 3; ++i) {
        const Eigen::Vector3f& p = mesh.positions[mesh.triangles[triangle][i]];
        face.corners[i] = {p.x() + 0.0F, p.y() + 0.0F, p.z() + 0.0F};  // -0 becomes 0
    }
    const auto order = [&](std::size_t a, std::size_t b) {
        if (!(face.corners[b] < face.corners[a])) return;
        std::swap(face.corners[a], face.corners[b]);
        face.keeps_direction = !face.keeps_direction;
    };
    order(0, 1);
    order(1, 2);
    order(0, 1);
    return face;
}

/// The materials of coincident faces that face one way.
struct Materials {
    std::uint32_t first = 0;
    bool any = false;
    bool several = false;

    void add(std::uint32_t material) {
        several |= any && material != first;
        if (!any) first = material;
        any = true;
    }
    [[nodiscard]] bool hasOther(std::uint32_t material) const {
        return several || (any && first != material);
    }
};

/// The faces of a draft that coincide with one of another material that faces the other way.
std::vector<OrientedFace> findOpposedFaces(const ObjectDraft& draft,
                                           const std::vector<MeshPart>& parts) {
    Materials of_draft;
    for (const std::size_t part : draft.parts) of_draft.add(parts[part].material);
    if (!of_draft.several) return {};
    std::vector<OrientedFace> faces;
    for (const std::size_t part : draft.parts) {
        for (std::size_t i = 0; i < parts[part].triangles.size(); ++i) {
            faces.push_back(orientedFace(parts[part], part, i));
        }
    }
    std::ranges::sort(faces, {}, [](const OrientedFace& face) {
        return std::tie(face.corners, face.part, face.triangle);
    });
    std::vector<OrientedFace> opposed;
    for (std::size_t first = 0, end = 0; first < faces.size(); first = end) {
        std::array<Materials, 2> facing;  // by keeps_direction
        for (; end < faces.size() && faces[end].corners == faces[first].corners; ++end) {
            facing[faces[end].keeps_direction ? 1 : 0].add(parts[faces[end].part].material);
        }
        for (std::size_t i = first; i < end; ++i) {
            const Materials& others = facing[faces[i].keeps_direction ? 0 : 1];
            if (others.hasOther(parts[faces[i].part].material)) opposed.push_back(faces[i]);
        }
    }
    return opposed;
}

}  // namespace

void emptyPart(MeshPart& part) {
    MeshPart nothing;
    nothing.name = part.name;
    nothing.node = part.node;
    part = std::move(nothing);
}

std::vector<std::string> dropProxies(RawScene& raw) {
    // All nodes below "Colliders" are collision meshes, whatever their names.
    std::vector<Proxy> by_node;
    for (const SourceNode& node : raw.nodes) {
        const bool inherits = node.parent > 0 && by_node[node.parent] == Proxy::Yes;
        by_node.push_back(inherits ? Proxy::Yes : judge(node.name));
    }
    std::vector<Proxy> verdicts;
    for (const MeshPart& part : raw.parts) {
        const Proxy node = by_node[part.node];
        verdicts.push_back(node == Proxy::No ? judge(part.name) : node);
    }
    Eigen::AlignedBox3f whole;
    for (std::size_t i = 0; i < raw.parts.size(); ++i) {
        if (verdicts[i] == Proxy::No) whole.extend(raw.parts[i].bounds);
    }
    for (std::size_t i = 0; i < raw.parts.size(); ++i) {
        if (verdicts[i] != Proxy::Maybe) continue;
        bool about_another = overlap(raw.parts[i].bounds, whole) > 0.3F;
        for (std::size_t j = 0; j < raw.parts.size() && !about_another; ++j) {
            about_another = verdicts[j] == Proxy::No && !raw.parts[j].triangles.empty() &&
                            overlap(raw.parts[i].bounds, raw.parts[j].bounds) > 0.3F;
        }
        if (about_another) verdicts[i] = Proxy::Yes;
    }
    bool any_left = false;
    for (std::size_t i = 0; i < raw.parts.size(); ++i) {
        any_left |= verdicts[i] != Proxy::Yes && !raw.parts[i].triangles.empty();
    }
    std::vector<std::string> names;
    for (std::size_t i = 0; i < raw.parts.size() && any_left; ++i) {
        if (verdicts[i] != Proxy::Yes || raw.parts[i].triangles.empty()) continue;
        const std::string& node = raw.nodes[raw.parts[i].node].name;
        names.push_back(node.empty() ? raw.parts[i].name : node);
        emptyPart(raw.parts[i]);
    }
    return names;
}

std::size_t dropDuplicates(RawScene& raw) {
    std::map<std::array<float, 7>, std::vector<std::size_t>> alike;
    std::size_t dropped = 0;
    for (std::size_t i = 0; i < raw.parts.size(); ++i) {
        MeshPart& part = raw.parts[i];
        if (part.triangles.empty()) continue;
        const Eigen::Vector3f low = part.bounds.min();
        const Eigen::Vector3f high = part.bounds.max();
        auto& same = alike[{low.x(), low.y(), low.z(), high.x(), high.y(), high.z(),
                            static_cast<float>(part.triangles.size())}];
        const bool again = std::any_of(
            same.begin(), same.end(), [&](std::size_t j) { return sameShape(raw.parts[j], part); });
        if (!again) {
            same.push_back(i);
            continue;
        }
        ++dropped;
        emptyPart(part);
    }
    return dropped;
}

std::size_t separateSides(const std::vector<ObjectDraft>& drafts, std::vector<MeshPart>& parts) {
    constexpr float kShift_m = 2.5e-4F;
    std::size_t separated = 0;
    for (const ObjectDraft& draft : drafts) {
        const std::vector<OrientedFace> faces = findOpposedFaces(draft, parts);
        if (!faces.empty()) ++separated;
        std::map<std::pair<std::size_t, std::uint32_t>, Eigen::Vector3f> facing;  // by vertex
        for (const OrientedFace& face : faces) {
            const MeshPart& part = parts[face.part];
            const Triangle& t = part.triangles[face.triangle];
            const Eigen::Vector3f& a = part.positions[t[0]];
            const Eigen::Vector3f across =
                (part.positions[t[1]] - a).cross(part.positions[t[2]] - a);
            for (const std::uint32_t vertex : t) {
                facing.try_emplace({face.part, vertex}, Eigen::Vector3f::Zero()).first->second +=
                    across;
            }
        }
        for (const auto& [vertex, direction] : facing) {
            MeshPart& part = parts[vertex.first];
            Eigen::Vector3f& position = part.positions[vertex.second];
            position += kShift_m * direction.stableNormalized();
            part.bounds.extend(position);
        }
    }
    return separated;
}

}  // namespace dollytrack
