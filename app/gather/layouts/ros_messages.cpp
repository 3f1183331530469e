#include "app/gather/layouts/ros_messages.h"

#include "app/gather/layouts/cdr_writer.h"

#include <utility>

namespace dollytrack::gather::ros {
namespace {

constexpr std::size_t kCovariance = 9;

void add(CdrWriter& cdr, const Header& header) {
    constexpr std::uint64_t kSecond_ns = 1'000'000'000;
    cdr.number(static_cast<std::int32_t>(header.time_ns / kSecond_ns));
    cdr.number(static_cast<std::uint32_t>(header.time_ns % kSecond_ns));
    cdr.text(header.frame);
}

void add(CdrWriter& cdr, const Eigen::Vector3d& v) {
    for (const double value : {v.x(), v.y(), v.z()}) cdr.number(value);
}

/// Position and orientation, of a Pose and of a Transform.
void add(CdrWriter& cdr, const Pose& pose) {
    const Eigen::Quaterniond& q = pose.rotation;
    add(cdr, pose.position);
    for (const double value : {q.x(), q.y(), q.z(), q.w()}) cdr.number(value);
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

std::string compressedImage(const Header& header, std::string_view file, bool is_depth) {
    CdrWriter cdr;
    add(cdr, header);
    cdr.text(formatOf(file, is_depth));
    // The transport's header: a format and two parameters of inverse depth, which 16UC1 lacks.
    const std::string depth_header(is_depth ? sizeof(std::int32_t) + 2 * sizeof(float) : 0, '\0');
    cdr.bytes(depth_header, file);
    return std::move(cdr).take();
}

std::string cameraInfo(const Header& header, const CameraInfo& camera) {
    const double fx = camera.fx, fy = camera.fy, cx = camera.cx, cy = camera.cy;
    CdrWriter cdr;
    add(cdr, header);
    cdr.number(static_cast<std::uint32_t>(camera.height));
    cdr.number(static_cast<std::uint32_t>(camera.width));
    cdr.text(camera.distortion_model);
    cdr.count(camera.distortion.size());
    cdr.numbers(camera.distortion);
    cdr.numbers(std::array{fx, 0.0, cx, 0.0, fy, cy, 0.0, 0.0, 1.0});
    cdr.numbers(std::array{1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0});
    cdr.numbers(std::array{fx, 0.0, cx, 0.0 - fx * camera.baseline_m, 0.0, fy, cy, 0.0, 0.0, 0.0,
                           1.0, 0.0});
    for (int i = 0; i < 6; ++i) cdr.number(std::uint32_t{0});  // binning, region: the whole image
    cdr.number(false);
    return std::move(cdr).take();
}

std::string transforms(std::uint64_t time_ns, std::span<const Transform> all) {
    CdrWriter cdr;
    cdr.count(all.size());
    for (const Transform& one : all) {
        add(cdr, Header{time_ns, one.frame});
        cdr.text(one.child_frame);
        add(cdr, one.pose);
    }
    return std::move(cdr).take();
}

std::string imu(const Header& header, const std::array<double, 3>& rate_rps,
                const std::array<double, 3>& force_mps2) {
    constexpr std::array<double, kCovariance> kUnknown = {};
    std::array<double, kCovariance> no_orientation = {};
    no_orientation[0] = -1.0;
    CdrWriter cdr;
    add(cdr, header);
    cdr.numbers(std::array{0.0, 0.0, 0.0, 1.0});
    cdr.numbers(no_orientation);
    cdr.numbers(rate_rps);
    cdr.numbers(kUnknown);
    cdr.numbers(force_mps2);
    cdr.numbers(kUnknown);
    return std::move(cdr).take();
}

std::string boxMarkers(const Header& header, std::span<const BoxMarker> boxes) {
    constexpr std::int32_t kCube = 1;
    constexpr std::int32_t kAddOrReplace = 0;
    const Header none;
    CdrWriter cdr;
    cdr.count(boxes.size());
    for (const BoxMarker& box : boxes) {
        add(cdr, header);
        cdr.text(box.group);
        cdr.number(static_cast<std::int32_t>(box.id));
        cdr.number(kCube);
        cdr.number(kAddOrReplace);
        add(cdr, box.pose);
        add(cdr, box.size);
        for (const float value : box.color) cdr.number(value);
        cdr.number(std::int32_t{0});  // lifetime: for ever
        cdr.number(std::uint32_t{0});
        cdr.number(false);  // frame_locked
        cdr.count(0);       // points
        cdr.count(0);       // colors
        cdr.text("");       // texture_resource
        add(cdr, none);     // texture
        cdr.text("");
        cdr.bytes("");
        cdr.count(0);  // uv_coordinates
        cdr.text(box.text);
        cdr.text("");  // mesh_resource
        cdr.text("");  // mesh_file
        cdr.bytes("");
        cdr.number(false);  // mesh_use_embedded_materials
    }
    return std::move(cdr).take();
}

std::string path(const Header& header, std::span<const TimedPose> poses) {
    CdrWriter cdr;
    add(cdr, header);
    cdr.count(poses.size());
    for (const TimedPose& one : poses) {
        add(cdr, Header{one.time_ns, header.frame});
        add(cdr, one.pose);
    }
    return std::move(cdr).take();
}

}  // namespace dollytrack::gather::ros
