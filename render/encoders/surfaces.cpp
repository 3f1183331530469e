#include "engine/io/files/png_writer.h"
#include "render/encoders/encoders.h"
#include "render/encoders/pack.h"
#include "render/materials/traced_surface.h"
#include "render/view/view.h"

#include <nlohmann/json.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>

namespace dollytrack::render {
namespace {

using Json = nlohmann::ordered_json;

FrameFiles encodeNormals(const FrameRecord& frame, const char* folder,
                         const Eigen::Matrix3d& from_world) {
    std::vector<std::uint16_t> image(3 * frame.instance.size(), 0);
    for (std::size_t i = 0; i < frame.instance.size(); ++i) {
        if (frame.instance[i] == 0) continue;
        putNormal((from_world * frame.normals_in_world[i].cast<double>()).normalized(),
                  &image[3 * i]);
    }
    return oneFile(frameFile(folder, frame.index),
                   encodePng(frame.width, frame.height, PngFormat::Rgb16, bytesOf(image)));
}

Json normalConvention(const char* folder, const char* axes) {
    return {{"folder", folder},
            {"type", "uint16 x 3"},
            {"encoding", "(n + 1) / 2 * 65535, x y z in red green blue"},
            {"invalid", {0, 0, 0}},
            {"meaning", std::string("unit shading normal, facing the camera, in ") + axes}};
}

/// A value of the materials, 0..1, at the surfaces that the rays through pixel centres hit.
FrameFiles encodeMaterial(const FrameContext& context, const FrameRecord& frame, const char* folder,
                          float SurfacePoint::*value) {
    const View view = makeView(context.contents.camera, frame.pose);
    const std::shared_ptr<const RayCaster> rays = context.moving.raysAt(frame.index);
    const std::optional<MovedShape> moved = context.moving.wholeShapeAt(frame.index);
    const TracedSurface surface(context.contents.scene, moved ? &*moved : nullptr);
    std::vector<std::uint8_t> image(frame.instance.size(), 0);
    std::size_t i = 0;
    for (int y = 0; y < frame.height; ++y) {
        for (int x = 0; x < frame.width; ++x, ++i) {
            if (frame.instance[i] == 0) continue;
            const ViewRay ray = view.rayThrough(x + 0.5, y + 0.5);
            const double length = ray.direction.norm();
            const Eigen::Vector3d way = ray.direction / length;
            const RayHit hit = rays->cast(ray.origin, way, std::numeric_limits<double>::infinity(),
                                          view.near_m * length);
            if (hit.object_id == 0) continue;
            const float share = surface.at(ray.origin, way, hit).*value;
            image[i] = static_cast<std::uint8_t>(std::lround(255.0F * std::clamp(share, 0.F, 1.F)));
        }
    }
    return oneFile(frameFile(folder, frame.index),
                   encodePng(frame.width, frame.height, PngFormat::Gray8, image));
}

Json materialConvention(const char* folder, const char* meaning) {
    return {
        {"folder", folder}, {"type", "uint8"}, {"encoding", "255 * value"}, {"meaning", meaning}};
}

}  // namespace

FrameFiles encodeNormalCamera(const FrameContext& /*context*/, const FrameRecord& frame) {
    return encodeNormals(frame, "normal_camera",
                         frame.pose.rotation.toRotationMatrix().transpose());
}

FrameFiles encodeNormalWorld(const FrameContext& /*context*/, const FrameRecord& frame) {
    return encodeNormals(frame, "normal_world", Eigen::Matrix3d::Identity());
}

FrameFiles encodeAlbedo(const FrameContext& /*context*/, const FrameRecord& frame) {
    return oneFile(frameFile("albedo", frame.index),
                   encodePng(frame.width, frame.height, PngFormat::Rgb8, frame.albedo));
}

FrameFiles encodeRoughness(const FrameContext& context, const FrameRecord& frame) {
    return encodeMaterial(context, frame, "roughness", &SurfacePoint::roughness);
}

FrameFiles encodeMetallic(const FrameContext& context, const FrameRecord& frame) {
    return encodeMaterial(context, frame, "metallic", &SurfacePoint::metallic);
}

FrameFiles encodeObjectCoordinates(const FrameContext& context, const FrameRecord& frame) {
    const Scene& scene = context.contents.scene;
    const Intrinsics lens = makeIntrinsics(context.contents.camera);
    // From the moved object to its position in the scene, and from there to the box's own frame.
    std::vector<Eigen::Affine3d> box_from_world(scene.objects.size() + 1);
    const auto motions = context.moving.toRest(frame.index);
    for (const Object& object : scene.objects) {
        const std::size_t id = object.id;
        const Eigen::Vector3d size = (2.0 * object.box.half_size).cwiseMax(1e-6);
        box_from_world[id] = Eigen::Translation3d(0.5, 0.5, 0.5) *
                             Eigen::Scaling(size.cwiseInverse().eval()) *
                             Eigen::AngleAxisd(-object.box.yaw, Eigen::Vector3d::UnitZ()) *
                             Eigen::Translation3d(-object.box.center);
        if (!motions.empty()) box_from_world[id] = box_from_world[id] * motions[id];
    }
    std::vector<std::uint16_t> image(3 * frame.instance.size(), 0);
    std::size_t i = 0;
    for (int y = 0; y < frame.height; ++y) {
        for (int x = 0; x < frame.width; ++x, ++i) {
            if (frame.instance[i] == 0) continue;
            const Eigen::Vector3d place = frame.pose.toWorld(static_cast<double>(frame.depth_m[i]) *
                                                             lens.unproject(x + 0.5, y + 0.5));
            const Eigen::Vector3d in_box = box_from_world[frame.instance[i]] * place;
            for (int axis = 0; axis < 3; ++axis) {
                image[3 * i + static_cast<std::size_t>(axis)] = inSteps(in_box[axis]);
            }
        }
    }
    return oneFile(frameFile("object_coordinates", frame.index),
                   encodePng(frame.width, frame.height, PngFormat::Rgb16, bytesOf(image)));
}

Json normalCameraConvention(const DatasetContents& /*contents*/) {
    return normalConvention("normal_camera", "the camera's axes");
}

Json normalWorldConvention(const DatasetContents& /*contents*/) {
    return normalConvention("normal_world", "the world's axes");
}

Json albedoConvention(const DatasetContents& /*contents*/) {
    return {{"folder", "albedo"},
            {"type", "uint8 x 3"},
            {"encoding", "sRGB"},
            {"meaning", "base colour without lighting; for glass its tint"}};
}

Json roughnessConvention(const DatasetContents& /*contents*/) {
    return materialConvention("roughness",
                              "glTF's roughness of the material, maps included; 0 also where "
                              "instance is 0");
}

Json metallicConvention(const DatasetContents& /*contents*/) {
    return materialConvention("metallic",
                              "glTF's metalness of the material, maps included; 0 also where "
                              "instance is 0");
}

Json objectCoordinatesConvention(const DatasetContents& /*contents*/) {
    return {{"folder", "object_coordinates"},
            {"type", "uint16 x 3"},
            {"encoding", "65535 * coordinate, x y z in red green blue"},
            {"invalid", {0, 0, 0}},
            {"meaning",
             "coordinates in the object's own box (objects[].box), 0 to 1 along each of its axes"}};
}

}  // namespace dollytrack::render
