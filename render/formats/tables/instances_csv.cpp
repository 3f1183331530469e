#include "render/formats/tables/instances_csv.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <iterator>

namespace dollytrack::render {

std::string instancesCsvText(const DatasetContents& contents) {
    const ClassTable& table = contents.scene.classes();
    std::string text = "frame,object_id,nyu40,";
    if (!table.isNyu40()) text += "class_id,";
    text +=
        "visible_px,silhouette_px,whole_px,visible_fraction,truncation,"
        "occluder_id,occluder_fraction,x,y,width,height,amodal_x,amodal_y,amodal_width,"
        "amodal_height,center_x,center_y,center_z,size_x,size_y,size_z,quaternion_x,quaternion_y,"
        "quaternion_z,quaternion_w\n";
    const auto out = std::back_inserter(text);
    for (std::size_t i = 0; i < contents.frames.size(); ++i) {
        const DatasetFrame& frame = contents.frames[i];
        for (const InstanceInFrame& one : frame.instances) {
            const Object& object = contents.scene.object(one.object_id);
            const BoxInCamera box = boxInCamera(
                object, motionOf(contents.motions, one.object_id, i), frame.camera.pose);
            fmt::format_to(out, "{},{},{},", i, one.object_id, object.nyu40);
            if (!table.isNyu40()) fmt::format_to(out, "{},", table.classOf(object).id);
            fmt::format_to(out, "{},{},{},{:.6g},{:.6g},{},{:.6g},{},{},{},{},{},{},{},{},",
                           one.visible_px, one.silhouette_px, one.whole_px, one.visibleFraction(),
                           one.truncation(), one.occluder, one.occluderFraction(), one.box[0],
                           one.box[1], one.box[2], one.box[3], one.amodal_box[0], one.amodal_box[1],
                           one.amodal_box[2], one.amodal_box[3]);
            const Eigen::Quaterniond& q = box.rotation;
            fmt::format_to(
                out, "{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g}\n",
                box.center.x(), box.center.y(), box.center.z(), box.size.x(), box.size.y(),
                box.size.z(), q.x(), q.y(), q.z(), q.w());
        }
    }
    return text;
}

namespace {

constexpr std::array<const char*, 1> kInstancesCsvFiles = {"instances.csv"};

Result<std::vector<DatasetFile>> writeInstancesCsv(const DatasetContents& contents) {
    return std::vector<DatasetFile>{{kInstancesCsvFiles[0], instancesCsvText(contents)}};
}

nlohmann::ordered_json instancesCsvConvention(const DatasetContents& /*contents*/) {
    return {{"file", kInstancesCsvFiles[0]},
            {"format",
             "one row per frame and visible object (none for structure): visible_px; "
             "silhouette_px, unoccluded, inside the image; whole_px, also outside the image; "
             "visible_fraction, of whole_px; truncation, the share outside the image; occluder_id, "
             "the object that hides most of the silhouette, and the share it hides; boxes of the "
             "visible pixels and of the silhouette (px); the oriented box in the camera's axes: "
             "center, size along its own axes (m), quaternion camera_from_box"}};
}

}  // namespace

const Format kInstancesFormat = {
    .name = "instances",
    .text =
        "visibility of each object in each frame: visible part, truncation, occluder, 2D and 3D "
        "boxes, in instances.csv",
    .group = ContentGroup::Labels,
    .needs = kNeedsWhole,
    .files = kInstancesCsvFiles,
    .write = writeInstancesCsv,
    .convention = instancesCsvConvention,
    .outlines_things = true,
};

}  // namespace dollytrack::render
