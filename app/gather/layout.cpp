#include "app/gather/layout.h"

namespace dollytrack::gather {

std::span<const LayoutKind* const> layouts() {
    static constexpr std::array<const LayoutKind*, 4> kAll = {
        &kYoloLayout, &kCocoLayout, &kImageFolderLayout, &kWebDatasetLayout};
    return kAll;
}

}  // namespace dollytrack::gather
