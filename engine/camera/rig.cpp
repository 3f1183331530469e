#include "engine/camera/rig.h"

#include "engine/camera/lens_model.h"
#include "engine/math/angle.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace dollytrack {
namespace {

constexpr std::size_t kMostCameras = 64;
constexpr std::size_t kLongestName = 40;
constexpr double kWidestPinhole = 150.0;  // deg, the limit of the planned camera too
// A fisheye image is resampled from pinhole images. Their largest side, in pixels and relative to
// the larger side of the fisheye image; usual lenses need 1.2 times.
constexpr double kMostSide_px = 6144.0;
constexpr double kMostSideOfSize = 2.5;

/// Side of a pinhole image with the resolution of the finest part of a lens with one centre.
double sidePx(const LensModel& lens) {
    // Wide lenses are rendered as the sides of a cube, with overlapping borders.
    constexpr double kMostReach = 1.2;
    return 2.0 * lens.mostPxPerRadian() *
           std::min(std::tan(std::min(lens.widest(), 1.0)), kMostReach);
}

bool isFolderName(const std::string& name) {
    if (name.empty() || name.size() > kLongestName || name.front() == '-') return false;
    for (const char c : name) {
        const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                           (c >= '0' && c <= '9') || c == '_' || c == '-';
        if (!plain) return false;
    }
    return true;
}

/// The level orientation with the same heading: x made horizontal, y down.
Eigen::Quaterniond levelled(const Eigen::Quaterniond& rotation) {
    Eigen::Vector3d right = rotation * Eigen::Vector3d::UnitX();
    right.z() = 0.0;
    if (right.norm() < 1e-6) {  // rolled by 90 degrees: the heading is that of the forward axis
        const Eigen::Vector3d forward = rotation * Eigen::Vector3d::UnitZ();
        right = {forward.y(), -forward.x(), 0.0};
    }
    if (right.norm() < 1e-6) right = Eigen::Vector3d::UnitX();
    right.normalize();
    const Eigen::Vector3d down = -Eigen::Vector3d::UnitZ();
    Eigen::Matrix3d axes;
    axes << right, down, right.cross(down);
    return Eigen::Quaterniond(axes);
}

Status refuse(const RigCamera& camera, std::string message) {
    return fail(ErrorCode::Usage, std::move(message), fmt::format("camera '{}'", camera.name));
}

Status validateLens(const RigCamera& camera) {
    if (camera.lens == Lens::Pinhole && camera.fov_deg > kWidestPinhole) {
        return refuse(
            camera,
            fmt::format(
                "A pinhole lens cannot see {:g} degrees; use at most {:g}, or lens=fisheye.",
                camera.fov_deg, kWidestPinhole));
    }
    if (camera.lens == Lens::Fisheye && !risesEverywhere(camera)) {
        return refuse(camera,
                      "With these k1 .. k4, two directions within fov_deg map to one pixel; lower "
                      "fov_deg, or check the signs of k1 .. k4.");
    }
    if (camera.lens == Lens::Fisheye) {
        const double side_px = sidePx(LensModel(camera));
        const double most_px =
            std::min(kMostSide_px, kMostSideOfSize * std::max(camera.width_px, camera.height_px));
        if (side_px > most_px) {
            return refuse(
                camera,
                fmt::format("With these k1 .. k4, {:.0f} px per side would have to be "
                            "rendered, more than {:.0f}; lower k1 .. k4 or {}.",
                            side_px, most_px, most_px < kMostSide_px ? "fov_deg" : "width_px"));
        }
    }
    return {};
}

}  // namespace

FieldList listRigCameraFields(RigCamera& camera) {
    FieldCollector collector;
    collector.beginSection("camera");
    visitRigCamera(camera, collector);
    return collector.take();
}

RigCamera standardCamera(Lens lens) {
    RigCamera camera;
    camera.lens = lens;
    if (lens == Lens::Fisheye) {
        camera.width_px = camera.height_px = 640;
        camera.fov_deg = 180.0;
    } else if (lens == Lens::Equirectangular) {
        camera.width_px = 1024;
        camera.height_px = 512;
    }
    return camera;
}

bool usesField(Lens lens, std::string_view field) {
    if (field == "fov_deg") return lens == Lens::Pinhole || lens == Lens::Fisheye;
    if (field == "k1" || field == "k2" || field == "k3" || field == "k4") {
        return lens == Lens::Fisheye;
    }
    if (field == "px_per_m") return lens == Lens::Orthographic;
    return true;
}

std::string_view lensName(Lens lens) {
    constexpr std::array<std::string_view, 4> kNames = {"pinhole", "fisheye", "equirectangular",
                                                        "orthographic"};
    return kNames[static_cast<std::size_t>(lens)];
}

Status validate(const Rig& rig) {
    if (rig.size() > kMostCameras) {
        return fail(ErrorCode::Usage, fmt::format("A rig has up to {} cameras.", kMostCameras),
                    rig.back().name);
    }
    std::set<std::string> names;
    for (const RigCamera& camera : rig) {
        if (!isFolderName(camera.name)) {
            return refuse(camera,
                          "A camera's name becomes a folder: up to 40 letters a to z, digits, _ "
                          "and -, not starting with -.");
        }
        if (!names.insert(camera.name).second) {
            return refuse(camera, "Two cameras of the rig have the same name.");
        }
        if (Status status = validateLens(camera); !status) return status;
    }
    return {};
}

Pose carrierFromCamera(const RigCamera& camera) {
    using Eigen::AngleAxisd;
    using Eigen::Vector3d;
    return {{camera.right_m, camera.down_m, camera.forward_m},
            AngleAxisd(camera.yaw_deg * kDegree, Vector3d::UnitY()) *
                AngleAxisd(camera.pitch_deg * kDegree, Vector3d::UnitX()) *
                AngleAxisd(camera.roll_deg * kDegree, Vector3d::UnitZ())};
}

Pose poseOnRig(const RigCamera& camera, const Pose& planned) {
    const Pose place = carrierFromCamera(camera);
    const Pose carrier{planned.position,
                       camera.level ? levelled(planned.rotation) : planned.rotation};
    if (place == Pose{}) return carrier;  // bit-identical
    return {carrier.toWorld(place.position), (carrier.rotation * place.rotation).normalized()};
}

nlohmann::json rigJson(const Rig& rig) {
    nlohmann::json list = nlohmann::json::array();
    for (RigCamera camera : rig) {
        const nlohmann::json sections = toJson(listRigCameraFields(camera));
        nlohmann::json& entry = list.emplace_back(nlohmann::json{{"name", camera.name}});
        for (const auto& [name, value] : sections["camera"].items()) {
            if (usesField(camera.lens, name)) entry[name] = value;
        }
    }
    return list;
}

}  // namespace dollytrack
