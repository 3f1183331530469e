#include "render/frames/instances.h"

#include <algorithm>
#include <map>

namespace dollytrack::render {
namespace {

/// A growing bounding box; x1 and y1 are exclusive.
struct Extent {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    std::uint32_t pixels = 0;

    void add(int x, int y) {
        x0 = pixels == 0 ? x : std::min(x0, x);
        y0 = pixels == 0 ? y : std::min(y0, y);
        x1 = std::max(x1, x + 1);
        y1 = std::max(y1, y + 1);
        ++pixels;
    }
    [[nodiscard]] std::array<int, 4> box() const { return {x0, y0, x1 - x0, y1 - y0}; }
};

}  // namespace

std::vector<InstanceInFrame> measureInstances(const FrameRecord& frame) {
    std::map<int, Extent> visible;
    std::map<int, Extent> silhouettes;
    std::map<int, std::map<int, std::uint32_t>> hiding;  // by object: pixels per covering object
    const auto idAt = [&](int x, int y) {
        return frame.instance[static_cast<std::size_t>(y) * static_cast<std::size_t>(frame.width) +
                              static_cast<std::size_t>(x)];
    };
    for (const RenderedAmodalMask& mask : frame.whole) {
        for (int y = mask.y0; y < mask.y0 + mask.height; ++y) {
            for (int x = mask.x0; x < mask.x0 + mask.width; ++x) {
                const int id = idAt(x, y);
                const bool shows = id == mask.object_id;
                // The two renderings may round border pixels differently.
                if (!shows && !mask.covers(x, y)) continue;
                silhouettes[mask.object_id].add(x, y);
                if (shows) {
                    visible[mask.object_id].add(x, y);
                } else if (id != 0) {
                    ++hiding[mask.object_id][id];
                }
            }
        }
    }
    std::vector<InstanceInFrame> instances;
    for (std::size_t i = 0; i < frame.whole.size(); ++i) {
        const int id = frame.whole[i].object_id;
        const auto seen = visible.find(id);
        if (seen == visible.end()) continue;
        InstanceInFrame one;
        one.object_id = id;
        one.visible_px = seen->second.pixels;
        one.silhouette_px = silhouettes[id].pixels;
        one.whole_px = std::max<std::uint64_t>(frame.whole_px[i], one.silhouette_px);
        one.box = seen->second.box();
        one.amodal_box = silhouettes[id].box();
        for (const auto& [other, pixels] : hiding[id]) {
            if (pixels <= one.occluded_px) continue;
            one.occluder = other;
            one.occluded_px = pixels;
        }
        instances.push_back(one);
    }
    std::ranges::sort(instances, {}, &InstanceInFrame::object_id);
    return instances;
}

std::vector<int> visibleObjects(const Scene& scene, const FrameRecord& frame) {
    std::vector<bool> seen(65536, false);
    for (const std::uint16_t id : frame.instance) seen[id] = true;
    std::vector<int> ids;
    for (const Object& object : scene.objects) {
        if (!object.structure && seen[static_cast<std::uint16_t>(object.id)]) {
            ids.push_back(object.id);
        }
    }
    return ids;
}

BoxInCamera boxInCamera(const Object& object, const Eigen::Isometry3d& motion, const Pose& camera) {
    const Eigen::Isometry3d world_from_box =
        motion * Eigen::Translation3d(object.box.center) *
        Eigen::AngleAxisd(object.box.yaw, Eigen::Vector3d::UnitZ());
    const Eigen::Isometry3d box = camera.worldFromCamera().inverse() * world_from_box;
    return {box.translation(), 2.0 * object.box.half_size, Eigen::Quaterniond(box.rotation())};
}

}  // namespace dollytrack::render
