#include "engine/io/import/size_warnings.h"

#include "engine/core/text_lists.h"
#include "engine/scene/furniture_sizes.h"
#include "engine/scene/labels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string>

namespace dollytrack {

void warnOfUnusualSizes(const Scene& scene, ImportReport& report) {
    constexpr std::size_t kMostNamed = 6;
    constexpr double kFarSmaller = 1.0 / 3.0;
    constexpr double kFarLarger = 2.0;
    constexpr int kRowOfBooks = 23;  // NYU40's books; a row of them may be long
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
    report.warnings.push_back(counted(count, "object has an unusual size for its class: ",
                                      "objects have unusual sizes for their classes: ") +
                              list + "; set the class, split or merge (dollytrack edit)");
}

}  // namespace dollytrack
