#include "engine/document/apply_scene_edits.h"
#include "engine/io/import/oddity_notes.h"
#include "engine/io/import/scene_import.h"
#include "engine/io/object_parts/object_grouping.h"
#include "engine/scene/labels.h"
#include "tests/support/imported_scene.h"
#include "tests/support/obj_writer.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace dollytrack::awkward_house_test {
namespace {

using test::find;
using test::furnished;
using test::imported;
using test::importedText;
using test::ObjWriter;
using test::says;
using test::TempFolder;

std::vector<std::string> namesOf(const Scene& scene) {
    std::vector<std::string> names;
    for (const Object& object : scene.objects) names.push_back(object.name);
    return names;
}

/// The OBJ text with each face replaced by the result of `change`.
std::string withFaces(const std::string& text,
                      const std::function<std::string(const std::string&)>& change) {
    std::string changed;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        changed += (line.starts_with("f ") ? change(line) : line) + "\n";
    }
    return changed;
}

std::string turned(const std::string& face) {
    std::istringstream words(face.substr(2));
    std::string corners;
    for (std::string word; words >> word;) corners.insert(0, " " + word);
    return "f" + corners;
}

/// Expects the objects and the room of the unchanged scene.
void expectTheSameRoom(const Scene& scene) {
    const Scene plain = importedText(furnished().text());
    EXPECT_EQ(namesOf(scene), namesOf(plain));
    EXPECT_TRUE(scene.room_bounds.isApprox(plain.room_bounds, 1e-6));
    EXPECT_EQ(scene.report.up_axis, plain.report.up_axis);
    EXPECT_DOUBLE_EQ(scene.report.unit_m, plain.report.unit_m);
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        EXPECT_EQ(scene.objects[i].role, plain.objects[i].role);
        EXPECT_TRUE(scene.objects[i].box.center.isApprox(plain.objects[i].box.center, 1e-6));
        EXPECT_TRUE(scene.objects[i].box.half_size.isApprox(plain.objects[i].box.half_size, 1e-6));
    }
}

TEST(AwkwardHouse, AnOrdinaryRoomIsNotOdd) {
    const Scene scene = importedText(furnished().text());
    for (const char* words : {"storeys", "twice", "point inwards", "mirror"}) {
        EXPECT_FALSE(says(scene.report.notes, words)) << words;
    }
}

TEST(AwkwardHouse, ThingsInsideOutAreSeenAllTheSame) {
    const Scene scene = importedText(withFaces(furnished().text(), turned));
    expectTheSameRoom(scene);
    EXPECT_TRUE(says(scene.report.notes, "4 objects have faces that point inwards"));
}

/// Three walls of a niche face inwards, but the niche is not an inside-out object.
TEST(AwkwardHouse, WhatIsOpenIsNotInsideOut) {
    ObjWriter obj = furnished();
    obj.object("niche");
    obj.quad({3.6, 3.2, 0.5}, {3.6, 3.6, 0.5}, {3.6, 3.6, 1.0}, {3.6, 3.2, 1.0});
    obj.quad({3.6, 3.6, 0.5}, {4.2, 3.6, 0.5}, {4.2, 3.6, 1.0}, {3.6, 3.6, 1.0});
    obj.quad({4.2, 3.6, 0.5}, {4.2, 3.2, 0.5}, {4.2, 3.2, 1.0}, {4.2, 3.6, 1.0});
    for (const std::string& text : {obj.text(), withFaces(obj.text(), turned)}) {
        const Scene scene = importedText(text);
        EXPECT_FALSE(says(scene.report.notes, "5 objects have faces that point inwards"));
        EXPECT_FALSE(says(scene.report.notes, "1 object has faces that point inwards"));
    }
}

/// Triangles, because the other side of a polygon may be split along the other diagonal.
std::string bothSides(const std::string& face) {
    std::istringstream words(face.substr(2));
    std::vector<std::string> corners;
    for (std::string word; words >> word;) corners.push_back(word);
    std::string faces;
    for (std::size_t i = 2; i < corners.size(); ++i) {
        const std::string triangle = "f " + corners[0] + " " + corners[i - 1] + " " + corners[i];
        faces += (faces.empty() ? "" : "\n") + triangle + "\n" + turned(triangle);
    }
    return faces;
}

