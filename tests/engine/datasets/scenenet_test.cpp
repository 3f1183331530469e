#include "engine/io/datasets/scenenet_description.h"
#include "engine/io/import/scene_import.h"
#include "engine/scene/labels.h"
#include "tests/engine/datasets/tiny_datasets.h"
#include "tests/support/imported_scene.h"
#include "tests/support/obj_writer.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace dollytrack::scenenet_test {
namespace {

using Eigen::Vector3d;
using test::find;
using test::imported;
using test::TempFolder;

/// A model with centre (5, 0.2, -3): 0.8 high, 0.4 wide in x, 0.2 in z.
std::string piano() {
    return test::ObjWriter(1.0, true).object("body").box({4.8, 2.9, -0.2}, {5.2, 3.1, 0.6}).text();
}

std::string layout() {
    test::ObjWriter obj(1.0, true);
    obj.room({5, 4, 2.5}, true);
    obj.object("Mesh1").box({0, 0, 2.4}, {5, 0.1, 2.5});
    obj.object("radiator").box({0, 1, 0.1}, {0.1, 2, 0.7});
    return obj.text();
}

// Scaled by 2 to 1.6 m. The generator puts the base a tenth of the height above the position, at
// 0.5 + 0.16. The file's (x, y, z) is (x, -z, y) in the world.
TEST(SceneNet, PlacesModelsAsItsProgramDoes) {
    const TempFolder folder;
    static_cast<void>(folder.write("office/office1_layout.obj", layout()));
    static_cast<void>(
        folder.write("ShapeNetCore.v2/03928116/aaa/models/model_normalized.obj", piano()));
    const Scene scene = imported(folder.write("scene.txt", test::sceneNetText()));
    const Object* first = find(scene, "otherfurniture");
    const Object* second = find(scene, "otherfurniture_2");
    ASSERT_NE(first, nullptr);
    ASSERT_NE(second, nullptr);
    EXPECT_TRUE(first->box.center.isApprox(Vector3d(1.0, -2.0, 0.66 + 0.8), 1e-5));
    EXPECT_TRUE(first->box.half_size.isApprox(Vector3d(0.4, 0.2, 0.8), 1e-5));
    EXPECT_EQ(first->role, Role::Target);
    // Rotated by 90 degrees, unscaled: wide in the other direction.
    EXPECT_TRUE(second->box.center.isApprox(Vector3d(3.0, -2.0, 0.08 + 0.4), 1e-5));
    EXPECT_TRUE(second->box.half_size.isApprox(Vector3d(0.1, 0.2, 0.4), 1e-5));
    EXPECT_EQ(find(scene, "floor")->nyu40, kNyuFloor);
    EXPECT_EQ(find(scene, "Mesh1")->role, Role::Structure) << "of the layout, without a word";
    EXPECT_EQ(find(scene, "radiator")->role, Role::Target);
    EXPECT_TRUE(scene.report.warnings.empty()) << scene.report.warnings.front();
}

TEST(SceneNet, ReadsBothForms) {
    const auto second = parseSceneNet(test::sceneNetText(), "scene.txt");
    ASSERT_TRUE(second);
    ASSERT_EQ(second->objects.size(), 2U);
    const auto first = parseSceneNet(
        "layout_file:./office/office1_layout.obj\n"
        "/home/someone/ShapeNet/03928116/aaa/models/model_normalized.obj\n03928116\n1.6\n"
        "1 0 0 1\n0 1 0 0.5\n0 0 1 2\n",
        "scene.txt");
    ASSERT_TRUE(first) << describe(first.error());
    ASSERT_EQ(first->objects.size(), 1U);
    EXPECT_EQ(first->layout_file, second->layout_file);
    EXPECT_EQ(first->objects[0].hash, second->objects[0].hash);
    EXPECT_EQ(first->objects[0].wnid, second->objects[0].wnid);
    EXPECT_EQ(first->objects[0].height_m, second->objects[0].height_m);
    EXPECT_TRUE(first->objects[0].scene_from_object.isApprox(second->objects[0].scene_from_object));
}

TEST(SceneNet, SaysWhatIsMissing) {
    const TempFolder folder;
    const auto path = folder.write("scene.txt", test::sceneNetText());
    const Result<Scene> nothing = importScene(path);
    ASSERT_FALSE(nothing);
    EXPECT_EQ(nothing.error().code, ErrorCode::BadInput);
    EXPECT_NE(nothing.error().message.find("the layout ./office/office1_layout.obj and the models "
                                           "of 2 objects (1 category of ShapeNet) are not there; "),
              std::string::npos)
        << nothing.error().message;
    // The layout alone is a scene, with a warning.
    static_cast<void>(folder.write("data/office1_layout.obj", layout()));
    const Scene scene = imported(path, {.model_folders = {folder.path() / "data"}});
    EXPECT_NE(find(scene, "floor"), nullptr);
    ASSERT_EQ(scene.report.warnings.size(), 1U);
    EXPECT_TRUE(scene.report.warnings[0].starts_with("the models of 2 objects"));
}

TEST(SceneNet, NeverLooksOutsideOfTheFolders) {
    const TempFolder folder;
    static_cast<void>(folder.write("secret.obj", layout()));
    static_cast<void>(folder.write("a/in/x.obj", layout()));
    for (const char* name : {"../../secret.obj", "/etc/passwd", "../x/../../secret.obj"}) {
        const auto path = folder.write("a/in/scene.txt", std::string("layout_file:") + name + "\n");
        EXPECT_FALSE(importScene(path)) << name;
    }
    std::filesystem::create_symlink(folder.path() / "secret.obj",
                                    folder.path() / "a" / "in" / "s.obj");
    EXPECT_FALSE(importScene(folder.write("a/in/scene.txt", "layout_file:s.obj\n")));
    EXPECT_TRUE(importScene(folder.write("a/in/scene.txt", "layout_file:x.obj\n")));
}

TEST(SceneNet, NamesTheLineThatIsWrong) {
    const auto lineOf = [](std::string text, const std::string& from, const std::string& to) {
        text.replace(text.find(from), from.size(), to);
        const auto scene = parseSceneNet(text, "s.txt");
        return scene ? "none" : scene.error().where;
    };
    EXPECT_EQ(lineOf(test::sceneNetText(), "layout_file:", "lay"), "s.txt:1");
    EXPECT_EQ(lineOf(test::sceneNetText(), "1.6", "tall"), "s.txt:7");
    EXPECT_EQ(lineOf(test::sceneNetText(), "1.6", "-1"), "s.txt:2");
    EXPECT_EQ(lineOf(test::sceneNetText(), "0.000 0.5", "0.5"), "s.txt:10");
    EXPECT_EQ(lineOf(test::sceneNetText(), "scale", "size"), "s.txt:6");
    EXPECT_EQ(lineOf(test::sceneNetText(), "03928116/aaa", "../../etc/pass wd"), "s.txt:2");
    EXPECT_EQ(lineOf(test::sceneNetText(), "1.6", "1.6"), "none");
}

}  // namespace
}  // namespace dollytrack::scenenet_test
