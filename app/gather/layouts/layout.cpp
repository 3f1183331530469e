#include "app/gather/layouts/layout.h"

namespace dollytrack::gather {

std::span<const LayoutKind* const> layouts() {
    static constexpr std::array kAll = {&kYoloLayout,       &kCocoLayout,    &kImageFolderLayout,
                                        &kWebDatasetLayout, &kParquetLayout, &kBopLayout,
                                        &kTartanAirLayout,  &kMcapLayout,    &kRosbagLayout};
    return kAll;
}

}  // namespace dollytrack::gather