TEST(AwkwardHouse, FacesForBothSidesAreOneThing) {
    const Scene scene = importedText(withFaces(furnished().text(), bothSides));
    expectTheSameRoom(scene);
    EXPECT_TRUE(says(scene.report.notes, "10 objects have each face twice"));
    EXPECT_FALSE(says(scene.report.notes, "point inwards"));
}

/// As SketchUp exports faces that are painted differently on their two sides.
TEST(AwkwardHouse, SidesOfAnotherMaterialLieOnTheirSide) {
    const TempFolder folder;
    static_cast<void>(
        folder.write("room.mtl", "newmtl outside\nKd 1 0 0\nnewmtl inside\nKd 0 0 1\n"));
    const auto painted = [](const std::string& face) {
        const std::string both = bothSides(face);
        std::string text;
        std::istringstream lines(both);
        for (std::string line; std::getline(lines, line);) {
            if (!text.empty()) text += "\n";
            text.append("usemtl outside\n").append(line);
            std::getline(lines, line);
            text.append("\nusemtl inside\n").append(line);
        }
        return text;
    };
    const auto scene = importScene(
        folder.write("room.obj", "mtllib room.mtl\n" + withFaces(furnished().text(), painted)));
    ASSERT_TRUE(scene.has_value());
    EXPECT_TRUE(says(scene->report.notes, "10 objects have faces with another material"));
    const Scene one_sided = importedText(furnished().text());
    ASSERT_NE(find(*scene, "sofa"), nullptr);
    const Object& sofa = *find(*scene, "sofa");
    const OrientedBox& box = find(one_sided, "sofa")->box;
    for (std::uint32_t i = 0; i < sofa.triangle_count; ++i) {
        const std::uint32_t triangle = sofa.first_triangle + i;
        const bool outside = scene->materials[scene->triangle_material[triangle]].name == "outside";
        for (const std::uint32_t vertex : scene->triangles[triangle]) {
            const Eigen::Vector3d p = scene->positions[vertex].cast<double>();
            // Each corner of a box is moved by 0.25 mm along its face's normal.
            const Eigen::Vector3d past = (p - box.center).cwiseAbs() - box.half_size;
            EXPECT_NEAR(outside ? past.maxCoeff() : past.minCoeff(), outside ? 2.5e-4 : -2.5e-4,
                        1e-5);
        }
    }
}

TEST(AwkwardHouse, ARoomInOneMeshIsTakenApart) {
    std::string text;
    std::istringstream lines(furnished().text());
    for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with("o ")) text += line + "\n";
    }
    const Scene scene = importedText(text);
    const auto targets =
        std::count_if(scene.objects.begin(), scene.objects.end(),
                      [](const Object& object) { return object.role == Role::Target; });
    EXPECT_EQ(targets, 4);
    EXPECT_TRUE(says(scene.report.warnings, "does not separate its objects"));
}

