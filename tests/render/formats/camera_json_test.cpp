#include "render/formats/poses/camera_json.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace dollytrack::render::camera_json_test {
namespace {

Eigen::Vector3d vectorOf(const nlohmann::json& value) {
    return {value.at(0).get<double>(), value.at(1).get<double>(), value.at(2).get<double>()};
}

nlohmann::json oneEntry(const Scene& scene) {
    CameraEntry entry;
    entry.frame.pose = lookAt({1, 2, 1.5}, {3, 2, 1.5});
    entry.frame.target_in_world = {3, 2, 1.5};
    entry.room = "room 1";
    entry.targets = {"sofa"};
    return nlohmann::json::parse(cameraJsonText(scene, {}, 20.0, {entry})).at(0);
}

TEST(CameraJson, AScenewithZUpTurnsIntoYUp) {
    const nlohmann::json entry = oneEntry(Scene{});
    EXPECT_TRUE(vectorOf(entry.at("pos")).isApprox(Eigen::Vector3d(1, 1.5, -2)));
    EXPECT_TRUE(vectorOf(entry.at("target")).isApprox(Eigen::Vector3d(3, 1.5, -2)));
    EXPECT_TRUE(vectorOf(entry.at("up")).isApprox(Eigen::Vector3d(0, 1, 0)));
    EXPECT_DOUBLE_EQ(entry.at("fov").get<double>(), 60.0);
    EXPECT_EQ(entry.at("targets"), nlohmann::json::array({"sofa"}));
}

// A source in centimetres, y up, turned about its up axis: the poses keep its axes but are in
// metres.
TEST(CameraJson, AYUpSourceKeepsItsAxesInMetres) {
    Scene scene;
    scene.report.up_axis = "y";
    Eigen::Matrix3d axes;
    axes << 0, 1, 0, 0, 0, 1, 1, 0, 0;
    scene.source_from_world.linear() = 100.0 * axes;
    scene.source_from_world.translation() = Eigen::Vector3d(50, 0, 0);
    const nlohmann::json entry = oneEntry(scene);
    EXPECT_TRUE(vectorOf(entry.at("pos")).isApprox(Eigen::Vector3d(2.5, 1.5, 1)));
    EXPECT_TRUE(vectorOf(entry.at("up")).isApprox(Eigen::Vector3d(0, 1, 0)));
}

}  // namespace
}  // namespace dollytrack::render::camera_json_test
