#include "render/formats/formats.h"

#include "render/choice.h"
#include "render/formats/camera_json.h"
#include "render/formats/coco.h"
#include "render/formats/frames_csv.h"
#include "render/formats/imu_csv.h"

#include <nlohmann/json.hpp>

#include <array>
#include <cmath>

namespace dollytrack::render {
namespace {

using Json = nlohmann::ordered_json;
using Files = Result<std::vector<DatasetFile>>;

constexpr std::array<const char*, 1> kCocoFiles = {"annotations.json"};
constexpr std::array<const char*, 1> kCameraJsonFiles = {"camera.json"};
constexpr std::array<const char*, 1> kFramesFiles = {"frames.csv"};
constexpr std::array<const char*, 1> kImuFiles = {"imu.csv"};

Files writeCoco(const DatasetContents& contents) {
    return std::vector<DatasetFile>{{kCocoFiles[0], cocoText(contents)}};
}

Json cocoConvention() {
    return {{"file", kCocoFiles[0]},
            {"format",
             "COCO instances, compressed run lengths; targets only; category_id is the "
             "NYU40 class (40 for targets of unknown class); image_id is the frame + 1"}};
}

/// The farthest a camera can see of the building; there is no far plane in the drawing.
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

Json cameraJsonConvention() {
    return {{"file", kCameraJsonFiles[0]},
            {"format", "3D-FRONT: y up, metres, fov horizontal degrees"}};
}

Files writeFrames(const DatasetContents& contents) {
    return std::vector<DatasetFile>{{kFramesFiles[0], framesCsvText(contents)}};
}

Json framesConvention() {
    return {{"file", kFramesFiles[0]},
            {"format",
             "a row a frame: clearance (m), mean speed (m/s) and turning (deg/s) since the frame "
             "before, targets of 120 px or more (at 640 x 480), those shown well, and the image "
             "score from their boxes"}};
}

Files writeImu(const DatasetContents& contents) {
    return std::vector<DatasetFile>{{kImuFiles[0], imuCsvText(contents)}};
}

Json imuConvention() {
    return {{"file", kImuFiles[0]},
            {"format",
             "EuRoC's columns: time (ns), angular rate (rad/s) and specific force (m/s2, at rest "
             "9.80665 against gravity) in the camera's axes; free of noise and bias; the frames of "
             "each continuous motion joined by a twice continuously differentiable spline"}};
}

constexpr std::array<Format, 4> kFormats = {{
    {"coco", "COCO instances: boxes and masks of the targets, in annotations.json", true,
     kCocoFiles, writeCoco, cocoConvention},
    {"camera_json", "camera poses and the targets each shows well, as 3D-FRONT's, in camera.json",
     false, kCameraJsonFiles, writeCameraJson, cameraJsonConvention},
    {"frames", "what can be measured about each frame, its image score too, in frames.csv", true,
     kFramesFiles, writeFrames, framesConvention},
    {"imu", "inertial measurements along the motion, in imu.csv", false, kImuFiles, writeImu,
     imuConvention},
}};

}  // namespace

std::span<const Format> formats() {
    return kFormats;
}

Result<FormatSet> chooseFormats(const std::vector<std::string>& names) {
    return chooseRows(formats(), names, "format", "--formats");
}

}  // namespace dollytrack::render
