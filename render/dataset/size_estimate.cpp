#include "render/dataset/size_estimate.h"

#include <algorithm>
#include <string_view>

namespace dollytrack::render {

double bytesPerFrame(const Modality& modality, double pixels, std::size_t flow_distances) {
    const double files = modality.per_flow_distance ? static_cast<double>(flow_distances) : 1.0;
    return files * std::min(modality.bytes_per_pixel * pixels, modality.most_bytes);
}

std::uint64_t estimateBytes(const DatasetContents& contents, const FormatSet& formats, int frames) {
    constexpr std::uint64_t kOfTheWhole = 1'000'000;  // dataset.json, tables, the contact sheet
    const double pixels = 1.0 * contents.camera.width_px * contents.camera.height_px;
    double bytes = 0.0;  // per frame
    for (const Modality* modality : contents.modalities) {
        if (std::string_view(modality->name) != kRigModality) {
            bytes += bytesPerFrame(*modality, pixels, contents.flow_distances.size());
            continue;
        }
        for (const RigCamera& camera : contents.rig) {
            bytes += modality->bytes_per_pixel * camera.width_px * camera.height_px;
        }
    }
    for (const Format* format : formats) bytes += format->bytes_per_pixel * pixels;
    return kOfTheWhole + static_cast<std::uint64_t>(frames * bytes);
}

}  // namespace dollytrack::render
