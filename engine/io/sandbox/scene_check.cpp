#include "engine/io/sandbox/scene_check.h"

#include "engine/core/clean_text.h"
#include "engine/io/raw_scene/mesh_part_builder.h"
#include "engine/jobs/parallel.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace dollytrack {
namespace {

constexpr std::int64_t kMostPixels = std::int64_t{1} << 26;
constexpr int kMostClasses = 40;
constexpr double kLongestFront = 1e6;  // not yet a unit vector; NaN compares false

tl::unexpected<Error> wrong(std::string message) {
    return fail(ErrorCode::BadInput, std::move(message));
}

template <class Vector>
bool allFinite(const std::vector<Vector>& values) {
    // The sum of value * 0 is NaN if any value is not finite; this test has no branches and is
    // fast.
    float sum = 0.0F;
    for (const Vector& value : values) sum += (value * 0.0F).sum();
    return sum == 0.0F;
}

bool soundPart(const MeshPart& part, const RawScene& raw) {
    if (part.node < 0 || static_cast<std::size_t>(part.node) >= raw.nodes.size()) return false;
    if (part.material >= raw.materials.size()) return false;
    const std::size_t count = part.positions.size();
    if (part.normals.size() != count || part.uvs.size() != count) return false;
    std::uint32_t highest = 0;
    for (const Triangle& triangle : part.triangles) {
        highest = std::max({highest, triangle[0], triangle[1], triangle[2]});
    }
    if (!part.triangles.empty() && highest >= count) return false;
    if (!allFinite(part.positions) || !allFinite(part.normals) || !allFinite(part.uvs)) {
        return false;
    }
    return std::all_of(part.normals.begin(), part.normals.end(),
                       [](const Eigen::Vector3f& normal) { return normal.squaredNorm() < 1.1F; });
}

bool withinReach(const Eigen::AlignedBox3f& box) {
    return box.isEmpty() ||
           (box.min().minCoeff() >= -kFarthest && box.max().maxCoeff() <= kFarthest);
}

bool within(float value, float most) {
    return value >= 0.0F && value <= most;  // false for NaN
}

bool soundMaterial(const Material& material, std::size_t textures) {
    constexpr float kBrightest = 1e6F;
    constexpr float kSteepestMap = 10.0F;
    const auto color = [](const Eigen::Vector3f& c, float most) {
        return within(c.x(), most) && within(c.y(), most) && within(c.z(), most);
    };
    bool sound_indices = true;
    visitTextures(material, [&](int index) {
        sound_indices = sound_indices && index >= -1 && index < static_cast<std::int64_t>(textures);
    });
    return color(material.base_color, 1.0F) && color(material.emission, kBrightest) &&
           within(material.opacity, 1.0F) && within(material.metallic, 1.0F) &&
           within(material.roughness, 1.0F) && within(material.normal_scale, kSteepestMap) &&
           sound_indices;
}

bool soundTexture(const Texture& texture) {
    if (texture.width == 0 && texture.height == 0) return texture.rgba.empty();
    if (texture.width <= 0 || texture.height <= 0) return false;
    const std::int64_t pixels = std::int64_t{texture.width} * texture.height;
    return pixels <= kMostPixels && texture.rgba.size() == static_cast<std::size_t>(4 * pixels);
}

Status checkNodes(RawScene& raw) {
    std::vector<int> children(raw.nodes.size(), 0);
    for (std::size_t i = 0; i < raw.nodes.size(); ++i) {
        SourceNode& node = raw.nodes[i];
        if (node.parent < -1 || node.parent >= static_cast<std::int64_t>(i)) {
            return wrong("node " + std::to_string(i) + " does not come after its parent");
        }
        if (node.parent >= 0) ++children[node.parent];
        node.name = cleanText(node.name);
    }
    for (std::size_t i = 0; i < raw.nodes.size(); ++i) raw.nodes[i].children = children[i];
    return {};
}

Status checkParts(RawScene& raw) {
    constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
    std::atomic<std::size_t> bad = kNone;
    std::uint64_t vertices = 0;
    std::uint64_t triangles = 0;
    for (const MeshPart& part : raw.parts) {
        vertices += part.positions.size();
        triangles += part.triangles.size();
    }
    constexpr std::uint64_t kMost = std::numeric_limits<std::uint32_t>::max();
    if (vertices > kMost || triangles > kMost) return wrong("there are too many triangles");
    parallelFor(raw.parts.size(), [&](std::size_t i) {
        MeshPart& part = raw.parts[i];
        const bool sound = soundPart(part, raw);
        if (sound) measurePart(part);
        if (!sound || !withinReach(part.bounds)) {
            std::size_t first = bad;
            while (i < first && !bad.compare_exchange_weak(first, i)) {
            }
            return;
        }
        part.name = cleanText(part.name);
    });
    if (bad != kNone) return wrong("mesh " + std::to_string(bad) + " is not whole");
    return {};
}

Status checkObjects(RawScene& raw) {
    std::vector<bool> taken(raw.parts.size(), false);
    for (SourceObject& object : raw.objects) {
        const bool front_is_sound = !object.front || object.front->norm() < kLongestFront;
        if (object.nyu40 < 0 || object.nyu40 > kMostClasses || !front_is_sound) {
            return wrong("an object's class or front is invalid");
        }
        for (const std::size_t part : object.parts) {
            if (part >= taken.size() || taken[part])
                return wrong("an object's mesh does not exist or is used twice");
            taken[part] = true;
        }
        object.name = cleanText(object.name);
        object.category = cleanText(object.category);
    }
    return {};
}

Status checkTextures(DecodedScene& scene) {
    TextureSet& set = scene.textures;
    const std::size_t asked = scene.raw.textures.size();
    const bool counted = set.found >= 0 && set.missing.size() + set.broken.size() +
                                                   static_cast<std::size_t>(set.found) ==
                                               set.textures.size();
    // An empty list is valid: textures were not requested.
    if (!counted || (set.textures.size() != asked && !set.textures.empty())) {
        return wrong("the textures are not the requested ones");
    }
    for (Texture& texture : set.textures) {
        if (!soundTexture(texture)) return wrong("a texture is incomplete");
        texture.name = cleanText(texture.name);
    }
    for (TextureRequest& request : scene.raw.textures) request.name = cleanText(request.name);
    for (std::string& name : set.missing) name = cleanText(name);
    for (std::string& name : set.broken) name = cleanText(name);
    return {};
}

}  // namespace

Status checkScene(DecodedScene& scene) {
    RawScene& raw = scene.raw;
    if (raw.file_unit_m && !(*raw.file_unit_m > 0.0 && *raw.file_unit_m < 1e9)) {
        return wrong("the file's unit is not a valid length");
    }
    if (raw.file_up_axis.letter != 0 && !raw.file_up_axis.isAxis()) {
        return wrong("the file's upward axis is not an axis");
    }
    const double volume = std::abs(raw.file_from_parts.linear().determinant());
    if (!raw.file_from_parts.matrix().allFinite() || !(volume > 0.0 && volume < HUGE_VAL)) {
        return wrong("the transform to the file's axes is not invertible");
    }
    for (Material& material : raw.materials) {
        if (!soundMaterial(material, raw.textures.size())) {
            return wrong("a material's value is out of range");
        }
        material.name = cleanText(material.name);
    }
    for (std::string& note : raw.notes) note = cleanText(note);
    for (std::string& warning : raw.warnings) warning = cleanText(warning);
    for (Status (*check)(RawScene&) : {checkNodes, checkParts, checkObjects}) {
        if (Status status = check(raw); !status) return status;
    }
    return checkTextures(scene);
}

}  // namespace dollytrack
