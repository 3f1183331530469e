#include "render/frames/frame_record.h"

#include <algorithm>

namespace dollytrack::render {

std::size_t FrameRecord::bytes() const {
    const auto of = [](const auto& values) { return values.size() * sizeof(values[0]); };
    std::size_t all = of(rgb) + of(depth_m) + of(instance) + of(semantic) + of(normals_in_world) +
                      of(albedo) + of(rgb_right) + of(depth_right_m) + of(sensor_light) +
                      4 * of(layers.reflectance);
    for (const RenderedAmodalMask& mask : whole) all += of(mask.inside);
    // Depth, ids, normals and classes exist for one camera at a time, compressed images for all.
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
    class_table = scene.class_table;
}

std::vector<std::uint16_t> classesOf(const Scene& scene, std::span<const std::uint16_t> instance) {
    const ClassTable& table = scene.classes();
    std::vector<std::uint16_t> classes(65536, static_cast<std::uint16_t>(table.voidClass().id));
    for (const Object& object : scene.objects) {
        classes[static_cast<std::uint16_t>(object.id)] =
            static_cast<std::uint16_t>(table.classOf(object).id);
    }
    std::vector<std::uint16_t> result(instance.size());
    for (std::size_t i = 0; i < instance.size(); ++i) result[i] = classes[instance[i]];
    return result;
}

PngFormat classFormat(const ClassTable& table) {
    return table.isWide() ? PngFormat::Gray16 : PngFormat::Gray8;
}

std::vector<std::uint8_t> classBytes(const ClassTable& table,
                                     std::span<const std::uint16_t> classes) {
    if (!table.isWide()) return {classes.begin(), classes.end()};
    const auto* first = reinterpret_cast<const std::uint8_t*>(classes.data());
    return {first, first + classes.size_bytes()};
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
