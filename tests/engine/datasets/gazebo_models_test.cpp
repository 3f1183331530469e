#include "tests/engine/datasets/gazebo_worlds.h"
#include "tests/support/imported_scene.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace dollytrack::gazebo_models_test {
namespace {

using test::expectBox;
using test::find;
using test::imported;
using test::modelAt;
using test::says;
using test::TempFolder;
using test::world;
using test::writeSofa;

TEST(Gazebo, MaterialScriptsGiveColoursAndTextures) {
    const TempFolder folder;
    static_cast<void>(folder.write("models/m/materials/textures/blue.ppm",
                                   "P6\n1 1\n255\n" + std::string(2, '\0') + "\xFF"));
    static_cast<void>(folder.write("models/m/materials/scripts/m.material", R"(
/* material picture { wrong */
material picture // the first technique counts
{
  technique
  {
    pass { diffuse 1 0 0 0  // red, and opaque without blending
      texture_unit { texture blue.ppm
        scale 0.5 0.25 }
      texture_unit { texture other.ppm } }
    pass { diffuse 0 1 0 }
  }
  technique { pass { texture_unit { texture other.ppm } } }
}
material "two words" : picture
{ technique { pass { diffuse 0 0 1 0.5
 scene_blend alpha_blend } } }
material pane : "two words" { technique { pass { texture_unit { texture blue.ppm } } } }
material lost { technique { pass { texture_unit { texture lost.png } } } }
)"));
    const auto painted = [](double x, const std::string& name, const std::string& uri) {
        return modelAt(x, "painted " + name,
                       "<visual name='v'><material><script><uri>" + uri + "</uri><name>" + name +
                           "</name></script></material><geometry><box><size>1 1 1</size></box>"
                           "</geometry></visual>");
    };
    const std::string scripts = "model://m/materials/scripts";
    const Scene scene = imported(folder.write(
        "room.world",
        world(painted(0, "picture", scripts) + painted(2, "two words", scripts) +
              painted(8, "pane", scripts) + painted(4, "lost", scripts + "/m.material") +
              painted(6, "nowhere", scripts))));
    EXPECT_EQ(scene.report.textures_found, 1);
    EXPECT_EQ(scene.report.textures_missing, std::vector<std::string>{"lost.png"});
    EXPECT_TRUE(says(scene.report.warnings, "1 material is in no script that was found"));
    EXPECT_TRUE(says(scene.report.warnings, "--models: nowhere"));
    const auto materialOf = [&](const std::string& name) {
        const Object* object = find(scene, "painted " + name);
        return object == nullptr ? Material{}
                                 : scene.materials[scene.triangle_material[object->first_triangle]];
    };
    EXPECT_TRUE(materialOf("picture").base_color.isApprox(Eigen::Vector3f(1, 0, 0)));
    EXPECT_TRUE(materialOf("two words").base_color.isApprox(Eigen::Vector3f(0, 0, 1)));
    EXPECT_EQ(materialOf("picture").opacity, 1.0F);
    EXPECT_EQ(materialOf("two words").opacity, 0.5F);
    EXPECT_EQ(materialOf("pane").opacity, 0.5F);
    for (const std::string name : {"picture", "two words", "pane"}) {
        ASSERT_GE(materialOf(name).texture, 0) << name;
        EXPECT_EQ(scene.textures[materialOf(name).texture].name, "blue.ppm");
    }
    // A picture of half the width and a quarter of the height lies on each face 2 x 4 times.
    const Object* box = find(scene, "painted picture");
    Eigen::AlignedBox2f uvs;
    for (std::uint32_t i = 0; i < box->vertex_count; ++i) {
        uvs.extend(scene.uvs[box->first_vertex + i]);
    }
    EXPECT_TRUE(uvs.sizes().isApprox(Eigen::Vector2f(2, 4))) << uvs.sizes().transpose();
}

TEST(Gazebo, LinksThatTouchAreOneThingAndGroundsAreNot) {
    const TempFolder folder;
    writeSofa(folder, "models");
    const auto box = [](const std::string& link, const std::string& pose, const std::string& size) {
        return "<link name='" + link + "'><pose>" + pose +
               "</pose><visual name='v'><geometry><box><size>" + size +
               "</size></box></geometry></visual></link>";
    };
    const std::string ground =
        "<visual name='g'><geometry><plane><size>100 100</size></plane></geometry></visual>";
    const Scene scene = imported(folder.write(
        "room.world",
        world("<model name='table'>" + box("top", "2 0 0.7 0 0 0", "1 1 0.1") +
              box("pedestal", "2 0 0.325 0 0 0", "0.2 0.2 0.65") + "</model>" +
              "<model name='hall'>" + box("left", "0 5 1 0 0 0", "10 0.1 2") +
              box("right", "0 -5 1 0 0 0", "10 0.1 2") + "</model>" +
              "<model name='walls'><link name='link'>" + ground +
              "<visual name='w'><pose>5 0 1 0 0 0</pose><geometry><box><size>0.1 10 2</size></box>"
              "</geometry></visual></link></model>" +
              "<include><uri>model:///sofa</uri></include>")));
    expectBox(scene, "table", {1.5, -0.5, 0.0}, {2.5, 0.5, 0.75});
    EXPECT_NE(find(scene, "left"), nullptr) << "too large for one thing";
    EXPECT_NE(find(scene, "sofa"), nullptr) << "three slashes";
    expectBox(scene, "walls", {4.95, -5, 0}, {5.05, 5, 2});
    ASSERT_NE(find(scene, "walls ground"), nullptr);
    EXPECT_TRUE(find(scene, "walls ground")->structure);
    EXPECT_LT(scene.room_bounds.sizes().head<2>().maxCoeff(), 50.0);
}

}  // namespace
}  // namespace dollytrack::gazebo_models_test
