#pragma once

#include "engine/math/pose.h"

#include <Eigen/Geometry>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

// Messages of ROS 2's public interfaces (as of Humble), and of ROS 1's (as of Noetic). Lengths in
// m, angles in rad, times in ns; frames are right-handed, those of cameras as in OpenCV (x right, y
// down, z forward).

namespace dollytrack::gather::ros {

enum class Version { Ros1, Ros2 };

/// The definition of a message type, "sensor_msgs/Imu", and of all types that it contains, as
/// rosbag and rosbag2 ("ros2msg") store them.
[[nodiscard]] std::string definitionOf(Version version, std::string_view type);

/// ROS 1's MD5 sum of a message type, with which nodes compare their definitions.
[[nodiscard]] std::string_view md5Of(std::string_view type);

/// Time and coordinate frame of a message (std_msgs/Header).
struct Header {
    std::uint64_t time_ns = 0;
    std::string frame;
    std::size_t sequence = 0;  // number of the message in its topic; only in ROS 1
};

/// sensor_msgs/CompressedImage of a PNG or JPEG file. With `is_depth`, a PNG file of 16-bit
/// depth is encoded as by the compressedDepth transport, whose header precedes the file.
[[nodiscard]] std::string compressedImage(Version version, const Header& header,
                                          std::string_view file, bool is_depth);

/// sensor_msgs/CameraInfo, without rectification. Unlike in dataset.json, the centre of the
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
[[nodiscard]] std::string cameraInfo(Version version, const Header& header,
                                     const CameraInfo& camera);

/// geometry_msgs/TransformStamped: the child frame's pose in the header's frame.
struct Transform {
    std::string frame;
    std::string child_frame;
    Pose pose;
};
/// tf2_msgs/TFMessage
[[nodiscard]] std::string transforms(Version version, std::uint64_t time_ns,
                                     std::span<const Transform> all);

/// sensor_msgs/Imu without orientation. `rate_rps`: angular rate; `force_mps2`: specific force.
[[nodiscard]] std::string imu(Version version, const Header& header,
                              const std::array<double, 3>& rate_rps,
                              const std::array<double, 3>& force_mps2);

/// A box of visualization_msgs/MarkerArray that stays until one of the same topic, `group` and
/// `id` replaces it.
struct BoxMarker {
    std::string group;
    int id = 0;
    Pose pose;  // of the centre
    Eigen::Vector3d size = Eigen::Vector3d::Zero();
    std::array<float, 4> color = {};  // red, green, blue, opacity; 0 to 1
    std::string text;
};
[[nodiscard]] std::string boxMarkers(Version version, const Header& header,
                                     std::span<const BoxMarker> boxes);

/// nav_msgs/Path
struct TimedPose {
    std::uint64_t time_ns = 0;
    Pose pose;
};
[[nodiscard]] std::string path(Version version, const Header& header,
                               std::span<const TimedPose> poses);

/// std_msgs/String
[[nodiscard]] std::string text(Version version, std::string_view value);

}  // namespace dollytrack::gather::ros
