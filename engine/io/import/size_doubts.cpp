#include "engine/io/import/size_doubts.h"

#include "engine/io/import/import_notes.h"
#include "engine/scene/furniture_sizes.h"
#include "engine/scene/labels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace dollytrack {
namespace {

constexpr std::size_t kLeastSplit = 30;      // targets; fewer prove nothing
constexpr std::size_t kMostCompared = 5000;  // targets; each is compared with each
constexpr double kMostlySingle = 0.8;        // share of the targets that have one material each
constexpr double kMostlyInside =
    0.5;  // share of all targets that have a single material and lie inside another target

Eigen::AlignedBox3d uprightBoundsOf(const Scene& scene, const Object& object) {
    Eigen::AlignedBox3f box;
    for (std::uint32_t i = 0; i < object.vertex_count; ++i) {
        box.extend(scene.positions[object.first_vertex + i]);
    }
    return box.cast<double>();
}

/// The material of an object that has one only.
std::optional<std::uint32_t> singleMaterialOf(const Scene& scene, const Object& object) {
    const auto first = scene.triangle_material.begin() + object.first_triangle;
    const auto last = first + object.triangle_count;
    if (first == last || std::any_of(first, last, [&](auto one) { return one != *first; })) {
        return std::nullopt;
    }
    return *first;
}

/// Whether half of the smaller box or more is inside the larger one.
bool liesInside(const Eigen::AlignedBox3d& small, const Eigen::AlignedBox3d& large) {
    constexpr double kThin_m = 0.01;
    const Eigen::Vector3d size = small.sizes().cwiseMax(kThin_m);
    if (size.prod() > large.sizes().cwiseMax(kThin_m).prod()) return false;
    const Eigen::Vector3d low = small.min().cwiseMax(large.min());
    const Eigen::Vector3d high = small.max().cwiseMin(large.max());
    if (((high - low).array() < 0.0).any()) return false;
    return (high - low).cwiseMax(kThin_m).prod() >= 0.5 * size.prod();
}

}  // namespace

void noteSizeDoubts(const Scene& scene, ImportReport& report) {
    constexpr std::size_t kMostNamed = 6;
    constexpr double kFarSmaller = 1.0 / 3.0;
    constexpr double kFarLarger = 2.0;
    constexpr int kRowOfBooks = 23;  // NYU40; a row of them may be long
    std::size_t count = 0;
    std::string list;
    for (const Object& object : scene.objects) {
        if (object.role != Role::Target) continue;
        const auto usual = std::ranges::find(kFurnitureSizes, object.nyu40, &FurnitureSize::nyu40);
        if (usual == kFurnitureSizes.end()) continue;
        const double longest = 2.0 * object.box.half_size.maxCoeff();
        if (longest >= kFarSmaller * usual->low &&
            (longest <= kFarLarger * usual->high || object.nyu40 == kRowOfBooks))
            continue;
        if (++count > kMostNamed) continue;
        list += fmt::format("{}{} ({}, {:.2g} m)", list.empty() ? "" : ", ", object.name,
                            nyu40Name(object.nyu40), longest);
    }
    if (count == 0) return;
    if (count > kMostNamed) list += fmt::format(" and {} more", count - kMostNamed);
    report.warnings.push_back(counted(count, "object is of a size that its class does not have: ",
                                      "objects are of sizes that their classes do not have: ") +
                              list + "; set the class, split or merge (dollytrack edit)");
}

void noteMaterialSplit(const Scene& scene, ImportReport& report) {
    std::vector<Eigen::AlignedBox3d> boxes;
    std::vector<bool> single;
    std::set<std::uint32_t> materials;
    for (const Object& object : scene.objects) {
        if (object.role != Role::Target) continue;
        boxes.push_back(uprightBoundsOf(scene, object));
        const std::optional<std::uint32_t> material = singleMaterialOf(scene, object);
        single.push_back(material.has_value());
        if (material) materials.insert(*material);
    }
    const auto share = [&](double of_all) { return of_all * static_cast<double>(boxes.size()); };
    if (boxes.size() < kLeastSplit || boxes.size() > kMostCompared ||
        static_cast<double>(materials.size()) < share(kMostlySingle)) {
        return;
    }
    std::size_t inside = 0;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        if (!single[i]) continue;
        for (std::size_t k = 0; k < boxes.size(); ++k) {
            if (k == i || !liesInside(boxes[i], boxes[k])) continue;
            ++inside;
            break;
        }
    }
    if (static_cast<double>(inside) < share(kMostlyInside)) return;
    report.warnings.push_back(fmt::format(
        "the meshes look split by material: {} of {} objects lie inside others; export one mesh "
        "per object, or merge them (dollytrack edit)",
        inside, boxes.size()));
}

}  // namespace dollytrack
