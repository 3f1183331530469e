#include "app/gather/layouts/layout.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace dollytrack::gather {

std::span<const LayoutKind* const> layouts() {
    static constexpr std::array kAll = {&kYoloLayout,       &kCocoLayout,    &kImageFolderLayout,
                                        &kWebDatasetLayout, &kParquetLayout, &kBopLayout,
                                        &kTartanAirLayout,  &kMcapLayout,    &kRosbagLayout};
    return kAll;
}

std::string labelImagesText(const std::set<std::string>& modalities, std::string_view ending) {
    std::vector<std::string> names;
    for (const char* modality : {kDepth, kInstance, kSemantic}) {
        if (modalities.contains(modality)) names.push_back(fmt::format("`{}{}`", modality, ending));
    }
    if (names.empty()) return {};
    const std::string last = names.back();
    names.pop_back();
    return fmt::format("{}{}{} {} the same pixels as the colour image. ", fmt::join(names, ", "),
                       names.empty() ? "" : " and ", last, names.empty() ? "has" : "have");
}

}  // namespace dollytrack::gather
