#include "render/dataset/size_estimate.h"

#include <string_view>

namespace dollytrack::render {

double bytesPerPixel(const Modality& modality, std::size_t flow_distances) {
    return modality.bytes_per_pixel *
           (modality.per_flow_distance ? static_cast<double>(flow_distances) : 1.0);
}

std::uint64_t estimateBytes(const DatasetContents& contents, const FormatSet& formats, int frames) {
    constexpr std::uint64_t kOfTheWhole = 1'000'000;  // dataset.json, tables, the contact sheet
    double bytes_per_pixel = 0.0;
    double of_rig = 0.0;  // bytes per frame
    for (const Modality* modality : contents.modalities) {
        if (std::string_view(modality->name) == kRigModality) {
            for (const RigCamera& camera : contents.rig) {
                of_rig += modality->bytes_per_pixel * camera.width_px * camera.height_px;
            }
            continue;
        }
        bytes_per_pixel += bytesPerPixel(*modality, contents.flow_distances.size());
    }
    for (const Format* format : formats) bytes_per_pixel += format->bytes_per_pixel;
    const CameraParams& camera = contents.camera;
    return kOfTheWhole +
           static_cast<std::uint64_t>(
               frames * (bytes_per_pixel * camera.width_px * camera.height_px + of_rig));
}

}  // namespace dollytrack::render
