#include "render/formats/labels/kitti_objects.h"

#include "render/dataset/contents/frame_context.h"
#include "render/encoders/pack.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>

namespace dollytrack::render {
namespace {

constexpr std::array<const char*, 1> kKittiObjectsFolders = {"label_2"};

/// 0: fully visible, 1: partly occluded, 2: largely occluded.
int occlusionOf(const InstanceInFrame& seen) {
    const double hidden = 1.0 - static_cast<double>(seen.visible_px) /
                                    std::max(static_cast<double>(seen.silhouette_px), 1.0);
    if (hidden < 0.1) return 0;
    return hidden < 0.5 ? 1 : 2;
}

std::string typeOf(const DatasetClass& of) {
    std::string name = of.name;
    std::replace(name.begin(), name.end(), ' ', '_');
    return name;
}

std::string lineOf(const DatasetClass& of, const InstanceInFrame& seen, const BoxInCamera& box) {
    // Centre of the box's bottom; the box's third axis is up.
    const Eigen::Vector3d bottom =
        box.center - box.rotation * Eigen::Vector3d(0, 0, 0.5 * box.size.z());
    const Eigen::Vector3d along = box.rotation * Eigen::Vector3d::UnitX();
    const double turned = -std::atan2(along.z(), along.x());
    const double alpha =
        std::remainder(turned - std::atan2(bottom.x(), bottom.z()), 2.0 * std::acos(-1.0));
    const auto& [x, y, w, h] = seen.box;
    return fmt::format(
        "{} {:.2f} {} {:.6f} {} {} {} {} {:.6f} {:.6f} {:.6f} {:.6f} {:.6f} {:.6f} {:.6f}\n",
        typeOf(of), seen.truncation(), occlusionOf(seen), alpha, x, y, x + w - 1, y + h - 1,
        box.size.z(), box.size.y(), box.size.x(), bottom.x(), bottom.y(), bottom.z(), turned);
}

Result<std::vector<FrameFile>> encodeKittiObjects(const FrameContext& context,
                                                  const FrameRecord& frame) {
    const auto motions = context.moving.toRest(frame.index);
    std::string text;
    for (const InstanceInFrame& seen : measureInstances(frame)) {
        const Object& object = context.contents.scene.object(seen.object_id);
        const DatasetClass* of = context.contents.scene.classes().boxClassOf(object);
        if (of == nullptr) continue;
        const std::size_t id = seen.object_id;
        const Eigen::Isometry3d motion =
            id < motions.size() ? motions[id].inverse() : Eigen::Isometry3d::Identity();
        text += lineOf(*of, seen, boxInCamera(object, motion, frame.pose));
    }
    return std::vector<FrameFile>{
        {frameFile(kKittiObjectsFolders[0], frame.index, ".txt"), {text.begin(), text.end()}}};
}

nlohmann::ordered_json kittiObjectsConvention(const DatasetContents& contents) {
    const std::string type = contents.scene.classes().isNyu40() ? "NYU40" : "classes";
    return {{"folder", kKittiObjectsFolders[0]},
            {"format",
             "KITTI object detection: type (" + type +
                 "), truncated, occluded (0 less than 10 % hidden, 1 less than half, 2 more), "
                 "alpha, left, top, right and bottom pixel, height, width and length (m), centre "
                 "of the box's bottom in the camera's axes, and rotation_y of its first axis; the "
                 "format has no pitch: instances.csv has the full rotation"}};
}

}  // namespace

const Format kKittiObjectsFormat = {
    .name = "kitti_objects",
    .text = "2D and 3D boxes of objects in KITTI's format, in label_2",
    .group = ContentGroup::Labels,
    .needs = kNeedsWhole,
    .folders = kKittiObjectsFolders,
    .encode = encodeKittiObjects,
    .convention = kittiObjectsConvention,
    .outlines_things = true,
};

}  // namespace dollytrack::render
