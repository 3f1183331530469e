#include "engine/io/object_parts/material_split.h"

#include "engine/io/object_parts/piece_merge.h"
#include "engine/jobs/parallel.h"

#include <algorithm>
#include <cstdint>
#include <set>

namespace dollytrack {
namespace {

constexpr std::size_t kFewest = 30;          // smallest number of drafts; fewer are no evidence
constexpr std::size_t kMostCompared = 5000;  // largest number; the time is quadratic in it
constexpr double kOwnMaterials = 0.8;        // smallest number of single materials / drafts
constexpr double kMostlyInside = 0.5;        // smallest share of drafts inside others
constexpr std::size_t kMostAround = 8;       // largest number of surrounding drafts examined

/// The material of a draft; nullopt if it has several.
std::optional<std::uint32_t> singleMaterialOf(const RawScene& raw, const ObjectDraft& draft) {
    std::optional<std::uint32_t> material;
    for (const std::size_t part : draft.parts) {
        if (raw.parts[part].triangles.empty()) continue;
        if (material && *material != raw.parts[part].material) return std::nullopt;
        material = raw.parts[part].material;
    }
    return material;
}

}  // namespace

std::optional<MaterialSplit> findMaterialSplit(const RawScene& raw,
                                               const std::vector<bool>& structure,
                                               const std::vector<ObjectDraft>& drafts) {
    MaterialSplit split;
    split.by_material.assign(drafts.size(), false);
    std::vector<std::size_t> compared;
    std::vector<Eigen::AlignedBox3f> boxes(drafts.size());
    std::set<std::uint32_t> materials;
    for (std::size_t i = 0; i < drafts.size(); ++i) {
        if (structure[i]) continue;
        compared.push_back(i);
        boxes[i] = boundsOf(raw, drafts[i]);
        const std::optional<std::uint32_t> material = singleMaterialOf(raw, drafts[i]);
        split.by_material[i] = material.has_value();
        if (material) materials.insert(*material);
    }
    split.drafts = compared.size();
    const auto share = [&](double of_all) { return of_all * static_cast<double>(split.drafts); };
    if (split.drafts < kFewest || split.drafts > kMostCompared ||
        static_cast<double>(materials.size()) < share(kOwnMaterials)) {
        return std::nullopt;
    }
    std::vector<char> inside(compared.size(), 0);
    parallelFor(compared.size(), [&](std::size_t c) {
        const std::size_t i = compared[c];
        if (!split.by_material[i]) return;
        std::size_t around = 0;
        bool stands = false;
        for (const std::size_t k : compared) {
            if (k == i || !liesInside(boxes[i], boxes[k])) continue;
            if (++around > kMostAround) break;
            const auto contact =
                findContact(surfacesOf(raw, drafts[i]), surfacesOf(raw, drafts[k]), kContactGap);
            stands = stands || (!contact.empty() && standsOn(boxes[i], boxes[k], contact));
        }
        inside[c] = around > 0 && !stands ? 1 : 0;
    });
    split.inside = static_cast<std::size_t>(std::ranges::count(inside, 1));
    if (static_cast<double>(split.inside) < share(kMostlyInside)) return std::nullopt;
    return split;
}

}  // namespace dollytrack
