#include "engine/io/import/oddity_notes.h"

#include "engine/core/text_lists.h"
#include "engine/scene/labels.h"
#include "engine/scene/mirror.h"
#include "engine/scene/storeys.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace dollytrack {
namespace {

constexpr int kMirror = 19;              // NYU40
constexpr double kInsideOut = -0.05;     // signed enclosed volume / box volume, if inside out
constexpr double kClosed = 1e-3;         // |sum of face normals| / area of a closed surface
constexpr double kTwoSided = 0.9;        // share of duplicate faces in a two-sided object
constexpr std::uint64_t kSampleOf = 16;  // in large objects every 16th face is compared
constexpr std::uint32_t kLarge = 4096;   // faces of a large object

Eigen::Vector3d corner(const Scene& scene, const Triangle& t, std::size_t i) {
    return scene.positions[t[i]].cast<double>();
}

/// Hash function: the finalizer of SplitMix64 (Steele, Lea and Flood 2014).
std::uint64_t mixed(std::uint64_t x) {
    x ^= x >> 30U;
    x *= 0xBF58476D1CE4E5B9U;
    x ^= x >> 27U;
    x *= 0x94D049BB133111EBU;
    return x ^ (x >> 31U);
}

/// Hash of a face's positions, independent of the order of its corners.
std::uint64_t faceKey(const Scene& scene, const Triangle& t) {
    std::uint64_t key = 0;
    for (const std::uint32_t v : t) {
        std::uint64_t one = 0;
        for (const float x : scene.positions[v])
            one = mixed(one + std::bit_cast<std::uint32_t>(x + 0.0F));
        key += one;
    }
    return mixed(key);
}

bool isTwoSided(const Scene& scene, const Object& object) {
    std::vector<std::uint64_t> keys;
    for (std::uint32_t i = 0; i < object.triangle_count; ++i) {
        const std::uint64_t key = faceKey(scene, scene.triangles[object.first_triangle + i]);
        if (object.triangle_count <= kLarge || key % kSampleOf == 0) keys.push_back(key);
    }
    std::sort(keys.begin(), keys.end());
    std::size_t twice = 0;
    for (std::size_t i = 0; i < keys.size(); ++i) {
        twice +=
            (i > 0 && keys[i] == keys[i - 1]) || (i + 1 < keys.size() && keys[i] == keys[i + 1]);
    }
    return twice > 0 && static_cast<double>(twice) >= kTwoSided * static_cast<double>(keys.size());
}

/// Whether a closed object's faces point inwards: the volume they enclose is then negative. Open
/// surfaces, such as scans from one side, are never inside out.
bool isInsideOut(const Scene& scene, const Object& object) {
    double volume = 0.0;
    double area = 0.0;
    Eigen::Vector3d facing = Eigen::Vector3d::Zero();
    for (std::uint32_t i = 0; i < object.triangle_count; ++i) {
        const Triangle& t = scene.triangles[object.first_triangle + i];
        const Eigen::Vector3d a = corner(scene, t, 0) - object.box.center;
        const Eigen::Vector3d b = corner(scene, t, 1) - object.box.center;
        const Eigen::Vector3d c = corner(scene, t, 2) - object.box.center;
        const Eigen::Vector3d across = (b - a).cross(c - a);
        volume += a.dot(b.cross(c)) / 6.0;
        area += across.norm();
        facing += across;
    }
    return facing.norm() < kClosed * area && volume < kInsideOut * object.box.volume();
}

}  // namespace

void noteOddities(const Scene& scene, ImportReport& report) {
    std::vector<double> storeys;
    for (const FloorLevel& floor : labelledFloors(scene)) storeys.push_back(floor.top_m);
    if (storeys.size() > 1) {
        report.notes.push_back(fmt::format("{} storeys, with floors at {:.2f} m", storeys.size(),
                                           fmt::join(storeys, ", ")));
    }
    std::size_t two_sided = 0;
    std::size_t inside_out = 0;
    std::size_t mirrors = 0;
    for (const Object& object : scene.objects) {
        if (object.nyu40 == kMirror && !hasMaterial(scene, object, isMirror)) ++mirrors;
        if (isTwoSided(scene, object)) {
            ++two_sided;
        } else if (!object.structure && isInsideOut(scene, object)) {
            ++inside_out;
        }
    }
    if (std::ranges::all_of(scene.objects, &Object::structure)) {
        report.notes.push_back(
            "all objects are parts of the building, so there are no targets; split them (operation "
            "split of 'dollytrack edit'), or use --set objective=surface");
    }
    if (two_sided > 0) {
        report.notes.push_back(counted(two_sided, "object has each face twice, once per side",
                                       "objects have each face twice, once per side"));
    }
    if (inside_out > 0) {
        report.notes.push_back(counted(
            inside_out, "object has faces that point inwards; both of their sides are rendered",
            "objects have faces that point inwards; both of their sides are rendered"));
    }
    if (mirrors > 0) {
        report.notes.push_back(counted(
            mirrors,
            "mirror is rendered without reflections, because its material is not reflective",
            "mirrors are rendered without reflections, because their materials are not "
            "reflective"));
    }
}

}  // namespace dollytrack
