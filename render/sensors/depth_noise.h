#pragma once

#include "engine/camera/intrinsics.h"
#include "engine/camera/sensor_params.h"

#include <Eigen/Geometry>

#include <cstdint>
#include <span>
#include <vector>

namespace dollytrack::render {

/// What a depth camera is given: planar depth (m, 0 for nothing), and of what it shows the normal
/// and the base colour (sRGB, 3 bytes a pixel).
struct DepthScene {
    int frame = 0;
    Intrinsics lens;
    Eigen::Quaterniond world_from_camera = Eigen::Quaterniond::Identity();
    std::span<const float> depth_m;
    std::span<const Eigen::Vector3f> normals_in_world;
    std::span<const std::uint8_t> albedo;
};

/// What the models have in common, for those who judge their results.
struct DepthLimits {
    double nearest_m = 0.0;  // nearer and farther things are holes
    double farthest_m = 65.0;
    double edge_m = 0.0;      // a depth step of so much, and
    double edge_share = 0.0;  // of so much of the nearer depth, from a pixel to the next: a hole
};
[[nodiscard]] DepthLimits depthLimits(DepthNoise model);

/// The deviation of a depth (m) on a white, matt surface that is looked at straight.
[[nodiscard]] double depthDeviation(DepthNoise model, double depth_m);

/// How often the signal of a surface loses to noise, in deviations: 1 on a surface as above with
/// half of white's reflectance, up to kMostDim on dark and grazing ones.
inline constexpr double kMostDim = 4.0;
[[nodiscard]] double dimness(double reflectance, double cos_to_normal);

/// The depth that the camera would deliver, m; 0 is a hole.
///
/// kinect_azure, time of flight: deviation 0.5 mm to 0.5 m and 1 mm more a metre beyond, which is
/// how Toelgyessy, Dekan, Chovanec and Hubinsky (Evaluation of the Azure Kinect and Its Comparison
/// to Kinect V1 and Kinect V2, Sensors 21(2):413, 2021) are commonly fitted; times dimness(), as
/// shot noise goes with the root of the light that comes back; each pixel looks up to some
/// quarter of a pixel aside. Holes: nearer than 0.5 m and farther than 5.46 m (the maker's range of
/// the narrow binned mode), steps of 0.1 m and 5 %, where light of both sides mixes, and surfaces
/// from which too little light comes back.
///
/// redwood, structured light: as Choi, Zhou and Koltun (Robust Reconstruction of Indoor Scenes,
/// CVPR 2015) simulate the first Kinect after Teichman, Miller and Thrun (Unsupervised intrinsic
/// calibration of depth sensors via SLAM, RSS 2013), and as Barron and Malik (Intrinsic Scene
/// Properties from a Single RGB-D Image, CVPR 2013), in the order of their program (simdepth.py of
/// redwood-data.org): a look aside by a quarter of a pixel, the depth of the even pixel at or
/// before it, disparity 35.130 / z with deviation 1/36, rounded to steps of 1/8. Their low
/// frequency distortion, measured on one device and applied between depth and disparity, is left
/// out. Holes: nearer than 0.4 m and farther than 10 m, and steps as above.
[[nodiscard]] std::vector<float> noisyDepth(const SensorParams& params, const DepthScene& scene);

}  // namespace dollytrack::render
