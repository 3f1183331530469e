#include "engine/scene/labels.h"
#include "tests/engine/datasets/tiny_datasets.h"
#include "tests/support/imported_scene.h"

#include <gtest/gtest.h>

#include <string>

namespace dollytrack {
namespace {

using Eigen::Vector3d;
using test::find;
using test::imported;
using test::says;
using test::TempFolder;

Eigen::AlignedBox3d boxAround(const Scene& scene, const std::string& name) {
    Eigen::AlignedBox3d box;
    const Object* object = find(scene, name);
    if (object == nullptr) return box;
    for (std::uint32_t i = 0; i < object->vertex_count; ++i) {
        box.extend(scene.positions[object->first_vertex + i].cast<double>());
    }
    return box;
}

void expectAround(const Scene& scene, const std::string& name, const Vector3d& low,
                  const Vector3d& high) {
    const Eigen::AlignedBox3d box = boxAround(scene, name);
    EXPECT_TRUE(!box.isEmpty() && (box.min() - low).norm() < 1e-4 && (box.max() - high).norm() < 1e-4)
        << name << ": " << box.min().transpose() << " to " << box.max().transpose();
}

void writeSofa(const TempFolder& folder, const std::string& models) {
    static_cast<void>(folder.write(models + "/sofa/model.config",
                                   "<model><name>sofa</name><sdf version='1.4'>old.sdf</sdf>"
                                   "<sdf version='1.6'>model.sdf</sdf></model>"));
    static_cast<void>(folder.write(models + "/sofa/meshes/l.obj", test::lShapedModel()));
    static_cast<void>(folder.write(models + "/sofa/model.sdf", R"(<sdf version="1.6"><model name="sofa">
 <pose>0 0 10 0 0 0</pose>
 <link name="link"><pose>0 0 1 0 0 0</pose>
  <visual name="v"><geometry><mesh><uri>model://sofa/meshes/l.obj</uri><scale>1 2 1</scale></mesh></geometry></visual>
  <collision name="c"><geometry><box><size>9 9 9</size></box></geometry></collision>
 </link></model></sdf>)"));
}

std::string world(const std::string& models) {
    return "<?xml version='1.0'?><sdf version='1.7'><world name='w'>" + models + "</world></sdf>";
}

// The L is 2 x 0.5 x 2, x from -1 to 1, y from 0 to 0.5, z from -0.5 to 1.5; here y is doubled.
TEST(Gazebo, PlacesIncludedModelsAndShapes) {
    const TempFolder folder;
    writeSofa(folder, "models");
    const Scene scene = imported(folder.write("worlds/room.world", world(R"(
 <include><uri>model://sofa</uri><name>couch</name><pose>5 0 0 0 0 1.5707963267948966</pose></include>
 <model name="sofa_1"><include><uri>model://sofa/</uri></include><pose degrees="true">0 7 0 0 0 90</pose></model>
 <model name="house"><static>1</static>
  <link name="floor"><visual name="v"><geometry><box><size>20 20 0.2</size></box></geometry>
   <material><diffuse>1 0 0 1</diffuse></material></visual></link>
  <frame name="corner"><pose>1 2 3 0 0 0</pose></frame>
  <link name="column"><pose relative_to="corner">1 0 0 0 0 0</pose><visual name="v"><geometry>
   <cylinder><radius>0.5</radius><length>2</length></cylinder></geometry></visual></link>
  <link name="ball"><pose relative_to="column">0 0 2 0 0 0</pose><visual name="v"><geometry>
   <sphere><radius>0.25</radius></sphere></geometry></visual></link></model>
 <model name="cabinet"><link name="body"><visual name="v"><geometry><box><size>1 1 1</size></box></geometry></visual></link>
  <link name="door"><pose>0 -0.55 0 0 0 0</pose><visual name="v"><geometry><box><size>1 0.1 1</size></box></geometry></visual></link>
  <joint name="hinge" type="revolute"><parent>body</parent><child>door</child></joint></model>
 <include><uri>model://lamp</uri></include>)")));
    // An <include> without a pose of its own keeps the model's.
    expectAround(scene, "couch", {4.0, -1.0, 0.5}, {5.0, 1.0, 2.5});
    expectAround(scene, "sofa_1", {-1.0, 6.0, 10.5}, {0.0, 8.0, 12.5});
    expectAround(scene, "floor", {-10, -10, -0.1}, {10, 10, 0.1});
    EXPECT_EQ(find(scene, "floor")->nyu40, kNyuFloor);
    expectAround(scene, "column", {1.5, 1.5, 2.0}, {2.5, 2.5, 4.0});
    expectAround(scene, "ball", {1.75, 1.75, 4.75}, {2.25, 2.25, 5.25});
    expectAround(scene, "cabinet", {-0.5, -0.6, -0.5}, {0.5, 0.5, 0.5});
    EXPECT_EQ(find(scene, "door"), nullptr) << "a joint holds it to the cabinet";
    EXPECT_TRUE(says(scene.report.warnings, "model://lamp"));
    const Object* floor = find(scene, "floor");
    const Material& red = scene.materials[scene.triangle_material[floor->first_triangle]];
    EXPECT_TRUE(red.base_color.isApprox(Eigen::Vector3f(1, 0, 0)));
}

TEST(Gazebo, ModelsComeFromTheFoldersThatAreGiven) {
    const TempFolder folder;
    writeSofa(folder, "elsewhere/shared");
    const auto path =
        folder.write("here/room.sdf", world("<include><uri>model://sofa</uri></include>"));
    const Result<Scene> alone = importScene(path);
    ASSERT_FALSE(alone);
    EXPECT_NE(alone.error().message.find("model://sofa"), std::string::npos);
    const Scene scene = imported(path, {.model_folders = {folder.path() / "elsewhere/shared"}});
    expectAround(scene, "sofa", {-1, 0, 10.5}, {1, 1, 12.5});
    // A model's own file is a scene, too, and finds itself.
    EXPECT_NE(find(imported(folder.path() / "elsewhere/shared/sofa/model.sdf"), "sofa"), nullptr);
}

TEST(Gazebo, CirclesAndNonsenseAreRefused) {
    const TempFolder folder;
    static_cast<void>(folder.write("models/a/model.sdf",
                                   "<sdf version='1.6'><model name='a'><include><uri>model://a</uri>"
                                   "</include><include><uri>model://a</uri></include></model></sdf>"));
    const char* const kWorlds[] = {
        "<include><uri>model://a</uri></include>",
        "<model name='m'><link name='l'><pose relative_to='l'>0 0 0 0 0 0</pose></link></model>",
        "<model name='m'><link name='l'><pose>0 0 nan 0 0 0</pose></link></model>",
        "<model name='m'><link name='l'><visual name='v'><geometry><sphere><radius>-1</radius>"
        "</sphere></geometry></visual></link></model>",
        "<include><uri>file:///etc/passwd</uri></include>",
        "<model name='m'><link name='l'><visual name='v'><geometry><mesh><uri>../../../etc/x.obj"
        "</uri></mesh></geometry></visual></link></model>"};
    for (const char* text : kWorlds) {
        const Result<Scene> scene = importScene(folder.write("room.world", world(text)));
        ASSERT_FALSE(scene) << text;
        EXPECT_EQ(scene.error().code, ErrorCode::BadInput) << text;
    }
    const Result<Scene> damaged = importScene(folder.write("cut.world", "<sdf><world name='w'>"));
    ASSERT_FALSE(damaged);
    EXPECT_NE(damaged.error().message.find("damaged or was cut off"), std::string::npos);
}

// A chain of two joints: each child's origin counts from its parent's.
TEST(Urdf, LinksStandWhereJointsPutThem) {
    const TempFolder folder;
    static_cast<void>(folder.write("pkg/package.xml", "<package/>"));
    static_cast<void>(folder.write("pkg/meshes/l.obj", test::lShapedModel()));
    const Scene scene = imported(folder.write("pkg/urdf/room.urdf", R"(<robot name="room">
 <material name="blue"><color rgba="0 0 1 1"/></material>
 <link name="base"><visual><geometry><box size="2 2 0.2"/></geometry><material name="blue"/></visual></link>
 <joint name="a" type="fixed"><origin xyz="0 0 1" rpy="0 0 1.5707963267948966"/><parent link="base"/><child link="arm"/></joint>
 <link name="arm"><visual><origin xyz="1 0 0"/><geometry><cylinder radius="0.5" length="1"/></geometry></visual></link>
 <joint name="b" type="revolute"><origin xyz="2 0 0"/><parent link="arm"/><child link="sofa"/></joint>
 <link name="sofa"><visual><geometry><mesh filename="package://other_name/meshes/l.obj" scale="1 1 2"/></geometry></visual></link>
</robot>)"));
    expectAround(scene, "base", {-1, -1, -0.1}, {1, 1, 0.1});
    expectAround(scene, "arm", {-0.5, 0.5, 0.5}, {0.5, 1.5, 1.5});
    // Turned by 90 degrees, (x, y, z) becomes (-y, x, z); z is doubled.
    expectAround(scene, "sofa", {-0.5, 1.0, 0.0}, {0.0, 3.0, 4.0});
    const Object* base = find(scene, "base");
    EXPECT_TRUE(scene.materials[scene.triangle_material[base->first_triangle]].base_color.isApprox(
        Eigen::Vector3f(0, 0, 1)));
    const Result<Scene> circle = importScene(folder.write("circle.urdf", R"(<robot name="r">
 <link name="a"/><link name="b"/>
 <joint name="1"><parent link="a"/><child link="b"/></joint>
 <joint name="2"><parent link="b"/><child link="a"/></joint></robot>)"));
    ASSERT_FALSE(circle);
    EXPECT_NE(circle.error().message.find("hangs on itself"), std::string::npos);
    const Result<Scene> macros = importScene(folder.write(
        "m.urdf", "<robot xmlns:xacro='x' name='r'><xacro:include filename='y'/></robot>"));
    ASSERT_FALSE(macros);
    EXPECT_NE(macros.error().message.find("xacro"), std::string::npos);
}

}  // namespace
}  // namespace dollytrack