/// As in exports of Sweet Home 3D: all shapes of all furniture are numbered consecutively.
TEST(AwkwardHouse, NumberedPiecesAreFurniture) {
    ObjWriter obj(1.0, false);
    int number = 0;
    const auto next = [&](const std::string& name) -> ObjWriter& {
        return obj.object(name + (name.empty() ? "" : "_") + std::to_string(++number));
    };
    next("ground").quad({0, 0, 0}, {5, 0, 0}, {5, 4, 0}, {0, 4, 0});
    next("room_1").quad({0, 0, 0}, {5, 0, 0}, {5, 4, 0}, {0, 4, 0});
    next("wall_1").box({0, 0, 0}, {5, 0.1, 2.5});
    next("wall_2").box({0, 3.9, 0}, {5, 4, 2.5});
    next("wall_3").box({0, 0, 0}, {0.1, 4, 2.5});
    next("wall_4").box({4.9, 0, 0}, {5, 4, 2.5});
    for (const double x : {1.0, 2.0}) {  // chairs, side by side
        next("Pied").box({x, 1, 0}, {x + 0.04, 1.04, 0.45});
        next("Pied_1").box({x + 0.36, 1, 0}, {x + 0.4, 1.04, 0.45});
        next("Assise").box({x, 1, 0.45}, {x + 0.4, 1.4, 0.5});
        next("Dossier").box({x, 1.4, 0.4}, {x + 0.4, 1.44, 0.95});
    }
    for (const double y : {1.0, 1.6}) {  // two hobs that touch; the burners stand on them
        next("Corps").box({4.0, y, 0}, {4.6, y + 0.6, 0.85});
        next("Feu").box({4.1, y + 0.1, 0.85}, {4.3, y + 0.3, 0.87});
        next("Porte").box({3.98, y + 0.01, 0.1}, {4.0, y + 0.59, 0.8});
    }
    next("").box({1.0, 2.0, 0.1}, {2.4, 3.8, 0.3});  // a bed's frame
    next("Matress_Cube").box({1.05, 2.05, 0.3}, {2.35, 3.75, 0.5});
    next("Lampe").box({3.0, 3.0, 0}, {3.2, 3.2, 1.5});
    const TempFolder folder;
    const std::filesystem::path file = folder.write("home.obj", obj.text());
    const auto scene = importScene(file);
    ASSERT_TRUE(scene.has_value());
    EXPECT_TRUE(says(scene->report.notes, "11 numbered pieces of Sweet Home 3D's furniture"));
    int targets = 0;
    for (const Object& object : scene->objects) targets += object.role == Role::Target;
    EXPECT_EQ(targets, 6) << "two chairs, two hobs, a bed and a lamp";
    const auto whole = [&](const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
        return std::ranges::any_of(scene->objects, [&](const Object& object) {
            return (object.box.center - 0.5 * (low + high)).norm() < 1e-3 &&
                   (object.box.half_size - 0.5 * (high - low)).norm() < 1e-3;
        });
    };
    EXPECT_TRUE(whole({2.0, 1.0, 0.0}, {2.4, 1.44, 0.95}));
    EXPECT_TRUE(whole({3.98, 1.6, 0.0}, {4.6, 2.2, 0.87}));
    EXPECT_TRUE(whole({1.0, 2.0, 0.1}, {2.4, 3.8, 0.5})) << "the mattress is no floor";
    ImportOptions apart;
    apart.regroup = false;
    const auto separate = importScene(file, apart);
    ASSERT_TRUE(separate.has_value());
    EXPECT_GT(separate->objects.size(), 20U);
}

/// Numbers at the ends of names alone are no sign of that exporter.
TEST(AwkwardHouse, NumberedThingsAreNoPieces) {
    ObjWriter obj = furnished();
    for (int i = 1; i <= 12; ++i) {
        const double x = 0.3 + 0.3 * i;
        obj.object("box_" + std::to_string(i)).box({x, 0.5, 0}, {x + 0.3, 0.8, 0.3});
    }
    const Scene scene = importedText(obj.text());
    EXPECT_FALSE(says(scene.report.notes, "numbered pieces"));
    EXPECT_NE(find(scene, "box_7"), nullptr);
}

/// As in OBJ files of Cinema 4D, whose groups are named by their paths.
TEST(AwkwardHouse, PiecesWithOnePathAreFurniture) {
    ObjWriter obj = furnished();
    int number = 0;
    const auto piece = [&](const std::string& path) -> ObjWriter& {
        return obj.object(path + " W_rfel_" + std::to_string(++number));
    };
    for (int i = 0; i < 3; ++i) {
        const double x = 0.5 + i;
        const std::string path = "office island chair_Instanz_" + std::to_string(i);
        piece(path).box({x, 0.5, 0}, {x + 0.04, 0.54, 0.45});
        piece(path).box({x + 0.36, 0.5, 0}, {x + 0.4, 0.54, 0.45});
        piece(path).box({x, 0.5, 0.46}, {x + 0.4, 0.9, 0.5});
    }
    obj.object("red chair left").box({0.5, 3.2, 0}, {0.9, 3.6, 0.9});
    obj.object("red chair right").box({2.5, 3.2, 0}, {2.9, 3.6, 0.9});
    std::string text = obj.text();
    for (std::size_t at = 0; (at = text.find("\no ", at)) != std::string::npos; ++at) {
        text[at + 1] = 'g';
    }
    const Scene scene = importedText(text);
    EXPECT_TRUE(says(scene.report.notes, "6 pieces whose names have the same path"));
    for (int i = 0; i < 3; ++i) {
        const Object* chair = find(scene, "office island chair_Instanz_" + std::to_string(i));
        ASSERT_NE(chair, nullptr);
        EXPECT_EQ(chair->nyu40, 5);
        EXPECT_NEAR(2.0 * chair->box.half_size.z(), 0.5, 1e-3);
    }
    EXPECT_NE(find(scene, "red chair left"), nullptr);
    EXPECT_NE(find(scene, "red chair right"), nullptr);
}

