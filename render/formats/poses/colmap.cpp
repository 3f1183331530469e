#include "render/formats/poses/colmap.h"

#include "engine/camera/intrinsics.h"
#include "engine/geometry/ray_caster.h"
#include "render/formats/poses/calibration.h"
#include "render/formats/poses/frame_text.h"
#include "render/formats/scenes/surface_sample.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>

namespace dollytrack::render {
namespace {

constexpr std::array<const char*, 3> kColmapFiles = {"sparse/0/cameras.txt", "sparse/0/images.txt",
                                                     "sparse/0/points3D.txt"};
constexpr int kPoints = 50'000;  // about what structure from motion finds in a few hundred images

std::string cameras(const Intrinsics& lens, const LensDistortion& bent) {
    if (!bent.none()) {
        return fmt::format(
            "# CAMERA_ID MODEL WIDTH HEIGHT PARAMS[]\n1 FULL_OPENCV {} {} {:.9f} {:.9f} {:.9f} "
            "{:.9f} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f} 0 0 0\n",
            lens.width, lens.height, lens.fx, lens.fy, lens.cx, lens.cy, bent.k1, bent.k2, bent.p1,
            bent.p2, bent.k3);
    }
    return fmt::format(
        "# CAMERA_ID MODEL WIDTH HEIGHT PARAMS[]\n1 PINHOLE {} {} {:.9f} {:.9f} {:.9f} {:.9f}\n",
        lens.width, lens.height, lens.fx, lens.fy, lens.cx, lens.cy);
}

/// Image name inside its folder; readers get the folder separately.
std::string nameInFolder(const std::string& file) {
    return file.substr(file.find('/') + 1);
}

std::string images(const DatasetContents& contents) {
    std::string text =
        "# IMAGE_ID QW QX QY QZ TX TY TZ CAMERA_ID NAME\n# POINTS2D[] as X Y POINT3D_ID\n";
    for (std::size_t i = 0; i < contents.frames.size(); ++i) {
        const Pose& pose = contents.frames[i].camera.pose;
        const Eigen::Quaterniond q = pose.rotation.conjugate();
        const Eigen::Vector3d t = pose.toCamera(Eigen::Vector3d::Zero());
        // The second line lists the image's 2D points; it must exist even if empty.
        text += fmt::format(
            "{} {} {} 1 {}\n\n", i + 1, numbersText(Eigen::Vector4d(q.w(), q.x(), q.y(), q.z())),
            numbersText(t), nameInFolder(contents.pictureFile(static_cast<int>(i))));
    }
    return text;
}

/// Whether any frame shows the point; checks at most about 300 evenly spaced frames.
bool isSeen(const DatasetContents& contents, const Intrinsics& lens, const RayCaster& rays,
            const Eigen::Vector3d& point) {
    constexpr std::size_t kMostFrames = 300;
    constexpr double kBefore = 1e-4;  // relative distance kept from the point itself
    const std::size_t step = 1 + contents.frames.size() / (kMostFrames + 1);
    for (std::size_t i = 0; i < contents.frames.size(); i += step) {
        const Pose& pose = contents.frames[i].camera.pose;
        const Eigen::Vector3d in_camera = pose.toCamera(point);
        if (in_camera.z() < contents.camera.near_m) continue;
        const Eigen::Vector2d at = lens.project(in_camera);
        if (!(at.x() >= 0.0 && at.y() >= 0.0 && at.x() < lens.width && at.y() < lens.height)) {
            continue;
        }
        const RayHit hit = rays.cast(pose.position, point - pose.position, 1.0 - kBefore, 0.0);
        if (hit.object_id == 0) return true;
    }
    return false;
}

/// Samples `count` points on all surfaces of the scene and keeps those that frames show.
std::vector<ColoredPoint> seenPoints(const DatasetContents& contents, const Intrinsics& lens,
                                     const RayCaster& rays, int count) {
    std::vector<ColoredPoint> points = sampleSurface(contents.scene, count, 1);
    std::erase_if(points, [&](const ColoredPoint& point) {
        return !isSeen(contents, lens, rays, point.position);
    });
    return points;
}

std::string points(const DatasetContents& contents, const Intrinsics& lens) {
    constexpr int kFewest = kPoints / 5;
    constexpr int kMostTimes = 10;  // in a large building, few points are visible
    const RayCaster rays(contents.scene);
    std::vector<ColoredPoint> seen = seenPoints(contents, lens, rays, kPoints);
    if (static_cast<int>(seen.size()) < kFewest) {
        const int times = kFewest / std::max(1, static_cast<int>(seen.size())) + 1;
        seen = seenPoints(contents, lens, rays, kPoints * std::min(times, kMostTimes));
    }
    std::string text = "# POINT3D_ID X Y Z R G B ERROR TRACK[] as (IMAGE_ID POINT2D_IDX)\n";
    int id = 0;
    for (const ColoredPoint& point : seen) {
        text += fmt::format("{} {} {} {} {} 0\n", ++id, numbersText(point.position), point.color[0],
                            point.color[1], point.color[2]);
    }
    return text;
}

Result<std::vector<DatasetFile>> writeColmap(const DatasetContents& contents) {
    const Intrinsics lens = makeIntrinsics(contents.camera);
    return std::vector<DatasetFile>{{kColmapFiles[0], cameras(lens, pictureDistortion(contents))},
                                    {kColmapFiles[1], images(contents)},
                                    {kColmapFiles[2], points(contents, lens)}};
}

nlohmann::ordered_json colmapConvention(const DatasetContents& /*contents*/) {
    return {{"files", kColmapFiles},
            {"format",
             "COLMAP text model: camera_from_world, quaternion w x y z, pixel centres at "
             "half-integer coordinates; names are relative to the image folder (--image_path "
             ".../rgb); points3D.txt is a sample of the surfaces visible in the frames, moving "
             "objects at their planned poses, without tracks"}};
}

}  // namespace

const Format kColmapFormat = {
    .name = "colmap",
    .text = "a COLMAP text model, in sparse/0",
    .group = ContentGroup::Poses,
    .files = kColmapFiles,
    .write = writeColmap,
    .convention = colmapConvention,
};

}  // namespace dollytrack::render
