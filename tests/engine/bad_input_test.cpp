#include "engine/io/import/scene_import.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace dollytrack::bad_input_test {
namespace {

using test::TempFolder;

/// Expects BadInput with one sentence that contains `part`, and the given path.
void expectRefused(const std::filesystem::path& path, const std::string& part) {
    const Result<Scene> scene = importScene(path);
    ASSERT_FALSE(scene) << path;
    EXPECT_EQ(scene.error().code, ErrorCode::BadInput);
    EXPECT_NE(scene.error().message.find(part), std::string::npos) << scene.error().message;
    EXPECT_EQ(scene.error().message.find('\n'), std::string::npos);
    EXPECT_TRUE(scene.error().where.starts_with(path.string())) << scene.error().where;
}

TEST(BadInput, MissingFileFolderAndEmptyFile) {
    const TempFolder folder;
    expectRefused(folder.path() / "nothing.obj", "no such file");
    expectRefused(folder.path(), "folder");
    expectRefused(folder.write("empty.obj", ""), "empty");
}

TEST(BadInput, UnknownExtensionsSayWhatToDo) {
    const TempFolder folder;
    expectRefused(folder.write("room.docx", "x"), "scenes are .obj, .fbx");
    expectRefused(folder.write("room.usdz", "x"), "Blender 4 from blender.org");
    expectRefused(folder.write("room.ifc", "x"), "assimp export");
    expectRefused(folder.write("room.urdf.xacro", "<x/>"), "xacro in.urdf.xacro");
    expectRefused(folder.write("room", "x"), "no extension");
    expectRefused(folder.write("room.c4d", "x"), "export FBX or glTF");
    expectRefused(folder.write("room.blend", "x"), "blender -b in.blend");
    expectRefused(folder.write("room.MAX", "x"), "export FBX or glTF");
    expectRefused(folder.write("room.skp", "x"), "in SketchUp export a 3D model as glTF");
    expectRefused(folder.write("scan.e57", "x"), "cloudcompare.org");
    expectRefused(folder.write("scan.laz", "x"), "cloudcompare.org");
    expectRefused(folder.write("room.3ds", "x"), "assimp export");
    expectRefused(folder.write("room.wrl", "x"), "osgconv IN out.obj");
    expectRefused(folder.write("room.abc", "x"), "lacks Alembic");
    expectRefused(folder.write("room.rvt", "x"), "export FBX or glTF from Revit");
    expectRefused(folder.write("room.STEP", "x"), "FreeCAD");
}

// Users may open files beside a scene instead of the scene.
TEST(BadInput, PartsOfScenesSayWhatToName) {
    const TempFolder folder;
    expectRefused(folder.write("room.mtl", "newmtl a"), "name the .obj beside it");
    expectRefused(folder.write("room.bin", "x"), "name the .gltf beside it");
    expectRefused(folder.write("room.zip", "PK"), "unpack it");
    expectRefused(folder.write("wood.PNG", "x"), "open the scene that uses it");
    expectRefused(folder.write("a.navmesh", "x"), "name the scene instance");
    expectRefused(folder.write("house.semantic.txt", "HM3D"), "name its .glb");
    expectRefused(folder.write("info_semantic.json", "{}"), "mesh_semantic.ply");
    expectRefused(folder.write("scene0000_00.aggregation.json", "{}"), "_vh_clean_2.ply");
    expectRefused(folder.write("a.semantic_config.json", "{}"), "name a .scene_instance.json");
}

TEST(BadInput, KindsAreToldByTheirContent) {
    const TempFolder folder;
    expectRefused(folder.write("room.obj", "BLENDER-v304RENDH"), "blender -b in.blend");
    expectRefused(folder.write("room.glb", "PXR-USDC"), "blender.org");
    expectRefused(folder.write("room.stl", "ISO-10303-21;\nHEADER;"), "IFC");
    expectRefused(folder.write("a.json", "{\"doors\":[{\"assetId\":\"D\",\"room0\":\"r\"}]}"),
                  "ProcTHOR");
    expectRefused(folder.write("b.json",
                               "{\"walls\":[{\"dimensions\":[1],\"confidence\":{},"
                               "\"transform\":[1]}]}"),
                  "RoomPlan");
    expectRefused(folder.write("c.json", "{\"name\": \"a thing\"}"), "not a supported scene");
    expectRefused(folder.write("d.json", "[1, 2]"), "not a supported scene");
}

// Many folders have files of the same name.
TEST(BadInput, FilesBesideTheSceneAreNamedWithTheirFolder) {
    const TempFolder folder;
    const std::filesystem::path room =
        folder.write("room.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const std::filesystem::path words = folder.write("words.csv", "chair,nonsense\n");
    const Result<Scene> refused = importScene(room, {.labels = words});
    ASSERT_FALSE(refused);
    EXPECT_TRUE(refused.error().where.starts_with(words.string())) << refused.error().where;
    const std::filesystem::path said = folder.write(
        "room.obj.objects.json", R"({"format": "dollytrack-objects", "version": 1, "unit_m": 1})");
    const Result<Scene> scene = importScene(room);
    ASSERT_TRUE(scene) << describe(scene.error());
    EXPECT_NE(std::ranges::find(scene->report.notes, "annotations: " + said.string()),
              scene->report.notes.end());
}

TEST(BadInput, GitLfsPointerIsNamed) {
    const TempFolder folder;
    expectRefused(
        folder.write("room.glb",
                     "version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 1\n"),
        "git lfs pull");
}

TEST(BadInput, WrongFirstBytes) {
    const TempFolder folder;
    expectRefused(folder.write("room.glb", "not a glb at all"), "wrong extension");
    expectRefused(folder.write("room.ply", "obj"), "wrong extension");
    expectRefused(folder.write("room.gltf", "glTF"), "wrong extension");
    expectRefused(folder.write("room.dae", "{}"), "wrong extension");
}

TEST(BadInput, ScenesOfOtherProgramsAreNamed) {
    const TempFolder folder;
    expectRefused(folder.write("kitchen.xml", "<mujoco model=\"kitchen\">"), "MuJoCo");
    expectRefused(folder.write("room.spz", "x"), "uncompressed PLY");
    expectRefused(folder.write("meta.json", "{\"means\": {\"shape\": [307128, 3]}}"),
                  "uncompressed PLY");
    expectRefused(folder.write("room.compressed.ply",
                               "ply\nformat binary_little_endian 1.0\nelement vertex 1\n"
                               "property uint packed_position\nend_header\n1234"),
                  "uncompressed PLY");
    expectRefused(folder.write("scene.xml", "<?xml version=\"1.0\"?>\n<scene version=\"0.5.0\">"),
                  "Mitsuba");
    expectRefused(folder.write("other.xml", "<?xml version=\"1.0\"?>\n<html>"),
                  "does not start like a home's Home.xml");
}

TEST(BadInput, NothingThatCanBeDrawn) {
    const TempFolder folder;
    expectRefused(folder.write("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"), "");
    expectRefused(folder.write("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n"), "area");
    expectRefused(folder.write("far.obj", "v 1e30 0 0\nv 1e30 1 0\nv 1e30 0 1\nf 1 2 3\n"),
                  "more than 1e9 units");
    expectRefused(folder.write("nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
                  "non-finite corner");
}

TEST(BadInput, GltfWithoutItsBuffer) {
    const TempFolder folder;
    expectRefused(
        folder.write("room.gltf",
                     R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
                "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
                "accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":3}],
                "bufferViews":[{"buffer":0,"byteLength":36}],
                "buffers":[{"byteLength":36,"uri":"gone.bin"}]})"),
        "gone.bin");
}

TEST(BadInput, OptionsOutOfRange) {
    const Result<Scene> unit = importScene("room.obj", {.unit_m = -1.0});
    ASSERT_FALSE(unit);
    EXPECT_EQ(unit.error().code, ErrorCode::Usage);
    const Result<Scene> up = importScene("room.obj", {.up_axis = 'q'});
    ASSERT_FALSE(up);
    EXPECT_EQ(up.error().where, "up_axis");
}

}  // namespace
}  // namespace dollytrack::bad_input_test