/// As in files of Sketchfab, where each mesh is named after its object and its material.
TEST(AwkwardHouse, ANodeOfARoomIsNotOneObject) {
    const auto draftsOf = [](const std::string& parent, const std::vector<std::string>& suffixes) {
        RawScene raw;
        raw.nodes = {{"scene.gltf", -1, 1}, {parent, 0, 0}};
        for (const std::string& suffix : suffixes) {
            MeshPart part;
            part.node = static_cast<int>(raw.nodes.size());
            part.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
            part.triangles = {{0, 1, 2}};
            raw.nodes.push_back({parent + "_" + suffix, 1, 0});
            raw.parts.push_back(part);
        }
        std::string names;
        for (const ObjectDraft& draft : groupByNodes(raw, LabelTable::builtIn())) {
            names += draft.name + " ";
        }
        return names;
    };
    EXPECT_EQ(
        draftsOf("Neon", {"Structure_0", "Bed_0", "Carpet_0", "Mirrors_0", "Chair_0", "Text_0"}),
        "Neon_Structure_0 Neon_Bed_0 Neon_Carpet_0 Neon_Mirrors_0 Neon_Chair_0 Neon_Text_0 ");
    EXPECT_EQ(draftsOf("Neon", {"Bed_0", "Carpet_0", "Text_0"}), "Neon Neon_Bed_0 Neon_Carpet_0 ");
}

TEST(AwkwardHouse, WhatStandsOnAFloorAboveTheWallsFeetIsNoPartOfIt) {
    ObjWriter obj(1.0, false);
    obj.object("Plane").quad({0, 0, 0}, {5, 0, 0}, {5, 4, 0}, {0, 4, 0});
    obj.object("Plane.001").quad({0, 0, -2}, {5, 0, -2}, {5, 0, 3}, {0, 0, 3});
    obj.object("Plane.002").quad({0, 0, -2}, {0, 4, -2}, {0, 4, 3}, {0, 0, 3});
    obj.object("Cube").box({1, 1, -0.1}, {3, 1.8, 0.6});  // through the floor
    for (int i = 0; i < 6; ++i) {
        const double x = 0.5 + 0.7 * i;
        obj.object("vase_" + std::to_string(i)).box({x, 3, 0}, {x + 0.3, 3.3, 0.4});
    }
    const TempFolder folder;
    ImportOptions options;
    options.up_axis = 'z';
    const Scene scene = imported(folder.write("room.obj", obj.text()), options);
    ASSERT_NE(find(scene, "Plane"), nullptr);
    EXPECT_EQ(find(scene, "Plane")->nyu40, kNyuFloor);
    ASSERT_NE(find(scene, "Cube"), nullptr);
    EXPECT_NEAR(find(scene, "Cube")->box.half_size.head<2>().maxCoeff(), 1.0, 1e-3);
}

/// The box of a turned wall reaches farther than its corners.
TEST(AwkwardHouse, TheRoomEndsWhereItsTurnedWallsDo) {
    ObjWriter obj = furnished();
    obj.object("wall_turned").quad({0, 0, 0}, {4, 4, 0}, {4, 4, 2.6}, {0, 0, 2.6});
    obj.object("partition")
        .quad({0.5, 1, 0}, {1, 0.5, 0}, {1, 0.5, 2}, {0.5, 1, 2})
        .quad({4.5, 3.8, 0}, {4.6, 3.7, 0}, {4.6, 3.7, 2}, {4.5, 3.8, 2});
    const Scene scene = importedText(obj.text());
    EXPECT_NEAR(scene.room_bounds.sizes().x(), 5.0, 1e-3);
    EXPECT_NEAR(scene.room_bounds.sizes().y(), 4.0, 1e-3);
}

