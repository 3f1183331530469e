#include "app/gather/layouts/ros_messages.h"

#include "app/gather/layouts/message_writer.h"

#include <utility>

namespace dollytrack::gather::ros {
namespace {

constexpr std::size_t kCovariance = 9;

void add(MessageWriter& out, const Header& header) {
    constexpr std::uint64_t kSecond_ns = 1'000'000'000;
    if (out.version() == Version::Ros1) out.number(static_cast<std::uint32_t>(header.sequence));
    out.number(static_cast<std::uint32_t>(header.time_ns / kSecond_ns));
    out.number(static_cast<std::uint32_t>(header.time_ns % kSecond_ns));
    out.text(header.frame);
}

void add(MessageWriter& out, const Eigen::Vector3d& v) {
    for (const double value : {v.x(), v.y(), v.z()}) out.number(value);
}

/// Position and orientation, of a Pose and of a Transform.
void add(MessageWriter& out, const Pose& pose) {
    const Eigen::Quaterniond& q = pose.rotation;
    add(out, pose.position);
    for (const double value : {q.x(), q.y(), q.z(), q.w()}) out.number(value);
}

/// The image's encoding and file format, as image_transport writes and reads it. Images of 8 bits
/// need no encoding.
std::string formatOf(std::string_view file, bool is_depth) {
    constexpr std::size_t kBitsAt = 24;  // in a PNG file; its colour type follows
    if (file.starts_with("\xFF\xD8")) return "jpeg";
    if (is_depth) return "16UC1; compressedDepth png";
    if (file.size() < kBitsAt + 2 || file[kBitsAt] != 16) return "png";
    return file[kBitsAt + 1] == 0 ? "mono16; png compressed " : "rgb16; png compressed bgr16";
}

}  // namespace

std::string compressedImage(Version version, const Header& header, std::string_view file,
                            bool is_depth) {
    MessageWriter out(version);
    add(out, header);
    out.text(formatOf(file, is_depth));
    // The transport's header: a format and two parameters of inverse depth, which 16UC1 lacks.
    const std::string depth_header(is_depth ? sizeof(std::int32_t) + 2 * sizeof(float) : 0, '\0');
    out.bytes(depth_header, file);
    return std::move(out).take();
}

std::string cameraInfo(Version version, const Header& header, const CameraInfo& camera) {
    const double fx = camera.fx, fy = camera.fy, cx = camera.cx, cy = camera.cy;
    MessageWriter out(version);
    add(out, header);
    out.number(static_cast<std::uint32_t>(camera.height));
    out.number(static_cast<std::uint32_t>(camera.width));
    out.text(camera.distortion_model);
    out.count(camera.distortion.size());
    out.numbers(camera.distortion);
    out.numbers(std::array{fx, 0.0, cx, 0.0, fy, cy, 0.0, 0.0, 1.0});
    out.numbers(std::array{1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0});
    out.numbers(std::array{fx, 0.0, cx, 0.0 - fx * camera.baseline_m, 0.0, fy, cy, 0.0, 0.0, 0.0,
                           1.0, 0.0});
    for (int i = 0; i < 6; ++i) out.number(std::uint32_t{0});  // binning, region: the whole image
    out.number(false);
    return std::move(out).take();
}

std::string transforms(Version version, std::uint64_t time_ns, std::span<const Transform> all) {
    MessageWriter out(version);
    out.count(all.size());
    for (const Transform& one : all) {
        add(out, Header{time_ns, one.frame});
        out.text(one.child_frame);
        add(out, one.pose);
    }
    return std::move(out).take();
}

std::string imu(Version version, const Header& header, const std::array<double, 3>& rate_rps,
                const std::array<double, 3>& force_mps2) {
    constexpr std::array<double, kCovariance> kUnknown = {};
    std::array<double, kCovariance> no_orientation = {};
    no_orientation[0] = -1.0;
    MessageWriter out(version);
    add(out, header);
    out.numbers(std::array{0.0, 0.0, 0.0, 1.0});
    out.numbers(no_orientation);
    out.numbers(rate_rps);
    out.numbers(kUnknown);
    out.numbers(force_mps2);
    out.numbers(kUnknown);
    return std::move(out).take();
}

std::string boxMarkers(Version version, const Header& header, std::span<const BoxMarker> boxes) {
    constexpr std::int32_t kCube = 1;
    constexpr std::int32_t kAddOrReplace = 0;
    const Header none;
    MessageWriter out(version);
    out.count(boxes.size());
    for (const BoxMarker& box : boxes) {
        add(out, header);
        out.text(box.group);
        out.number(static_cast<std::int32_t>(box.id));
        out.number(kCube);
        out.number(kAddOrReplace);
        add(out, box.pose);
        add(out, box.size);
        for (const float value : box.color) out.number(value);
        out.number(std::int32_t{0});  // lifetime: for ever
        out.number(std::uint32_t{0});
        out.number(false);  // frame_locked
        out.count(0);       // points
        out.count(0);       // colors
        if (version == Version::Ros2) {
            out.text("");    // texture_resource
            add(out, none);  // texture
            out.text("");
            out.bytes("");
            out.count(0);  // uv_coordinates
        }
        out.text(box.text);
        out.text("");  // mesh_resource
        if (version == Version::Ros2) {
            out.text("");  // mesh_file
            out.bytes("");
        }
        out.number(false);  // mesh_use_embedded_materials
    }
    return std::move(out).take();
}

std::string path(Version version, const Header& header, std::span<const TimedPose> poses) {
    MessageWriter out(version);
    add(out, header);
    out.count(poses.size());
    for (const TimedPose& one : poses) {
        add(out, Header{one.time_ns, header.frame});
        add(out, one.pose);
    }
    return std::move(out).take();
}

std::string text(Version version, std::string_view value) {
    MessageWriter out(version);
    out.text(value);
    return std::move(out).take();
}

}  // namespace dollytrack::gather::ros
