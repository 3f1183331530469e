#include "engine/scene/labels.h"
#include "tests/engine/datasets/numbered_mesh.h"
#include "tests/support/imported_scene.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

#include <string>

namespace dollytrack::label_hints_test {
namespace {

using test::asciiPly;
using test::find;
using test::imported;
using test::numberedRoom;
using test::says;
using test::TempFolder;
using test::trianglesOf;

/// A room whose faces or vertices have numbers under this name: 1 floor, 2 wall, 3 and 4, 5 lamp.
std::string roomWith(const std::string& property, bool of_faces = true) {
    return asciiPly(trianglesOf(numberedRoom(1, 2, 3, 4, 5)), of_faces, property);
}

TEST(LabelHints, NumbersAreKnownByManyNames) {
    const TempFolder folder;
    for (const char* name : {"object_id", "objectId", "Instance", "scalar_Instance", "ins_label"}) {
        for (const bool of_faces : {true, false}) {
            EXPECT_EQ(imported(folder.write("room.ply", roomWith(name, of_faces))).objects.size(),
                      5U)
                << name;
        }
    }
    for (const char* name : {"scalar_Label", "semantic_label", "Class"}) {
        EXPECT_TRUE(says(imported(folder.write("room.ply", roomWith(name, false))).report.notes,
                         "by the labels of the file itself"))
            << name;
    }
}

TEST(LabelHints, NumbersOfUnknownNamesAreSaid) {
    const TempFolder folder;
    const Scene scene = imported(folder.write("room.ply", roomWith("thing_no")));
    EXPECT_TRUE(says(scene.report.notes,
                     "whole numbers that were not read as labels: thing_no of "
                     "faces; call the property object_id"));
    EXPECT_FALSE(says(imported(folder.write("room.ply", roomWith("flags"))).report.notes,
                      "were not read as labels"));
    std::string texts = roomWith("object_id");
    texts.replace(texts.find("property int object_id"), 22, "property string label ");
    const Result<Scene> refused = importScene(folder.write("texts.ply", texts));
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("NAME.labels.json"), std::string::npos);
    EXPECT_TRUE(refused.error().where.ends_with("texts.ply:9")) << refused.error().where;
}

TEST(LabelHints, AListBesideThePlyNamesItsNumbers) {
    const struct {
        const char* name;
        const char* text;
    } kLists[] = {{"room.labels.json", R"({"1": "floor", "2": "wall", "3": "chair", "5": "lamp"})"},
                  {"room_labels.json", R"({"floor": 1, "wall": 2, "chair": 3, "lamp": 5})"},
                  {"room.labels.json",
                   R"([{"id": 1, "name": "floor"}, {"id": 2, "name": "wall"},
 {"id": 3, "label": "chair"}, {"id": 5, "class_name": "lamp"}])"},
                  {"room.labels.csv", "id,name\n1,floor\n2,wall\n3,\"chair\"\n5,lamp\n"},
                  {"room_labels.txt", "1 floor\n2 wall\n3 chair\r\n5 lamp"}};
    for (const auto& [name, text] : kLists) {
        const TempFolder folder;
        const auto path = folder.write("room.ply", roomWith("object_id"));
        EXPECT_TRUE(says(imported(path).report.notes, "name them in room.labels.json"));
        static_cast<void>(folder.write(name, text));
        const Scene scene = imported(path);
        ASSERT_NE(find(scene, "chair"), nullptr) << text;
        EXPECT_EQ(find(scene, "chair")->nyu40, nyu40FromName("chair"));
        EXPECT_EQ(find(scene, "floor")->role, Role::Structure);
        EXPECT_NE(find(scene, "unlabelled"), nullptr) << "4 has no name";
    }
    const TempFolder folder;
    static_cast<void>(folder.write("room.labels.txt", "chairs and lamps"));
    const Scene scene = imported(folder.write("room.ply", roomWith("object_id")));
    EXPECT_EQ(scene.objects.size(), 5U);
    EXPECT_TRUE(says(scene.report.warnings, "the names in room.labels.txt were not read"));
}

/// Expects a warning for a mesh whose data set lacks other files.
void expectGap(const TempFolder& folder, const std::string& mesh, const std::string& words) {
    const Scene scene = imported(folder.path() / mesh);
    EXPECT_TRUE(says(scene.report.warnings, words)) << words;
}

TEST(LabelHints, FilesOfScanNetThatAreMissingAreNamed) {
    const TempFolder folder;
    static_cast<void>(folder.write("s_vh_clean_2.ply", roomWith("flags")));
    static_cast<void>(folder.write("s.aggregation.json", "{}"));
    expectGap(folder, "s_vh_clean_2.ply",
              "s.aggregation.json exists, but s_vh_clean_2.0.010000.segs.json is missing");
    std::filesystem::rename(folder.path() / "s.aggregation.json",
                            folder.path() / "s_vh_clean_2.0.010000.segs.json");
    expectGap(folder, "s_vh_clean_2.ply",
              "s_vh_clean_2.0.010000.segs.json exists, but s.aggregation.json is missing");
    // The classes of vertices are read; the warning is the same.
    static_cast<void>(folder.write("s_vh_clean_2.labels.ply", roomWith("label", false)));
    expectGap(folder, "s_vh_clean_2.labels.ply", "s.aggregation.json is missing");
    static_cast<void>(folder.write("mesh_aligned_0.05.ply", roomWith("flags")));
    static_cast<void>(folder.write("segments.json", "{}"));
    expectGap(folder, "mesh_aligned_0.05.ply", "segments_anno.json is missing");
}

TEST(LabelHints, FilesOfReplicaAndHm3dThatAreMissingAreNamed) {
    const TempFolder folder;
    static_cast<void>(folder.write("mesh.ply", roomWith("flags")));
    static_cast<void>(folder.write("habitat/info_semantic.json", "{\"objects\": []}"));
    expectGap(folder, "mesh.ply", "info_semantic.json exists, but mesh_semantic.ply is missing");
    static_cast<void>(folder.write("habitat/mesh_semantic.ply", roomWith("object_id")));
    expectGap(folder, "mesh.ply", "open habitat/mesh_semantic.ply to get Replica's objects");
    std::filesystem::remove(folder.path() / "habitat/info_semantic.json");
    expectGap(folder, "habitat/mesh_semantic.ply",
              "mesh_semantic.ply exists, but info_semantic.json is missing");
    // A name like Matterport3D's alone causes no warning.
    static_cast<void>(folder.write("abc_semantic.ply", roomWith("object_id")));
    EXPECT_FALSE(says(imported(folder.path() / "abc_semantic.ply").report.warnings, "missing"));
}

}  // namespace
}  // namespace dollytrack::label_hints_test