TEST(AwkwardHouse, TexturesAreFoundInOtherFoldersIfGiven) {
    const TempFolder folder;
    static_cast<void>(folder.write("textures/oak.ppm", "P6\n1 1\n255\n" + std::string(3, '\x80')));
    static_cast<void>(folder.write("scene/room.mtl", "newmtl oak\nmap_Kd ../textures/oak.ppm\n"));
    const std::filesystem::path file =
        folder.write("scene/room.obj", "mtllib room.mtl\nusemtl oak\n" + furnished().text());
    const auto without = importScene(file);
    ASSERT_TRUE(without.has_value());
    EXPECT_EQ(without->report.textures_missing.size(), 1U);
    EXPECT_TRUE(says(without->report.notes, "name another folder with --models"));
    ImportOptions options;
    options.model_folders = {folder.path() / "textures"};
    const auto with = importScene(file, options);
    ASSERT_TRUE(with.has_value());
    EXPECT_EQ(with->report.textures_found, 1);
    EXPECT_TRUE(with->report.textures_missing.empty());
}

TEST(AwkwardHouse, ARoomWithoutTargetsIsNoted) {
    const Scene scene = importedText(ObjWriter().room({5, 4, 2.6}, true).text());
    EXPECT_TRUE(says(scene.report.notes, "so there are no targets"));
    EXPECT_FALSE(says(importedText(furnished().text()).report.notes, "so there are no targets"));
}

TEST(AwkwardHouse, ThingsThatPassThroughEachOtherStayThemselves) {
    ObjWriter obj = furnished();
    obj.object("ottoman").box({1.5, 3.2, 0.0}, {2.6, 3.9, 0.6});  // inside the sofa
    obj.object("plant").box({2.5, 1.8, 0.1}, {2.7, 2.0, 1.1});    // through the table
    const Scene scene = importedText(obj.text());
    EXPECT_EQ(scene.objects.size(), 12U);
    EXPECT_TRUE(scene.report.warnings.empty());
}

TEST(AwkwardHouse, MirrorsAndWindowsAreNoHoles) {
    ObjWriter obj = furnished();
    obj.object("mirror").box({4.95, 1.0, 0.8}, {5.0, 2.0, 1.8});
    obj.object("window").box({2.0, 0.0, 0.9}, {3.0, 0.02, 2.1});
    const Scene scene = importedText(obj.text());
    EXPECT_TRUE(says(scene.report.notes, "1 mirror is rendered without reflections"));
    Scene silvered = scene;
    for (Material& material : silvered.materials) {
        material.metallic = 1.0F;
        material.roughness = 0.05F;
    }
    ImportReport report;
    noteOddities(silvered, report);
    EXPECT_FALSE(says(report.notes, "mirror"));
    const auto window = std::find_if(scene.objects.begin(), scene.objects.end(),
                                     [](const Object& object) { return object.name == "window"; });
    ASSERT_NE(window, scene.objects.end());
    EXPECT_TRUE(window->structure);
}

TEST(AwkwardHouse, TexturesThatAreGoneAreNamed) {
    const TempFolder folder;
    (void)folder.write("room.mtl", "newmtl leather\nKd 0.5 0.3 0.2\nmap_Kd no_such_picture.png\n");
    std::string text = furnished().text();
    text.insert(text.find("o sofa\n") + 7, "usemtl leather\n");
    const Result<Scene> scene = importScene(folder.write("room.obj", "mtllib room.mtl\n" + text));
    ASSERT_TRUE(scene) << describe(scene.error());
    EXPECT_EQ(scene->report.textures_missing, std::vector<std::string>{"no_such_picture.png"});
    EXPECT_EQ(namesOf(*scene), namesOf(importedText(furnished().text())));
}

