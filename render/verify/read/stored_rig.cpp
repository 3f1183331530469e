#include "render/verify/read/stored_rig.h"

#include "engine/io/files/bounded_json.h"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dollytrack::verify {
namespace {

using OrderedJson = nlohmann::ordered_json;

constexpr double kPi = std::numbers::pi;
constexpr int kLargestSide = 1 << 14;

Pose poseFrom(const OrderedJson& value, double* length = nullptr) {
    const auto p = value.at("position").get<std::array<double, 3>>();
    const auto q = value.at("quaternion_xyzw").get<std::array<double, 4>>();
    const Eigen::Quaterniond rotation(q[3], q[0], q[1], q[2]);
    if (length) *length = rotation.norm();
    return {{p[0], p[1], p[2]}, rotation.normalized()};
}

bool isPlainName(const std::string& name) {
    return !name.empty() && name.find_first_of("/\\") == std::string::npos && name != "." &&
           name != "..";
}

StoredCamera cameraFrom(const OrderedJson& one) {
    StoredCamera camera;
    camera.name = one.at("name").get<std::string>();
    camera.lens = one.at("lens").get<std::string>();
    const OrderedJson& lens = one.at("intrinsics");
    camera.width = lens.at("width").get<int>();
    camera.height = lens.at("height").get<int>();
    const auto number = [&](const char* key) { return lens.at(key).get<double>(); };
    if (camera.lens != "equirectangular") {
        camera.cx = number("cx");
        camera.cy = number("cy");
    }
    if (camera.lens == "pinhole") {
        camera.focal = number("fx");
    } else if (camera.lens == "orthographic") {
        camera.focal = number("px_per_m");
    } else if (camera.lens == "fisheye") {
        camera.focal = number("f");
        camera.k = {number("k1"), number("k2"), number("k3"), number("k4")};
        camera.widest = number("fov_deg") * kPi / 360.0;
    }
    camera.range = one.at("depth").at("kind") == "range";
    camera.level = one.at("level").get<bool>();
    camera.carrier_from_camera = poseFrom(one.at("carrier_from_camera"), &camera.mount_length);
    for (const OrderedJson& pose : one.at("poses")) {
        camera.poses.push_back(poseFrom(pose, &camera.quaternion_lengths.emplace_back()));
    }
    return camera;
}

std::string problemOf(const StoredCamera& camera, std::size_t frames) {
    constexpr std::array kLenses = {"pinhole", "fisheye", "equirectangular", "orthographic"};
    if (!isPlainName(camera.name)) return "an invalid folder name";
    if (std::ranges::find(kLenses, camera.lens) == kLenses.end()) {
        return "an unknown lens: " + camera.lens;
    }
    const auto isSide = [](int px) { return px >= 1 && px <= kLargestSide; };
    if (!isSide(camera.width) || !isSide(camera.height)) return "invalid image sizes";
    if (camera.lens != "equirectangular" && !(camera.focal > 0.0)) return "no focal length";
    const bool wide = camera.lens == "fisheye" || camera.lens == "equirectangular";
    if (camera.range != wide) return "a depth kind that does not match its lens";
    if (camera.poses.size() != frames) return fmt::format("{} poses", camera.poses.size());
    return {};
}

double bent(const std::array<double, 4>& k, double t) {
    double power = t, sum = t;
    for (const double one : k) sum += one * (power *= t * t);
    return sum;
}

}  // namespace

std::string StoredCamera::file(const char* image, int frame) const {
    return fmt::format("cameras/{}/{}/{:06}.png", name, image, frame);
}

std::optional<StoredRay> StoredCamera::rayThrough(double x, double y) const {
    if (lens == "equirectangular") {
        const double east = (2.0 * x / width - 1.0) * kPi;
        const double down = (y / height - 0.5) * kPi;
        return StoredRay{
            Eigen::Vector3d::Zero(),
            {std::sin(east) * std::cos(down), std::sin(down), std::cos(east) * std::cos(down)}};
    }
    const Eigen::Vector2d aside((x - cx) / focal, (y - cy) / focal);
    if (lens == "orthographic") return StoredRay{{aside.x(), aside.y(), 0.0}, {0.0, 0.0, 1.0}};
    if (lens == "pinhole") return StoredRay{{0.0, 0.0, 0.0}, {aside.x(), aside.y(), 1.0}};
    const double wanted = aside.norm();
    if (wanted > bent(k, widest) * (1.0 + 1e-9)) return std::nullopt;
    double low = 0.0, high = widest;  // bisection; the function is increasing
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (bent(k, middle) < wanted ? low : high) = middle;
    }
    if (wanted == 0.0) return StoredRay{};
    const Eigen::Vector2d to = std::sin(low) / wanted * aside;
    return StoredRay{Eigen::Vector3d::Zero(), {to.x(), to.y(), std::cos(low)}};
}

Pose StoredCamera::expectedPose(const Pose& planned) const {
    Eigen::Matrix3d carrier = planned.rotation.toRotationMatrix();
    if (level) {
        const Eigen::Vector3d down(0.0, 0.0, -1.0);
        const Eigen::Vector3d ahead = Eigen::Vector3d(carrier.col(0)).cross(down).normalized();
        carrier << down.cross(ahead), down, ahead;
    }
    return {planned.position + carrier * carrier_from_camera.position,
            Eigen::Quaterniond(carrier) * carrier_from_camera.rotation};
}

Result<std::vector<StoredCamera>> readStoredRig(const StoredDataset& dataset) {
    const std::string where = (dataset.folder / "dataset.json").string();
    std::vector<StoredCamera> cameras;
    try {
        for (const OrderedJson& one : dataset.card.at("cameras")) {
            cameras.push_back(cameraFrom(one));
            const std::string problem = problemOf(cameras.back(), dataset.frames.size());
            if (problem.empty()) continue;
            return fail(ErrorCode::BadInput,
                        fmt::format("cameras[{}] has {}; export the dataset again.",
                                    cameras.size() - 1, problem),
                        where);
        }
    } catch (const nlohmann::json::exception& error) {
        return fail(ErrorCode::BadInput,
                    fmt::format("A field of \"cameras\" is missing or has the wrong type ({}); "
                                "export the dataset again.",
                                plainReason(error)),
                    where);
    }
    return cameras;
}

std::vector<std::string> rigImageFiles(const StoredDataset& dataset) {
    std::vector<std::string> files;
    if (!dataset.has("cameras")) return files;
    const auto rig = readStoredRig(dataset);
    if (!rig) return files;
    for (const StoredCamera& camera : *rig) {
        for (const char* const image : kStoredRigImages) {
            for (int i = 0; i < static_cast<int>(dataset.frames.size()); ++i) {
                files.push_back(camera.file(image, i));
            }
        }
    }
    return files;
}

}  // namespace dollytrack::verify
