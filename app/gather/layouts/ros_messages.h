#pragma once

#include "engine/math/pose.h"

#include <Eigen/Geometry>

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

// Messages of ROS 2's public interfaces (as of Humble) in CDR. Lengths in m, angles in rad, times
// in ns; frames are right-handed, those of cameras as in OpenCV (x right, y down, z forward).

namespace dollytrack::gather::ros {

/// The definition of a message type, "sensor_msgs/msg/Imu", and of all types that it contains, as
/// rosbag2 stores them ("ros2msg").
[[nodiscard]] std::string definitionOf(std::string_view type);

/// Time and coordinate frame of a message (std_msgs/msg/Header).
struct Header {
    std::uint64_t time_ns = 0;
    std::string frame;
};

/// sensor_msgs/msg/CompressedImage of a PNG or JPEG file. With `is_depth`, a PNG file of 16-bit
/// depth is encoded as by the compressedDepth transport, whose header precedes the file.
[[nodiscard]] std::string compressedImage(const Header& header, std::string_view file,
                                          bool is_depth);

/// sensor_msgs/msg/CameraInfo, without rectification. Unlike in dataset.json, the centre of the
/// first pixel is (0, 0).
struct CameraInfo {
    int width = 0;   // px
    int height = 0;  // px
    double fx = 0.0;
    double fy = 0.0;
    double cx = 0.0;
    double cy = 0.0;
    std::string distortion_model;  // "plumb_bob", "equidistant"
    std::vector<double> distortion;
    double baseline_m = 0.0;  // from the left camera of a stereo pair
};
[[nodiscard]] std::string cameraInfo(const Header& header, const CameraInfo& camera);

/// geometry_msgs/msg/TransformStamped: the child frame's pose in the header's frame.
struct Transform {
    std::string frame;
    std::string child_frame;
    Pose pose;
};
/// tf2_msgs/msg/TFMessage
[[nodiscard]] std::string transforms(std::uint64_t time_ns, std::span<const Transform> all);

/// sensor_msgs/msg/Imu without orientation. `rate_rps`: angular rate; `force_mps2`: specific force.
[[nodiscard]] std::string imu(const Header& header, const std::array<double, 3>& rate_rps,
                              const std::array<double, 3>& force_mps2);

/// A box of visualization_msgs/msg/MarkerArray that stays until one of the same topic, `group` and
/// `id` replaces it.
struct BoxMarker {
    std::string group;
    int id = 0;
    Pose pose;  // of the centre
    Eigen::Vector3d size = Eigen::Vector3d::Zero();
    std::array<float, 4> color = {};  // red, green, blue, opacity; 0 to 1
    std::string text;
};
[[nodiscard]] std::string boxMarkers(const Header& header, std::span<const BoxMarker> boxes);

/// nav_msgs/msg/Path
struct TimedPose {
    std::uint64_t time_ns = 0;
    Pose pose;
};
[[nodiscard]] std::string path(const Header& header, std::span<const TimedPose> poses);

}  // namespace dollytrack::gather::ros