/// Two floors with four objects on each, and stairs between them.
TEST(AwkwardHouse, StoreysAreCounted) {
    ObjWriter obj(1.0, false);
    obj.object("floor_ground").box({0, 0, -0.1}, {8, 6, 0});
    obj.object("floor_upper").box({0, 1.2, 2.6}, {8, 6, 2.85});
    obj.object("ceiling").box({0, 0, 5.45}, {8, 6, 5.55});
    obj.object("wall_1").box({0, -0.1, 0}, {8, 0, 5.45});
    obj.object("wall_2").box({0, 6, 0}, {8, 6.1, 5.45});
    obj.object("wall_3").box({-0.1, 0, 0}, {0, 6, 5.45});
    obj.object("wall_4").box({8, 0, 0}, {8.1, 6, 5.45});
    obj.object("stairs");
    for (int i = 0; i < 15; ++i) {
        obj.box({1.2 + 0.27 * i, 0.05, 0.0}, {1.47 + 0.27 * i, 1.15, 0.19 * (i + 1)});
    }
    for (const double z : {0.0, 2.85}) {
        const std::string where = z > 0.0 ? "up" : "down";
        obj.object("sofa_" + where).box({5.5, 4.8, z}, {7.5, 5.6, z + 0.8});
        obj.object("table_" + where).box({2.0, 3.2, z}, {3.2, 4.0, z + 0.75});
        obj.object("lamp_" + where).box({0.3, 5.3, z}, {0.6, 5.6, z + 1.5});
        obj.object("chair_" + where).box({6.8, 2.2, z}, {7.25, 2.65, z + 0.9});
    }
    const Scene scene = importedText(obj.text());
    EXPECT_DOUBLE_EQ(scene.report.unit_m, 1.0);
    EXPECT_NEAR(scene.room_bounds.max().z(), 5.55, 1e-3);
    EXPECT_TRUE(says(scene.report.notes, "2 storeys, with floors at 0.00, 2.85 m"));
}

/// A bungalow with a hipped roof, without names, and objects in the garden.
Scene houseWithRoof() {
    ObjWriter obj(1.0, false);
    obj.object("Object_1").box({0, 0, -0.1}, {8, 6, 0});
    obj.object("Object_2").box({0, -0.1, 0}, {8, 0, 2.6});
    obj.object("Object_3").box({0, 6, 0}, {8, 6.1, 2.6});
    obj.object("Object_4").box({-0.1, 0, 0}, {0, 6, 2.6});
    obj.object("Object_5").box({8, 0, 0}, {8.1, 6, 2.6});
    obj.object("Object_6").box({0, 0, 2.6}, {8, 6, 2.65});
    // The eaves extend over the walls; each side of the roof is an object.
    const Eigen::Vector3d a(-0.4, -0.4, 2.5), b(8.4, -0.4, 2.5), c(8.4, 6.4, 2.5),
        d(-0.4, 6.4, 2.5);
    const Eigen::Vector3d e(2.6, 3.0, 4.6), f(5.4, 3.0, 4.6);
    obj.object("Object_7").quad(a, b, f, e);
    obj.object("Object_8").quad(c, d, e, f);
    obj.object("Object_9").quad(b, c, f, f);
    obj.object("Object_10").quad(d, a, e, e);
    obj.object("sofa").box({2.5, 4.8, 0.0}, {4.5, 5.6, 0.8});
    obj.object("table").box({2.0, 3.2, 0.0}, {3.2, 4.0, 0.75});
    obj.object("lamp").box({0.3, 5.3, 0.0}, {0.6, 5.6, 1.5});
    obj.object("chair").box({6.8, 2.2, 0.0}, {7.25, 2.65, 0.9});
    obj.object("garden_chair").box({9.5, 2.2, 0.0}, {10.0, 2.7, 0.9});
    obj.object("car").box({3.0, -3.4, 0.0}, {6.9, -1.7, 1.5});
    return importedText(obj.text());
}

TEST(AwkwardHouse, ARoofAndWhatLiesOutsideAreNoTargets) {
    const Scene scene = houseWithRoof();
    for (const char* side : {"Object_7", "Object_8", "Object_9", "Object_10"}) {
        const Object* roof = find(scene, side);
        ASSERT_NE(roof, nullptr);
        EXPECT_TRUE(roof->structure) << side;
        EXPECT_EQ(roof->role, Role::Structure) << side;
        EXPECT_EQ(roof->nyu40, kNyuCeiling) << side << " is left away from above";
    }
    for (const char* outside : {"garden_chair", "car"}) {
        ASSERT_NE(find(scene, outside), nullptr);
        EXPECT_EQ(find(scene, outside)->role, Role::Structure) << outside;
        EXPECT_FALSE(find(scene, outside)->structure) << outside << " is no part of the building";
    }
    for (const char* inside : {"sofa", "table", "lamp", "chair"}) {
        EXPECT_EQ(find(scene, inside)->role, Role::Target) << inside;
    }
    EXPECT_TRUE(says(scene.report.notes, "2 objects outside the building are not targets"));
}

