#include "render/formats/scenes/gltf.h"

#include "engine/io/import/scene_import.h"
#include "tests/support/scene_builder.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstring>

namespace dollytrack::render::gltf_test {
namespace {

/// A .glb taken apart by hand.
struct Glb {
    nlohmann::json json;
    std::string binary;

    explicit Glb(const std::string& file) {
        std::uint32_t words[5] = {};
        std::memcpy(words, file.data(), sizeof(words));
        EXPECT_EQ(words[1], 2U);
        EXPECT_EQ(words[2], file.size());
        json = nlohmann::json::parse(file.substr(20, words[3]));
        binary = file.substr(20 + words[3] + 8);
    }
    [[nodiscard]] std::vector<float> floats(int accessor, std::size_t width) const {
        const auto& entry = json["accessors"][accessor];
        const auto& view = json["bufferViews"][entry["bufferView"].get<std::size_t>()];
        std::vector<float> values(entry["count"].get<std::size_t>() * width);
        std::memcpy(values.data(), binary.data() + view["byteOffset"].get<std::size_t>(),
                    values.size() * sizeof(float));
        return values;
    }
    /// The keys of the animated camera: times, positions, rotations.
    [[nodiscard]] std::vector<float> keys(const char* path, std::size_t width) const {
        const auto& animation = json["animations"][0];
        for (const auto& channel : animation["channels"]) {
            const auto& sampler = animation["samplers"][channel["sampler"].get<std::size_t>()];
            if (std::string(path) == "time") return floats(sampler["input"], 1);
            if (channel["target"]["path"] == path) return floats(sampler["output"], width);
        }
        return {};
    }
};

class Gltf : public testing::Test {
  protected:
    Gltf() {
        for (int i = 0; i < 5; ++i) {
            DatasetFrame frame;
            frame.camera.time_s = 0.1 * i;
            frame.camera.path = i < 3 ? 0 : 1;
            frame.camera.pose =
                lookAt({1.0 + 0.2 * i, 1.5, 1.2}, {2.0 + std::sin(i), 1.0 + std::cos(i), 0.7});
            contents_.frames.push_back(frame);
        }
    }
    std::string write() {
        const auto files = kGltfFormat.write(contents_);
        EXPECT_TRUE(files);
        return files->front().bytes;
    }
    Scene scene_ = test::furnishedRoom();
    DatasetContents contents_{scene_, {}, {}, {}};
};

// The file is read by assimp, as another program would.
TEST_F(Gltf, HoldsTheSceneWhereItIs) {
    const test::TempFolder folder;
    ImportOptions options;
    options.unit_m = 1.0;
    options.up_axis = 'y';
    const auto read = importScene(folder.write("trajectory.glb", write()), options);
    ASSERT_TRUE(read) << describe(read.error());
    EXPECT_EQ(read->triangles.size(), scene_.triangles.size());
    for (const Object& object : scene_.objects) {
        const auto same = std::find_if(read->objects.begin(), read->objects.end(),
                                       [&](const Object& o) { return o.name == object.name; });
        ASSERT_NE(same, read->objects.end()) << object.name;
        Eigen::AlignedBox3f expected, found;
        for (std::uint32_t v = 0; v < object.vertex_count; ++v) {
            expected.extend(scene_.positions[object.first_vertex + v]);
        }
        for (std::uint32_t v = 0; v < same->vertex_count; ++v) {
            found.extend(read->positions[same->first_vertex + v]);
        }
        EXPECT_LT((expected.min() - found.min()).norm(), 1e-5F) << object.name;
        EXPECT_LT((expected.max() - found.max()).norm(), 1e-5F) << object.name;
    }
}

TEST_F(Gltf, MovesTheCameraAsTheFramesDo) {
    const Glb glb(write());
    const auto times = glb.keys("time", 1);
    const auto positions = glb.keys("translation", 3);
    const auto rotations = glb.keys("rotation", 4);
    // Where the camera jumps, an additional key keeps it at its old position until then.
    ASSERT_EQ(times.size(), 6U);
    ASSERT_EQ(positions.size(), 18U);
    ASSERT_EQ(rotations.size(), 24U);
    for (std::size_t key = 0; key < 6; ++key) {
        const std::size_t frame = key < 3 ? key : key - 1;  // of the pose
        const TrajectoryFrame& expected = contents_.frames[frame].camera;
        if (key == 3) {
            EXPECT_GT(times[3], times[2]);
            EXPECT_LT(times[3], times[4]);
        } else {
            EXPECT_EQ(times[key], static_cast<float>(expected.time_s));
        }
        const Eigen::Vector3f p(&positions[3 * key]);
        const Eigen::Vector3d& at = expected.pose.position;
        EXPECT_LT((p - Eigen::Vector3d(at.x(), at.z(), -at.y()).cast<float>()).norm(), 1e-6F);
        const float* q = &rotations[4 * key];
        const Eigen::Quaternionf turn(q[3], q[0], q[1], q[2]);
        const Eigen::Vector3f looks = turn * -Eigen::Vector3f::UnitZ();
        const Eigen::Vector3d forward = expected.pose.forward();
        EXPECT_LT(
            (looks - Eigen::Vector3d(forward.x(), forward.z(), -forward.y()).cast<float>()).norm(),
            1e-6F);
        EXPECT_GT((turn * Eigen::Vector3f::UnitY()).y(), 0.0F);  // upright, as lookAt() is
        if (key > 0) {
            EXPECT_GE(turn.coeffs().dot(Eigen::Vector4f(q - 4)), 0.0F);
        }
    }
    const auto& lens = glb.json["cameras"][0]["perspective"];
    EXPECT_NEAR(std::tan(0.5 * lens["yfov"].get<double>()) * lens["aspectRatio"].get<double>(),
                std::tan(contents_.camera.hfov_deg * M_PI / 360.0), 1e-12);
}

TEST_F(Gltf, MovesThingsThatMove) {
    const Object& object = scene_.objects.back();
    ObjectMotion motion{object.id, {}};
    for (int i = 0; i < 5; ++i) {
        Eigen::Isometry3d moved = Eigen::Isometry3d::Identity();
        moved.translate(Eigen::Vector3d(0.1 * i, 0, 0.2));
        moved.rotate(Eigen::AngleAxisd(0.3 * i, Eigen::Vector3d::UnitZ()));
        motion.by_frame.push_back(moved);
    }
    contents_.motions = {motion};
    const Glb glb(write());
    const auto& animation = glb.json["animations"][0];
    ASSERT_EQ(animation["channels"].size(), 4U);
    const auto output = [&](std::size_t channel, std::size_t width) {
        EXPECT_EQ(animation["channels"][channel]["target"]["node"], object.id - 1);
        return glb.floats(animation["samplers"][channel]["output"], width);
    };
    const auto positions = output(2, 3), rotations = output(3, 4);
    for (std::size_t i = 0; i < 5; ++i) {
        // A point of the object, computed by its node and by its motion.
        const Eigen::Vector3d offset(0.2, -0.3, 0.1);
        const Eigen::Vector3d expected = motion.by_frame[i] * (object.box.center + offset);
        const float* q = &rotations[4 * i];
        const Eigen::Vector3f found =
            Eigen::Quaternionf(q[3], q[0], q[1], q[2]) *
                Eigen::Vector3d(offset.x(), offset.z(), -offset.y()).cast<float>() +
            Eigen::Vector3f(&positions[3 * i]);
        EXPECT_LT((Eigen::Vector3d(found.x(), -found.z(), found.y()) - expected).norm(), 1e-5);
    }
}

TEST_F(Gltf, GivesTheSameBytesAgain) {
    EXPECT_EQ(write(), write());
}

}  // namespace
}  // namespace dollytrack::render::gltf_test
