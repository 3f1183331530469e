#include "engine/io/files/png_writer.h"
#include "render/encoders/encoders.h"
#include "render/encoders/pack.h"
#include "render/rig/rig_files.h"
#include "render/rig/rig_labels.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace dollytrack::render {
namespace {

std::vector<std::uint16_t> normalSteps(const std::vector<Eigen::Vector3f>& normals) {
    std::vector<std::uint16_t> image(3 * normals.size(), 0);
    for (std::size_t i = 0; i < normals.size(); ++i) {
        if (normals[i].isZero(0.0F)) continue;
        putNormal(normals[i].cast<double>().normalized(), &image[3 * i]);
    }
    return image;
}

}  // namespace

FrameFiles encodeCameras(const FrameContext& context, const FrameRecord& frame) {
    const DatasetContents& contents = context.contents;
    std::vector<FrameFile> files;
    for (std::size_t i = 0; i < contents.rig.size(); ++i) {
        const RigCamera& camera = contents.rig[i];
        const LensModel lens(camera);
        const LensImages seen = castLens(lens, poseOnRig(camera, frame.pose), context, frame.index);
        const auto add = [&](const char* image, PngFormat format,
                             std::span<const std::uint8_t> bytes) -> Status {
            Result<std::vector<std::uint8_t>> png =
                encodePng(camera.width_px, camera.height_px, format, bytes);
            if (!png) return tl::unexpected(std::move(png.error()));
            files.push_back(
                {frameFile(rigFolder(camera.name, image), frame.index), std::move(*png)});
            return {};
        };
        Status status = add("rgb", PngFormat::Rgb8, frame.rig_rgb[i]);
        if (status) {
            const auto depth = depthInMillimetres(seen.depth_m);
            status = add("depth", PngFormat::Gray16, bytesOf(depth));
        }
        if (status) status = add("instance", PngFormat::Gray16, bytesOf(seen.instance));
        if (status) {
            const ClassTable& table = contents.scene.classes();
            status = add("semantic", classFormat(table),
                         classBytes(table, classesOf(contents.scene, seen.instance)));
        }
        if (status) {
            const auto normals = normalSteps(seen.normals_in_world);
            status = add("normal_world", PngFormat::Rgb16, bytesOf(normals));
        }
        if (!status) return tl::unexpected(status.error());
    }
    return files;
}

nlohmann::ordered_json camerasConvention(const DatasetContents& contents) {
    const ClassTable& table = contents.scene.classes();
    return {{"folder", kRigModality},
            {"images", kRigImages},
            {"meaning",
             "cameras/NAME/IMAGE/NNNNNN.png of every camera in \"cameras\", which has its lens and "
             "poses; types and units are those of the planned camera's images of the same name, "
             "but depth is along the axis or along the ray (see each camera); ids, classes, depth "
             "and normals are sampled by the exact rays of the lens through pixel centres; 0 where "
             "no surface is visible and outside a fisheye's image circle" +
                 (table.isNyu40() ? std::string()
                                  : fmt::format(" ({} in classes)", table.voidClass().id))}};
}

}  // namespace dollytrack::render