TEST(AwkwardHouse, WhatLiesOutsideIsATargetWhereAnEditSaysSo) {
    const Scene scene = houseWithRoof();
    SceneEdits edits;
    edits.changes.push_back({});
    edits.changes.back().object.name = "car";
    edits.changes.back().role = Role::Target;
    const Result<Scene> edited = applySceneEdits(scene, edits);
    ASSERT_TRUE(edited);
    EXPECT_EQ(find(*edited, "car")->role, Role::Target);
    EXPECT_EQ(find(*edited, "garden_chair")->role, Role::Structure);
}

// A hall of one mesh with few tables in the middle.
ObjWriter hallOfTables(const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
    ObjWriter obj;
    obj.object("cafe").box(low, high);
    for (int i = 0; i < 5; ++i) {
        const double x = 8.0 + 2.0 * i;
        obj.object("table_" + std::to_string(i)).box({x, 4, 0}, {x + 0.9, 4.9, 0.75});
    }
    return obj;
}

TEST(AwkwardHouse, AHallAroundFewTablesIsTheBuilding) {
    const Scene hall = importedText(hallOfTables({0, 0, 0}, {24, 10, 2.9}).text());
    EXPECT_NEAR(hall.room_bounds.sizes().x(), 24.0, 1e-3);
    EXPECT_EQ(test::countTargets(hall), 5);
    // A landscape has its bottom below the floor, and a dome is high.
    for (const auto& [low, high] : {std::pair(-1.0, 2.9), std::pair(0.0, 12.0)}) {
        const Scene scene = importedText(hallOfTables({0, 0, low}, {24, 10, high}).text());
        EXPECT_NEAR(scene.room_bounds.sizes().x(), 8.9, 1e-3) << low;
    }
}

TEST(AwkwardHouse, ABackdropIsNoWall) {
    ObjWriter obj = furnished();
    obj.object("Background_Environment").box({-2, -2, -1.5}, {7, 6, 4.5});
    const Scene scene = importedText(obj.text());
    EXPECT_NEAR(scene.room_bounds.sizes().x(), 5.0, 1e-3);
    const Object* backdrop = find(scene, "Background_Environment");
    ASSERT_NE(backdrop, nullptr);
    EXPECT_EQ(backdrop->nyu40, kNyuOtherStructure);
    EXPECT_EQ(backdrop->role, Role::Structure);
    EXPECT_TRUE(says(scene.report.notes, "outside or around the building"));
}

TEST(AwkwardHouse, AFloorOnTopOfTheWallsIsACeiling) {
    ObjWriter obj = furnished();
    obj.object("Floor_top").box({0, 0, 2.6}, {5, 4, 2.65});
    const Scene scene = importedText(obj.text());
    ASSERT_NE(find(scene, "Floor_top"), nullptr);
    EXPECT_EQ(find(scene, "Floor_top")->nyu40, kNyuCeiling);
    // With furniture on it, it is the floor of another storey.
    obj.object("bed").box({1, 1, 2.65}, {3, 2.5, 3.2});
    EXPECT_EQ(find(importedText(obj.text()), "Floor_top")->nyu40, kNyuFloor);
}

// Walls in one mesh are one object, whose top is no outlier among much lower furniture.
TEST(AwkwardHouse, WallsInOneMeshGiveTheHeight) {
    ObjWriter obj;
    obj.object("Wall").quad({0, 0, 0}, {3.5, 0, 0}, {3.5, 0, 2.03}, {0, 0, 2.03});
    obj.quad({0, 0, 0}, {0, 3.5, 0}, {0, 3.5, 2.03}, {0, 0, 2.03});
    obj.quad({0, 0, 0}, {3.5, 0, 0}, {3.5, 3.5, 0}, {0, 3.5, 0});
    obj.object("Table").box({1.2, 0.2, 0}, {2.6, 0.9, 0.7});
    obj.object("Cabinet").box({0.1, 1.2, 0}, {0.6, 2.4, 0.9});
    for (int i = 0; i < 8; ++i) {
        const double x = 1.3 + 0.15 * i;
        obj.object("Book_" + std::to_string(i)).box({x, 0.4, 0.7}, {x + 0.1, 0.65, 0.95});
    }
    const Scene scene = importedText(obj.text());
    EXPECT_EQ(scene.report.unit_m, 1.0);
    EXPECT_FALSE(says(scene.report.warnings, "unit is doubtful"));
}

}  // namespace
}  // namespace dollytrack::awkward_house_test
