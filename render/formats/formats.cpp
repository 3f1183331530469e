#include "render/formats/formats.h"

#include "render/dataset/choice.h"
#include "render/formats/labels/bop.h"
#include "render/formats/labels/coco.h"
#include "render/formats/labels/kitti_objects.h"
#include "render/formats/labels/yolo.h"
#include "render/formats/media/video.h"
#include "render/formats/poses/calibration.h"
#include "render/formats/poses/camera_json.h"
#include "render/formats/poses/colmap.h"
#include "render/formats/poses/euroc.h"
#include "render/formats/poses/imu_csv.h"
#include "render/formats/poses/instant_ngp.h"
#include "render/formats/poses/kitti.h"
#include "render/formats/poses/nerfstudio.h"
#include "render/formats/poses/tartan_air.h"
#include "render/formats/poses/tum.h"
#include "render/formats/scenes/gltf.h"
#include "render/formats/tables/frames_csv.h"
#include "render/formats/tables/hdf5_frames.h"
#include "render/formats/tables/instances_csv.h"
#include "render/frames/frame_context.h"

#include <nlohmann/json.hpp>

#include <array>
#include <cmath>

namespace dollytrack::render {
namespace {

using Json = nlohmann::ordered_json;
using Files = Result<std::vector<DatasetFile>>;

constexpr std::array<const char*, 1> kCocoFiles = {"annotations.json"};
constexpr std::array<const char*, 1> kCocoPolygonFiles = {"annotations_polygons.json"};
constexpr std::array<const char*, 1> kCameraJsonFiles = {"camera.json"};
constexpr std::array<const char*, 1> kFramesFiles = {"frames.csv"};
constexpr std::array<const char*, 1> kImuFiles = {"imu.csv"};
constexpr std::array<const char*, 1> kInstancesFiles = {"instances.csv"};

Files writeCoco(const DatasetContents& contents) {
    return std::vector<DatasetFile>{{kCocoFiles[0], cocoText(contents)}};
}

Json cocoConvention(const DatasetContents& contents) {
    const std::string category = contents.scene.classes().isNyu40()
                                     ? "the NYU40 class (40 for targets of unknown class)"
                                     : "the id in classes (targets of class void have none)";
    return {{"file", kCocoFiles[0]},
            {"format", "COCO instances, compressed run lengths; targets only; category_id is " +
                           category + "; image_id is the frame + 1"}};
}

Files writeCocoPolygons(const DatasetContents& contents) {
    return std::vector<DatasetFile>{{kCocoPolygonFiles[0], cocoPolygonsText(contents)}};
}

Json cocoPolygonsConvention(const DatasetContents& /*contents*/) {
    return {{"file", kCocoPolygonFiles[0]},
            {"format",
             "like annotations.json, but with outlines along pixel borders (holes filled) and the "
             "attributes of instances.csv"}};
}

/// Largest distance from a camera to a corner of the building; rendering has no far plane.
double farthestSight(const DatasetContents& contents) {
    const Eigen::AlignedBox3d& bounds = contents.scene.room_bounds;
    double far_m = 0.0;
    for (const DatasetFrame& frame : contents.frames) {
        for (int corner = 0; corner < 8 && !bounds.isEmpty(); ++corner) {
            const auto type = static_cast<Eigen::AlignedBox3d::CornerType>(corner);
            far_m = std::max(far_m, (bounds.corner(type) - frame.camera.pose.position).norm());
        }
    }
    return far_m;
}

Files writeCameraJson(const DatasetContents& contents) {
    std::vector<CameraEntry> entries;
    for (const DatasetFrame& frame : contents.frames) {
        CameraEntry entry{frame.camera, frame.room, {}};
        for (const int id : frame.well_shown) {
            entry.targets.push_back(contents.scene.object(id).name);
        }
        entries.push_back(std::move(entry));
    }
    return std::vector<DatasetFile>{
        {kCameraJsonFiles[0], cameraJsonText(contents.scene, contents.camera,
                                             std::ceil(farthestSight(contents) + 1.0), entries)}};
}

Json cameraJsonConvention(const DatasetContents& /*contents*/) {
    return {{"file", kCameraJsonFiles[0]},
            {"format", "3D-FRONT: y up, metres, horizontal fov in degrees"}};
}

Files writeFrames(const DatasetContents& contents) {
    return std::vector<DatasetFile>{{kFramesFiles[0], framesCsvText(contents)}};
}

Json framesConvention(const DatasetContents& /*contents*/) {
    return {{"file", kFramesFiles[0]},
            {"format",
             "one row per frame: clearance (m), mean speed (m/s) and turning rate (deg/s) since "
             "the previous frame, number of targets of 120 px or more (at 640 x 480) and of well "
             "shown ones, image score of their boxes; with light_varies=frame also the light"}};
}

Files writeImu(const DatasetContents& contents) {
    return std::vector<DatasetFile>{{kImuFiles[0], imuCsvText(contents)}};
}

Json imuConvention(const DatasetContents& /*contents*/) {
    return {
        {"file", kImuFiles[0]},
        {"format",
         "EuRoC's columns: time (ns), angular rate (rad/s) and specific force (m/s2; at rest "
         "9.80665 upwards) in the camera's axes, without noise and bias, along a C2 spline through "
         "all poses of each continuous motion, including frames that are not exported"}};
}

Files writeInstances(const DatasetContents& contents) {
    return std::vector<DatasetFile>{{kInstancesFiles[0], instancesCsvText(contents)}};
}

Json instancesConvention(const DatasetContents& /*contents*/) {
    return {{"file", kInstancesFiles[0]},
            {"format",
             "one row per frame and visible object (none for structure): visible_px; "
             "silhouette_px, unoccluded, inside the image; whole_px, also outside the image; "
             "visible_fraction, of whole_px; truncation, the share outside the image; occluder_id, "
             "the object that hides most of the silhouette, and the share it hides; boxes of the "
             "visible pixels and of the silhouette (px); the oriented box in the camera's axes: "
             "center, size along its own axes (m), quaternion camera_from_box"}};
}

const std::vector<Format>& table() {
    // Built at first use, when the rows defined in other files are initialised.
    static const std::vector<Format> rows = {
        {"coco",
         "COCO instances: boxes and masks of the targets, in annotations.json",
         true,
         kNeedsMasks,
         kCocoFiles,
         {},
         writeCoco,
         nullptr,
         cocoConvention,
         nullptr,
         0.0,
         true},
        {"camera_json",
         "camera poses and the targets that each shows well, in 3D-FRONT's format, in camera.json",
         true,
         0,
         kCameraJsonFiles,
         {},
         writeCameraJson,
         nullptr,
         cameraJsonConvention},
        {"frames",
         "measurements of each frame, such as speed, clearance and image score, in frames.csv",
         true,
         kNeedsMasks,
         kFramesFiles,
         {},
         writeFrames,
         nullptr,
         framesConvention},
        {"imu",
         "inertial measurements along the motion, in imu.csv",
         true,
         0,
         kImuFiles,
         {},
         writeImu,
         nullptr,
         imuConvention},
        {"instances",
         "visibility of each object in each frame: visible part, truncation, occluder, 2D and 3D "
         "boxes, in instances.csv",
         false,
         kNeedsWhole,
         kInstancesFiles,
         {},
         writeInstances,
         nullptr,
         instancesConvention,
         nullptr,
         0.0,
         true},
        {"coco_polygons",
         "COCO instances with outlines and attributes, in annotations_polygons.json",
         false,
         kNeedsMasks | kNeedsWhole,
         kCocoPolygonFiles,
         {},
         writeCocoPolygons,
         nullptr,
         cocoPolygonsConvention,
         nullptr,
         0.0,
         true},
        kYoloFormat,
        kBopFormat,
        kTumFormat,
        kEurocFormat,
        kKittiFormat,
        kColmapFormat,
        kNerfstudioFormat,
        kInstantNgpFormat,
        kKittiObjectsFormat,
        kTartanAirFormat,
        kHdf5FramesFormat,
        kGltfFormat,
        kVideoFormat,
        kCalibrationFormat,
    };
    return rows;
}

}  // namespace

std::span<const Format> formats() {
    return table();
}

Result<FormatSet> chooseFormats(const std::vector<std::string>& names) {
    return chooseRows(formats(), names, "format", "--formats");
}

Status checkNeeds(const FormatSet& formats, const ModalitySet& modalities) {
    for (const Format* format : formats) {
        if (!format->modality || contains(modalities, format->modality)) continue;
        return fail(ErrorCode::Usage,
                    std::string("The format '") + format->name + "' needs the modality '" +
                        format->modality +
                        "', which --modalities leaves out; add it, or choose other formats.",
                    "--formats");
    }
    return {};
}

}  // namespace dollytrack::render
