#include "render/formats/poses/euroc.h"

#include "engine/camera/intrinsics.h"
#include "engine/io/files/guarded_folder.h"
#include "render/formats/poses/imu_csv.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>

namespace dollytrack::render {
namespace {

constexpr std::array<const char*, 8> kEurocFiles = {"mav0/cam0/data.csv",
                                                    "mav0/cam0/sensor.yaml",
                                                    "mav0/imu0/data.csv",
                                                    "mav0/imu0/sensor.yaml",
                                                    "mav0/state_groundtruth_estimate0/data.csv",
                                                    "mav0/state_groundtruth_estimate0/sensor.yaml",
                                                    "mav0/cam1/data.csv",
                                                    "mav0/cam1/sensor.yaml"};
constexpr std::size_t kOneCamera = 6;  // number of files with one camera
constexpr std::array<const char*, 2> kEurocFolders = {"mav0/cam0/data", "mav0/cam1/data"};

bool isStereo(const DatasetContents& contents) {
    return contains(contents.modalities, "rgb_right");
}

std::int64_t nanoseconds(double time_s) {
    return std::llround(time_s * 1e9);
}

/// The time stamp of an image with 19 digits, as EuRoC's nanoseconds since 1970 have.
std::string pictureStamp(const DatasetContents& contents, std::size_t frame) {
    return fmt::format("{:019}", nanoseconds(contents.frames[frame].camera.time_s));
}

std::string eurocImageList(const DatasetContents& contents) {
    std::string text = "#timestamp [ns],filename\n";
    for (std::size_t i = 0; i < contents.frames.size(); ++i) {
        const std::string stamp = pictureStamp(contents, i);
        text += stamp + "," + stamp + ".png\n";
    }
    return text;
}

/// Sensor pose on the body: shifted to the right of the left camera.
std::string placeOnBody(double right_m) {
    return fmt::format(
        "T_BS:\n  cols: 4\n  rows: 4\n  data: [1.0, 0.0, 0.0, {:.9f}, 0.0, 1.0, 0.0, 0.0, 0.0, "
        "0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0]\n",
        right_m + 0.0);
}

double frameRate(const DatasetContents& contents) {
    const auto& frames = contents.frames;
    if (frames.size() < 2) return 0.0;
    const double seconds = frames.back().camera.time_s - frames.front().camera.time_s;
    return seconds > 0.0 ? static_cast<double>(frames.size() - 1) / seconds : 0.0;
}

/// EuRoC puts pixel centres at integer coordinates.
std::string cameraText(const DatasetContents& contents, const char* name, double right_m) {
    const Intrinsics lens = makeIntrinsics(contents.camera);
    return fmt::format(
        "sensor_type: camera\ncomment: {}\n{}rate_hz: {:.6g}\nresolution: [{}, {}]\ncamera_model: "
        "pinhole\nintrinsics: [{:.9f}, {:.9f}, {:.9f}, {:.9f}]\ndistortion_model: "
        "radial-tangential\ndistortion_coefficients: [0.0, 0.0, 0.0, 0.0]\n",
        name, placeOnBody(right_m), frameRate(contents), lens.width, lens.height, lens.fx, lens.fy,
        lens.cx - 0.5, lens.cy - 0.5);
}

std::string imuText(const DatasetContents& contents) {
    return fmt::format(
        "sensor_type: imu\ncomment: free of noise and bias\n{}rate_hz: "
        "{:.6g}\ngyroscope_noise_density: 0.0\ngyroscope_random_walk: "
        "0.0\naccelerometer_noise_density: 0.0\naccelerometer_random_walk: 0.0\n",
        placeOnBody(0.0), contents.imu_rate_hz);
}

std::string groundTruth(const DatasetContents& contents) {
    std::string text =
        "#timestamp, p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], "
        "q_RS_z [], v_RS_R_x [m s^-1], v_RS_R_y [m s^-1], v_RS_R_z [m s^-1], b_w_RS_S_x [rad "
        "s^-1], b_w_RS_S_y [rad s^-1], b_w_RS_S_z [rad s^-1], b_a_RS_S_x [m s^-2], b_a_RS_S_y [m "
        "s^-2], b_a_RS_S_z [m s^-2]\n";
    for (const DatasetFrame& frame : contents.frames) {
        const Pose& pose = frame.camera.pose;
        const PoseSpline* path =
            contents.camera_motion.pathOf(static_cast<std::size_t>(frame.source_frame));
        Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
        if (path != nullptr) velocity = path->at(frame.camera.time_s).velocity.head<3>();
        text += std::to_string(nanoseconds(frame.camera.time_s));
        const auto add = [&](double value) {
            fmt::format_to(std::back_inserter(text), ",{:.9f}", value + 0.0);
        };
        for (int i = 0; i < 3; ++i) add(pose.position[i]);
        add(pose.rotation.w());
        for (int i = 0; i < 3; ++i) add(pose.rotation.vec()[i]);
        for (int i = 0; i < 3; ++i) add(velocity[i]);
        text += ",0,0,0,0,0,0\n";  // zero bias
    }
    return text;
}

/// Removes the right camera's folders, which were created before it was known whether it exists.
void removeEmptyFolders(const DatasetContents& contents) {
    const Result<GuardedFolder> folder = GuardedFolder::open(contents.folder);
    if (folder) folder->removeEmpty(kEurocFolders[1]);
}

Result<std::vector<DatasetFile>> writeEuroc(const DatasetContents& contents) {
    std::vector<DatasetFile> files = {
        {kEurocFiles[0], eurocImageList(contents)},
        {kEurocFiles[1], cameraText(contents, "the camera of rgb", 0.0)},
        {kEurocFiles[2], imuCsvText(contents)},
        {kEurocFiles[3], imuText(contents)},
        {kEurocFiles[4], groundTruth(contents)},
        {kEurocFiles[5], "sensor_type: visual-inertial\ncomment: exact\n" + placeOnBody(0.0)}};
    if (!isStereo(contents)) {
        removeEmptyFolders(contents);
        return files;
    }
    files.push_back({kEurocFiles[6], eurocImageList(contents)});
    files.push_back({kEurocFiles[7],
                     cameraText(contents, "the camera of rgb_right", contents.stereo_baseline_m)});
    return files;
}

nlohmann::ordered_json eurocConvention(const DatasetContents& contents) {
    const std::size_t count = isStereo(contents) ? kEurocFiles.size() : kOneCamera;
    return {
        {"files", std::vector<std::string>(kEurocFiles.begin(), kEurocFiles.begin() + count)},
        {"folder", kEurocFolders[0]},
        {"format",
         "EuRoC (ASL): times in ns, starting with the first frame's time_s; the body frame is the "
         "camera of rgb (x right, y down, z forward), also for the inertial sensor; positions (m), "
         "quaternions w x y z and velocities (m/s) in the world, z up; images are hard links to "
         "those of rgb and rgb_right; pixel centres have integer coordinates"}};
}

}  // namespace

PictureLinks eurocPictures(const DatasetContents& contents) {
    PictureLinks links;
    for (std::size_t i = 0; i < contents.frames.size(); ++i) {
        const auto index = static_cast<int>(i);
        const std::string name = fmt::format("/{}.png", pictureStamp(contents, i));
        links[kEurocFolders[0] + name] = frameFile("rgb", index);
        if (isStereo(contents)) links[kEurocFolders[1] + name] = frameFile("rgb_right", index);
    }
    return links;
}

const Format kEurocFormat = {
    .name = "euroc",
    .text = "images, inertial measurements and poses in the layout of EuRoC, in mav0",
    .group = ContentGroup::Poses,
    .files = kEurocFiles,
    .folders = kEurocFolders,
    .write = writeEuroc,
    .convention = eurocConvention,
    .modality = "rgb",
};

}  // namespace dollytrack::render
