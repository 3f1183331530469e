#include "render/formats/scenes/gltf.h"

#include "engine/camera/intrinsics.h"
#include "render/formats/scenes/gltf_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace dollytrack::render {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<const char*, 1> kGltfFiles = {"trajectory.glb"};

/// Animation keys of one node.
struct Keys {
    std::vector<float> times_s;
    std::vector<Eigen::Vector3f> positions;
    std::vector<Eigen::Vector4f> rotations;  // x, y, z, w

    void add(double time_s, const Eigen::Vector3d& position, const Eigen::Quaterniond& rotation) {
        times_s.push_back(static_cast<float>(time_s));
        positions.push_back(position.cast<float>());
        Eigen::Vector4f values = rotation.normalized().coeffs().cast<float>();
        // Of a rotation's two quaternions, the one nearer to the previous key: readers that
        // interpolate components then take the short way.
        if (!rotations.empty() && values.dot(rotations.back()) < 0.0F) values = -values;
        rotations.push_back(values);
    }
};

/// glTF cameras look along -z, with y up.
Eigen::Quaterniond cameraRotation(const Pose& pose) {
    const Eigen::Quaterniond half_turn(
        Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitX()));
    return gltfFromWorld() * pose.rotation * half_turn;
}

/// The latest time before `time_s` that differs from it as a float.
double justBefore(double time_s, double earlier_s) {
    const double wanted = time_s - 0.001 * (time_s - earlier_s);
    return std::min<double>(wanted, std::nextafter(static_cast<float>(time_s), 0.0F));
}

Keys cameraKeys(const std::vector<DatasetFrame>& frames) {
    Keys keys;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const TrajectoryFrame& frame = frames[i].camera;
        if (i > 0 && frames[i - 1].camera.path != frame.path) {
            // At a jump the camera stays until just before it, instead of flying through walls.
            const TrajectoryFrame& before = frames[i - 1].camera;
            const double until = justBefore(frame.time_s, before.time_s);
            keys.add(until, gltfFromWorld() * before.pose.position, cameraRotation(before.pose));
        }
        keys.add(frame.time_s, gltfFromWorld() * frame.pose.position, cameraRotation(frame.pose));
    }
    return keys;
}

/// Animation keys of a moving object, whose node stands at the centre of its box.
Keys objectKeys(const DatasetContents& contents, const ObjectMotion& motion) {
    const Eigen::Quaterniond turn = gltfFromWorld();
    const Eigen::Vector3d center = contents.scene.object(motion.object_id).box.center;
    Keys keys;
    for (std::size_t i = 0; i < contents.frames.size(); ++i) {
        const Eigen::Isometry3d& moved = motion.by_frame[i];
        keys.add(contents.frames[i].camera.time_s, turn * (moved * center),
                 turn * Eigen::Quaterniond(moved.linear()) * turn.conjugate());
    }
    return keys;
}

/// Adds to the single animation, so that everything moves in sync.
void animate(GlbBuilder& builder, Json& animation, int node, const Keys& keys) {
    const int times = builder.addKeys(keys.times_s);
    const std::array outputs = {
        std::pair{"translation", builder.addKeys(keys.positions)},
        std::pair{"rotation", builder.addKeys(keys.rotations)},
    };
    for (const auto& [path, output] : outputs) {
        animation["channels"].push_back({{"sampler", animation["channels"].size()},
                                         {"target", {{"node", node}, {"path", path}}}});
        animation["samplers"].push_back(
            {{"input", times}, {"output", output}, {"interpolation", "LINEAR"}});
    }
}

Result<std::vector<DatasetFile>> writeGltf(const DatasetContents& contents) {
    GlbBuilder builder;
    Json root = {{"asset", {{"version", "2.0"}, {"generator", "Dollytrack"}}}};
    root["nodes"] = Json::array();
    if (Status status = addSceneNodes(contents.scene, builder, root); !status) {
        return tl::unexpected(status.error());
    }
    const Intrinsics lens = makeIntrinsics(contents.camera);
    root["cameras"] =
        Json::array({{{"name", "camera"},
                      {"type", "perspective"},
                      {"perspective",
                       {{"aspectRatio", static_cast<double>(lens.width) / lens.height},
                        {"yfov", 2.0 * std::atan(0.5 * lens.height / lens.fy)},
                        {"znear", contents.camera.near_m}}}}});
    const Keys keys = cameraKeys(contents.frames);
    const int camera = static_cast<int>(root["nodes"].size());
    root["nodes"].push_back({{"name", "camera"}, {"camera", 0}});
    Json animation = {{"name", "trajectory"}};
    animate(builder, animation, camera, keys);
    for (const ObjectMotion& motion : contents.motions) {
        animate(builder, animation, motion.object_id - 1, objectKeys(contents, motion));
    }
    root["animations"].push_back(std::move(animation));
    Json all = Json::array();
    for (int node = 0; node <= camera; ++node) all.push_back(node);
    root["scenes"] = Json::array({{{"name", contents.scene.name}, {"nodes", std::move(all)}}});
    root["scene"] = 0;
    Result<std::string> file = builder.pack(std::move(root));
    if (!file) return tl::unexpected(file.error());
    return std::vector<DatasetFile>{{kGltfFiles[0], std::move(*file)}};
}

Json gltfConvention(const DatasetContents& /*contents*/) {
    return {{"file", kGltfFiles[0]},
            {"format",
             "glTF 2.0: the scene with one node per object; the camera and moving objects are "
             "animated with a key at each frame's time; metres, y up (x, z, -y of the world)"}};
}

}  // namespace

const Format kGltfFormat = {
    .name = "gltf",
    .text = "the scene with the moving camera, for Blender, Unity ..., in trajectory.glb",
    .group = ContentGroup::Other,
    .files = kGltfFiles,
    .write = writeGltf,
    .convention = gltfConvention,
};

}  // namespace dollytrack::render
