#include "render/frame_record.h"

#include <algorithm>

namespace dollytrack::render {

std::size_t FrameRecord::bytes() const {
    const auto of = [](const auto& values) { return values.size() * sizeof(values[0]); };
    std::size_t all = of(rgb) + of(depth_m) + of(instance) + of(semantic) + of(normals_in_world) +
                      of(albedo) + of(rgb_right) + of(depth_right_m) + of(sensor_light);
    for (const WholeMask& mask : whole) all += of(mask.inside);
    // Depth, ids, normals and classes of one camera at a time; compressed, all cameras'.
    constexpr std::size_t kLabelBytes = 24;
    constexpr std::size_t kCompressedBytes = 3;
    std::size_t largest_px = 0;
    for (const std::vector<std::uint8_t>& picture : rig_rgb) {
        const std::size_t pixels = picture.size() / 3;
        all += of(picture) + kCompressedBytes * pixels;
        largest_px = std::max(largest_px, pixels);
    }
    return all + kLabelBytes * largest_px;
}

void FrameRecord::labelClasses(const Scene& scene) {
    semantic = classesOf(scene, instance);
}

std::vector<std::uint8_t> classesOf(const Scene& scene, std::span<const std::uint16_t> instance) {
    std::vector<std::uint8_t> classes(65536, 0);
    for (const Object& object : scene.objects) {
        classes[static_cast<std::uint16_t>(object.id)] = static_cast<std::uint8_t>(object.nyu40);
    }
    std::vector<std::uint8_t> result(instance.size());
    for (std::size_t i = 0; i < instance.size(); ++i) result[i] = classes[instance[i]];
    return result;
}

std::vector<std::uint16_t> depthInMillimetres(const std::vector<float>& depth_m) {
    std::vector<std::uint16_t> result(depth_m.size());
    for (std::size_t i = 0; i < depth_m.size(); ++i) {
        const float value = depth_m[i] * 1000.0F + 0.5F;
        result[i] = value < 65536.0F ? static_cast<std::uint16_t>(value) : std::uint16_t{0};
    }
    return result;
}

}  // namespace dollytrack::render
