#include "engine/scene/labels.h"
#include "tests/engine/datasets/tiny_datasets.h"
#include "tests/support/imported_scene.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

namespace dollytrack::urdf_test {
namespace {

using test::expectBox;
using test::find;
using test::imported;
using test::says;
using test::TempFolder;

// A chain of two joints: each child's origin is relative to its parent.
TEST(Urdf, LinksStandWhereJointsPutThem) {
    const TempFolder folder;
    static_cast<void>(folder.write("pkg/package.xml", "<package/>"));
    static_cast<void>(folder.write("pkg/meshes/l.obj", test::lShapedModel()));
    const Scene scene = imported(folder.write("pkg/urdf/room.urdf", R"(<robot name="room">
 <material name="blue"><color rgba="0 0 1 1"/></material>
 <link name="base"><visual><geometry><box size="-2 2 0.2"/></geometry><material name="blue"/></visual></link>
 <joint name="a" type="fixed"><origin xyz="0 0 1" rpy="0 0 1.5707963267948966"/><parent link="base"/><child link="arm"/></joint>
 <link name="arm"><visual><origin xyz="1 0 0"/><geometry><cylinder radius="0.5" length="1"/></geometry></visual></link>
 <joint name="b" type="fixed"><origin xyz="2 0 0"/><parent link="arm"/><child link="sofa"/></joint>
 <link name="sofa"><visual><geometry><mesh filename="package://other_name/meshes/l.obj" scale="1 1 2"/></geometry></visual></link>
</robot>)"));
    expectBox(scene, "room::base", {-1, -1, -0.1}, {1, 1, 0.1});
    expectBox(scene, "arm", {-0.5, 0.5, 0.5}, {0.5, 1.5, 1.5});
    // Rotation by 90 degrees maps (x, y, z) to (-y, x, z); z is scaled by 2.
    expectBox(scene, "sofa", {-0.5, 1.0, 0.0}, {0.0, 3.0, 4.0});
    const Object* base = find(scene, "room::base");
    EXPECT_TRUE(scene.materials[scene.triangle_material[base->first_triangle]].base_color.isApprox(
        Eigen::Vector3f(0, 0, 1)));
}

// Two long walls are named; the narrow ends between them are only boxes.
TEST(Urdf, WallsWithoutANameInAnEmptyHallwayAreStructure) {
    const TempFolder folder;
    std::string text = R"(<robot name="hall"><link name="base"/>)";
    const auto box = [&](const std::string& name, double x, double y, const char* size) {
        text += fmt::format(
            R"(<link name="{0}"><visual><geometry><box size="{3}"/></geometry></visual></link>
<joint name="j{0}" type="fixed"><origin xyz="{1} {2} 1.5"/><parent link="base"/><child link="{0}"/></joint>)",
            name, x, y, size);
    };
    for (int i = 0; i < 3; ++i) {
        box(fmt::format("left_wall_{}", i), 4.0 * i, 1.5, "4 0.2 3");
        box(fmt::format("right_wall_{}", i), 4.0 * i, -1.5, "4 0.2 3");
    }
    box("side_a", -2.0, 0.0, "0.2 2.8 3");
    box("side_b", 10.0, 1.2, "0.2 0.5 3");
    const Scene scene = imported(folder.write("hall.urdf", text + "</robot>"));
    ASSERT_EQ(scene.objects.size(), 8U);
    for (const Object& object : scene.objects) {
        EXPECT_EQ(object.role, Role::Structure) << object.name;
        EXPECT_EQ(object.nyu40, kNyuWall) << object.name;
    }
}

TEST(Urdf, TexturesCoverShapes) {
    const TempFolder folder;
    static_cast<void>(folder.write("pkg/package.xml", "<package/>"));
    static_cast<void>(
        folder.write("pkg/textures/wood.ppm", "P6\n1 1\n255\n" + std::string(3, '\x80')));
    const Scene scene = imported(folder.write("pkg/urdf/room.urdf", R"(<robot name="room">
 <material name="wood"><texture filename="package://pkg/textures/wood.ppm"/></material>
 <link name="shelf"><visual><geometry><box size="2 2 0.2"/></geometry><material name="wood"/></visual></link>
 <joint name="a" type="fixed"><origin xyz="0 0 1"/><parent link="shelf"/><child link="sink"/></joint>
 <link name="sink"><visual><geometry><cylinder radius="0.5" length="1"/></geometry>
  <material name="steel"><texture filename="textures/steel.png"/></material></visual></link>
</robot>)"));
    EXPECT_EQ(scene.report.textures_found, 1);
    EXPECT_EQ(scene.report.textures_missing, std::vector<std::string>{"steel.png"});
    const Object* shelf = find(scene, "shelf");
    ASSERT_NE(shelf, nullptr);
    const Material& wood = scene.materials[scene.triangle_material[shelf->first_triangle]];
    ASSERT_GE(wood.texture, 0);
    EXPECT_EQ(scene.textures[wood.texture].name, "wood.ppm");
    EXPECT_TRUE(wood.base_color.isOnes());
}

TEST(Urdf, JointsInACircleAreRefused) {
    const TempFolder folder;
    const Result<Scene> circle = importScene(folder.write("circle.urdf", R"(<robot name="r">
 <link name="a"/><link name="b"/>
 <joint name="1"><parent link="a"/><child link="b"/></joint>
 <joint name="2"><parent link="b"/><child link="a"/></joint></robot>)"));
    ASSERT_FALSE(circle);
    EXPECT_NE(circle.error().message.find("form a cycle"), std::string::npos);
}

// The origins of the joints add up to 30 m.
TEST(Urdf, LongChainsAddUp) {
    const TempFolder folder;
    std::string chain =
        "<link name='0'><visual><geometry><box size='1 1 1'/></geometry></visual></link>";
    constexpr int kLinks = 30'000;
    for (int i = 1; i <= kLinks; ++i) {
        const std::string number = std::to_string(i);
        chain += "<joint><origin xyz='0.001 0 0'/><parent link='" + std::to_string(i - 1) +
                 "'/><child link='" + number + "'/></joint><link name='" + number + "'";
        chain +=
            i < kLinks ? "/>" : "><visual><geometry><box size='1 1 1'/></geometry></visual></link>";
    }
    const Scene long_chain =
        imported(folder.write("chain.urdf", "<robot name='r'>" + chain + "</robot>"));
    expectBox(long_chain, fmt::format("r::{}", kLinks), {29.5, -0.5, -0.5}, {30.5, 0.5, 0.5});
}

TEST(Urdf, MaterialsWithoutANameAreTheirVisualsAlone) {
    const TempFolder folder;
    const Scene nameless = imported(folder.write("colors.urdf", R"(<robot name="r">
 <link name="green"><visual><geometry><box size="1 1 1"/></geometry>
  <material name=""><color rgba="0 1 0 1"/></material></visual></link>
 <link name="plain"><visual><origin xyz="5 0 0"/><geometry><box size="1 1 1"/></geometry>
  <material name=""/></visual></link></robot>)"));
    const Object* plain = find(nameless, "plain");
    ASSERT_NE(plain, nullptr);
    EXPECT_GT(nameless.materials[nameless.triangle_material[plain->first_triangle]].base_color.x(),
              0.1F);
}

// Expanded files may mention macros in a comment.
TEST(Urdf, MacrosAreRefusedButInComments) {
    const TempFolder folder;
    EXPECT_EQ(
        imported(folder.write("expanded.urdf",
                              "<robot name='r'><!-- <xacro:arm/> --><link name='l'><visual>"
                              "<geometry><sphere radius='1'/></geometry></visual></link></robot>"))
            .objects.size(),
        1U);
    const Result<Scene> macros = importScene(folder.write(
        "m.urdf", "<robot xmlns:xacro='x' name='r'><xacro:include filename='y'/></robot>"));
    ASSERT_FALSE(macros);
    EXPECT_NE(macros.error().message.find("xacro"), std::string::npos);
}

TEST(Urdf, ShapesThatAreNotReadAreNamed) {
    const Scene scene = test::importedText(
        "<robot name='r'><link name='l'><visual><geometry><sphere radius='1'/></geometry></visual>"
        "<visual><geometry><capsule radius='1' length='2'/></geometry></visual></link></robot>",
        "robot.urdf");
    EXPECT_TRUE(says(scene.report.warnings, "1 visual is left out, since <capsule>"));
}

/// A link with a box of this size.
std::string boxLink(const std::string& name, const std::string& size) {
    return fmt::format(
        "<link name='{}'><visual><geometry><box size='{}'/></geometry></visual></link>\n", name,
        size);
}

std::string joint(const std::string& name, const std::string& type, const std::string& parent,
                  const std::string& child, const std::string& xyz) {
    return fmt::format(
        "<joint name='{}' type='{}'><origin xyz='{}'/><parent link='{}'/><child "
        "link='{}'/></joint>\n",
        name, type, xyz, parent, child);
}

// A cabinet as in SAPIEN: with a sliding drawer and a handle fixed to the drawer.
TEST(Urdf, DrawersAndTheirHandlesAreOfTheirCabinet) {
    const std::string cabinet = "<robot name='cabinet'>\n<link name='base'/>\n" +
                                boxLink("link_0", "1 1 1") + boxLink("link_1", "0.8 0.8 0.2") +
                                boxLink("link_2", "0.1 0.1 0.1") +
                                joint("body", "fixed", "base", "link_0", "0 0 0") +
                                joint("slide", "prismatic", "link_0", "link_1", "0 0.5 0") +
                                joint("grip", "fixed", "link_1", "link_2", "0 0.5 0");
    const Scene alone = test::importedText(cabinet + "</robot>", "cabinet.urdf");
    EXPECT_EQ(alone.objects.size(), 1U);
    expectBox(alone, "cabinet", {-0.5, -0.5, -0.5}, {0.5, 1.05, 0.5});
    // Another link fixed to the base is a separate object.
    const Scene both =
        test::importedText(cabinet + boxLink("lamp", "1 1 1") +
                               joint("stand", "fixed", "base", "lamp", "5 0 0") + "</robot>",
                           "room.urdf");
    EXPECT_EQ(both.objects.size(), 2U);
    EXPECT_NE(find(both, "cabinet::link_0"), nullptr);
    EXPECT_NE(find(both, "lamp"), nullptr);
}

// Doors with joints to a world link without visuals are separate objects.
TEST(Urdf, WhatHangsOnNothingThatIsShownStaysApart) {
    const Scene scene =
        test::importedText("<robot name='house'>\n<link name='world'/>\n" +
                               boxLink("left_door", "1 0.1 2") + boxLink("right_door", "1 0.1 2") +
                               joint("a", "revolute", "world", "left_door", "0 0 0") +
                               joint("b", "revolute", "world", "right_door", "3 0 0") + "</robot>",
                           "house.urdf");
    EXPECT_EQ(scene.objects.size(), 2U);
    expectBox(scene, "right_door", {2.5, -0.05, -1}, {3.5, 0.05, 1});
}

TEST(Urdf, JointsOfMissingLinksAreNamedWithTheirLine) {
    const Scene scene = test::importedText(
        "<robot name='r'>\n" + boxLink("body", "1 1 1") + boxLink("door", "1 1 1") +
            boxLink("handle", "1 1 1") + joint("hinge", "revolute", "body", "dor", "1 0 0") +
            joint("hold", "fixed", "lost", "door", "0 0 1") +
            joint("grip", "fixed", "door", "handle", "0 0 1") + "</robot>",
        "robot.urdf");
    EXPECT_TRUE(says(scene.report.warnings,
                     "robot.urdf:5: the joint 'hinge' names the child link 'dor', which does not "
                     "exist (perhaps 'door' is meant); the joint is left out"));
    EXPECT_TRUE(says(scene.report.warnings,
                     "robot.urdf:6: the joint 'hold' names the parent link "
                     "'lost', which does not exist"));
    EXPECT_TRUE(says(scene.report.warnings,
                     "2 links are left out because a joint above names a "
                     "parent that does not exist: door, handle"));
    EXPECT_EQ(scene.objects.size(), 1U);
    const Scene twice =
        test::importedText("<robot name='r'>\n" + boxLink("a", "1 1 1") + boxLink("b", "1 1 1") +
                               joint("one", "fixed", "a", "b", "1 0 0") +
                               joint("two", "fixed", "a", "b", "2 0 0") + "</robot>",
                           "twice.urdf");
    EXPECT_TRUE(says(twice.report.warnings,
                     "the link 'b' is the child of two joints; the joint 'two' is left out"));
}

TEST(Urdf, FaultsAreNamedWithTheirLine) {
    const TempFolder folder;
    const auto path =
        folder.write("r.urdf",
                     "<robot name='r'>\n<link name='l'>\n<visual><geometry>\n<box size='1 0 "
                     "1'/></geometry></visual></link></robot>");
    const Result<Scene> scene = importScene(path);
    ASSERT_FALSE(scene);
    EXPECT_EQ(scene.error().where, path.string() + ":3");
}

}  // namespace
}  // namespace dollytrack::urdf_test
