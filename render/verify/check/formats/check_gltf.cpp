#include "engine/io/files/bounded_json.h"
#include "render/verify/check/check_list.h"
#include "render/verify/read/glb_file.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <set>

namespace dollytrack::verify {
namespace {

constexpr const char* kGltfFile = "trajectory.glb";

/// m and radians near the origin; the file has 32-bit floats with 24 bits of precision.
constexpr double kGltfTolerance = 1e-6;
constexpr double kFloatStep = 1.2e-7;

/// y up: (x, z, -y) of the world.
Eigen::Matrix3d gltfFromWorld() {
    Eigen::Matrix3d turn;
    turn << 1, 0, 0, 0, 0, 1, 0, -1, 0;
    return turn;
}

struct ExpectedKey {
    Eigen::Vector3d position;
    Eigen::Matrix3d rotation;
};

/// Checks a node's animation at the time of each frame.
class NodeCheck {
  public:
    NodeCheck(const StoredDataset& dataset, const NodeKeys& keys, std::string name,
              Findings& findings)
        : dataset_(dataset), keys_(keys), name_(std::move(name)), findings_(findings) {}

    template <class Expected>
    void run(Expected&& expected) {
        std::size_t key = 0;
        for (std::size_t i = 0; i < dataset_.frames.size(); ++i) {
            const StoredFrame& frame = dataset_.frames[i];
            while (key + 1 < keys_.times_s.size() && awayAt(key + 1, frame) <= awayAt(key, frame)) {
                ++key;
            }
            compare(key, static_cast<int>(i), expected(frame));
        }
    }

  private:
    [[nodiscard]] double awayAt(std::size_t key, const StoredFrame& frame) const {
        return std::abs(static_cast<double>(keys_.times_s[key]) - frame.time_s);
    }

    void compare(std::size_t key, int frame, const ExpectedKey& expected) {
        const auto wrong = [&](std::string found, std::string right) {
            findings_.add({kGltfFile, frame, {}, name_ + ": " + found, std::move(right)});
        };
        const StoredFrame& stored = dataset_.frames[frame];
        if (!(awayAt(key, stored) <= kGltfTolerance + kFloatStep * std::abs(stored.time_s))) {
            return wrong(fmt::format("its nearest key is at {:.7g} s", keys_.times_s[key]),
                         fmt::format("{:.7f} s", stored.time_s));
        }
        const double away = (keys_.translations[key].cast<double>() - expected.position).norm();
        if (!(away <= kGltfTolerance + kFloatStep * expected.position.norm())) {
            wrong(fmt::format("{:.3g} m off", away), "the position in dataset.json");
        }
        const Eigen::Vector4d q = keys_.rotations[key].cast<double>();
        const Eigen::Matrix3d rotation =
            Eigen::Quaterniond(q.w(), q.x(), q.y(), q.z()).normalized().toRotationMatrix();
        const double turned = (rotation - expected.rotation).norm() / std::sqrt(2.0);
        if (!(turned <= kGltfTolerance && std::abs(q.norm() - 1.0) <= kGltfTolerance)) {
            wrong(fmt::format("turned by {:.3g} rad", turned), "the rotation in dataset.json");
        }
    }

    const StoredDataset& dataset_;
    const NodeKeys& keys_;
    std::string name_;
    Findings& findings_;
};

void checkNode(const StoredDataset& dataset, const GlbFile& file, int node, const std::string& name,
               Findings& findings, const std::function<ExpectedKey(const StoredFrame&)>& expected) {
    if (node < 0) return findings.add({kGltfFile, {}, {}, "no node " + name, "one"});
    const Result<NodeKeys> keys = file.keys(node);
    if (!keys) return findings.add({kGltfFile, {}, {}, name + ": " + keys.error().message, "keys"});
    NodeCheck(dataset, *keys, name, findings).run(expected);
}

void checkLens(const StoredDataset& dataset, const nlohmann::json& root, Findings& findings) {
    const auto& lens = root.at("cameras").at(0).at("perspective");
    const double yfov = 2.0 * std::atan(0.5 * dataset.lens.height / dataset.lens.fy);
    if (std::abs(lens.at("yfov").get<double>() - yfov) <= kGltfTolerance) return;
    findings.add({kGltfFile,
                  {},
                  {},
                  fmt::format("yfov {:.7g}", lens.at("yfov").get<double>()),
                  fmt::format("{:.7g}", yfov)});
}

}  // namespace

CheckWork beginGltf(const Subject& subject, Findings& findings) {
    const StoredDataset& dataset = subject.dataset;
    const Result<GlbFile> file = GlbFile::read(dataset.folder / kGltfFile);
    if (!file) {
        findings.add({kGltfFile, {}, {}, file.error().message, "glTF 2.0"});
        return {};
    }
    const Eigen::Matrix3d turn = gltfFromWorld();
    // glTF cameras look along -z, with y up.
    const Eigen::Matrix3d half_turn =
        Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitX()).toRotationMatrix();
    try {
        checkLens(dataset, file->json(), findings);
        int camera = -1;
        const auto& nodes = file->json().at("nodes");
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            if (nodes[i].contains("camera")) camera = static_cast<int>(i);
        }
        checkNode(dataset, *file, camera, "the camera", findings, [&](const StoredFrame& frame) {
            return ExpectedKey{turn * frame.pose.position,
                               turn * frame.pose.rotation.toRotationMatrix() * half_turn};
        });
        std::set<int> moving;
        for (const StoredFrame& frame : dataset.frames) {
            for (const MovedObject& moved : frame.moving) moving.insert(moved.object_id);
        }
        for (const int id : moving) {
            const StoredObject* object = dataset.object(id);
            if (!object) continue;  // reported by another check
            // Nodes are in the order of the objects.
            checkNode(dataset, *file, id - 1, object->name, findings,
                      [&](const StoredFrame& frame) {
                          const Eigen::Isometry3d* movement = frame.movement(id);
                          const Eigen::Isometry3d now =
                              movement ? *movement : Eigen::Isometry3d::Identity();
                          return ExpectedKey{turn * (now * object->box.center),
                                             turn * now.linear() * turn.transpose()};
                      });
        }
    } catch (const nlohmann::json::exception& error) {
        findings.add({kGltfFile, {}, {}, plainReason(error), "a scene with an animated camera"});
    }
    return {};
}

}  // namespace dollytrack::verify
