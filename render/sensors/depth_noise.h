#pragma once

#include "engine/camera/intrinsics.h"
#include "engine/camera/sensor_params.h"

#include <Eigen/Geometry>

#include <cstdint>
#include <span>
#include <vector>

namespace dollytrack::render {

/// Input of the depth camera: planar depth (m, 0: nothing) and the normals and base colours (sRGB,
/// 3 bytes per pixel) of the same pixels.
struct DepthNoiseInput {
    int frame = 0;
    Intrinsics lens;
    Eigen::Quaterniond world_from_camera = Eigen::Quaterniond::Identity();
    std::span<const float> depth_m;
    std::span<const Eigen::Vector3f> normals_in_world;
    std::span<const std::uint8_t> albedo;
};

/// Limits of a depth noise model, for validating its results.
struct DepthLimits {
    double nearest_m = 0.0;  // nearer and farther surfaces become holes
    double farthest_m = 65.0;
    double edge_m = 0.0;      // smallest depth step between pixels that becomes a hole, and
    double edge_share = 0.0;  // the same relative to the nearer depth; the larger one counts
};
[[nodiscard]] DepthLimits depthLimits(DepthNoise model);

/// Standard deviation of depth (m) where dimness() is 1.
[[nodiscard]] double depthDeviation(DepthNoise model, double depth_m);

/// Factor of kinect_azure's noise by surface, from 0.5 to kMostDim: 1 where reflectance times
/// cosine is 0.5, larger on darker surfaces and at grazing angles.
inline constexpr double kMostDim = 4.0;
[[nodiscard]] double dimness(double reflectance, double cos_to_normal);

/// The depth that the camera delivers, m; 0 is a hole.
///
/// kinect_azure, time of flight: the standard deviation is 0.5 mm up to 0.5 m and grows by 1 mm per
/// metre beyond, the usual fit to Toelgyessy, Dekan, Chovanec and Hubinsky (Evaluation of the Azure
/// Kinect and Its Comparison to Kinect V1 and Kinect V2, Sensors 21(2):413, 2021). It is multiplied
/// by dimness(), because shot noise follows the square root of the returned light. Each pixel is
/// read at a random offset of about a quarter pixel. Holes: depth below 0.5 m or above 5.46 m (the
/// maker's range of the narrow binned mode), depth steps of more than 0.1 m and more than 5 %,
/// where light of both sides mixes, and surfaces that return too little light.
///
/// redwood, structured light: the first Kinect as simulated by Choi, Zhou and Koltun (Robust
/// Reconstruction of Indoor Scenes, CVPR 2015) after Teichman, Miller and Thrun (Unsupervised
/// intrinsic calibration of depth sensors via SLAM, RSS 2013) and Barron and Malik (Intrinsic Scene
/// Properties from a Single RGB-D Image, CVPR 2013). The steps are those of their program
/// (simdepth.py of redwood-data.org): random offset of a quarter pixel, depth of the even pixel at
/// or before it, disparity 35.130 / z with standard deviation 1/36, rounded to steps of 1/8. Their
/// low-frequency distortion, measured on one device, is left out. Holes: depth below 0.4 m or above
/// 10 m, and depth steps as above.
[[nodiscard]] std::vector<float> noisyDepth(const SensorParams& params,
                                            const DepthNoiseInput& input);

}  // namespace dollytrack::render
