#include "render/formats/tables/hdf5_frames.h"

#include "engine/io/hdf5/hdf5_reader.h"
#include "engine/io/hdf5/hdf5_writer.h"
#include "render/dataset/contents/frame_context.h"
#include "render/encoders/pack.h"
#include "render/formats/poses/transforms.h"

#include <nlohmann/json.hpp>

#include <array>

namespace dollytrack::render {
namespace {

constexpr std::array<const char*, 1> kHdf5FramesFolders = {"hdf5"};

/// Classes and names of the visible objects, as JSON text.
std::string attributes(const Scene& scene, const FrameRecord& frame) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const ObjectMask& mask : objectMasks(frame.width, frame.height, frame.instance)) {
        const Object& object = scene.object(mask.object_id);
        list.push_back({{"idx", object.id},
                        {"name", object.name},
                        {"category_id", scene.classes().classOf(object).id}});
    }
    return list.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

Result<std::vector<FrameFile>> encodeHdf5Frames(const FrameContext& context,
                                                const FrameRecord& frame) {
    const Scene& scene = context.contents.scene;
    const std::vector<std::uint8_t> classes =
        classBytes(scene.classes(), classesOf(scene, frame.instance));
    const auto height = static_cast<std::uint64_t>(frame.height);
    const auto width = static_cast<std::uint64_t>(frame.width);
    const Hdf5Type class_type = scene.classes().isWide() ? Hdf5Type::Uint16 : Hdf5Type::Uint8;
    return oneFile(
        frameFile(kHdf5FramesFolders[0], frame.index, ".hdf5"),
        packHdf5({{"colors", Hdf5Type::Uint8, {height, width, 3}, frame.rgb.data()},
                  {"depth", Hdf5Type::Float32, {height, width}, frame.depth_m.data()},
                  {"instance_segmaps", Hdf5Type::Uint16, {height, width}, frame.instance.data()},
                  {"category_id_segmaps", class_type, {height, width}, classes.data()}},
                 {{"instance_attribute_maps", attributes(scene, frame)},
                  {"campose", transformRows(frame.pose).dump()}}));
}

nlohmann::ordered_json hdf5FramesConvention(const DatasetContents& contents) {
    const ClassTable& table = contents.scene.classes();
    const std::string type = std::string(table.isWide() ? "uint16" : "uint8") +
                             (table.isNyu40() ? ", NYU40" : ", id in classes");
    return {{"folder", kHdf5FramesFolders[0]},
            {"format",
             "HDF5 in BlenderProc's format: colors (uint8), depth (float32, planar metres, 0 where "
             "no surface is visible), instance_segmaps (uint16), category_id_segmaps (" +
                 type +
                 "), instance_attribute_maps (JSON), campose (JSON: world_from_camera, camera axes "
                 "x right, y up, z back)"}};
}

}  // namespace

const Format kHdf5FramesFormat = {
    .name = "hdf5",
    .text = "one file per frame with its images and pose in BlenderProc's format, in hdf5",
    .group = ContentGroup::Other,
    .needs = kNeedsRgb | kNeedsDepth,
    .folders = kHdf5FramesFolders,
    .encode = encodeHdf5Frames,
    .convention = hdf5FramesConvention,
    .bytes_per_pixel = 4.0,
    .missing = missingHdf5,
};

}  // namespace dollytrack::render
