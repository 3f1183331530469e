#include "engine/io/import/scene_import.h"
#include "engine/scene/labels.h"
#include "tests/support/imported_scene.h"
#include "tests/support/obj_writer.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>

namespace dollytrack::material_meshes_test {
namespace {

using Eigen::Vector3d;
using test::find;
using test::ObjWriter;
using test::says;
using test::TempFolder;

/// Ten seats of a classroom; neighbours in a row are closer than half a metre.
void atEachPlace(const std::function<void(double x, double y)>& draw) {
    for (int row = 0; row < 2; ++row) {
        for (int place = 0; place < 5; ++place) draw(0.8 + 0.8 * place, 1.0 + row);
    }
}

/// A room with ten chairs and ten desks, with one mesh per material.
std::string classroom() {
    ObjWriter obj;
    obj.room({5.5, 4.0, 2.8}, true);
    const auto box = [&](double x, double y, double z, const Vector3d& size) {
        obj.box({x, y, z}, Vector3d(x, y, z) + size);
    };
    obj.object("ChairFrame");
    atEachPlace([&](double x, double y) {
        box(x, y, 0.03, {0.03, 0.4, 0.42});
        box(x + 0.37, y, 0.03, {0.03, 0.4, 0.42});
        box(x + 0.02, y, 0.42, {0.36, 0.03, 0.4});  // between them, up to the back
    });
    obj.object("ChairSeat");
    atEachPlace([&](double x, double y) { box(x, y, 0.45, {0.4, 0.4, 0.03}); });
    obj.object("Rubber");
    atEachPlace([&](double x, double y) {
        for (const double dx : {0.0, 0.37}) {
            for (const double dy : {0.0, 0.36}) box(x + dx, y + dy, 0.0, {0.03, 0.04, 0.03});
        }
    });
    obj.object("DeskTop");
    atEachPlace([&](double x, double y) { box(x - 0.15, y + 0.45, 0.7, {0.7, 0.45, 0.03}); });
    obj.object("DeskLegs");
    atEachPlace([&](double x, double y) {
        box(x - 0.15, y + 0.45, 0.0, {0.04, 0.45, 0.7});
        box(x + 0.51, y + 0.45, 0.0, {0.04, 0.45, 0.7});
    });
    return obj.text();
}

Scene importedWith(const std::string& text, bool regroup) {
    const TempFolder folder;
    ImportOptions options;
    options.regroup = regroup;
    return test::imported(folder.write("room.obj", text), options);
}

std::ptrdiff_t targetsOf(const Scene& scene, int nyu40) {
    return std::ranges::count_if(scene.objects, [&](const Object& object) {
        return object.role == Role::Target && object.nyu40 == nyu40;
    });
}

/// Four closed boxes in the corners of a room of 5 x 4 x 2.6 m, and one in its middle.
void addFiveBoxes(ObjWriter& obj) {
    obj.box({0.2, 0.2, 0.0}, {1.2, 1.2, 0.5}).box({3.8, 0.2, 0.0}, {4.6, 1.0, 1.2});
    obj.box({0.2, 3.0, 0.0}, {1.4, 3.7, 0.8}).box({3.9, 3.2, 0.0}, {4.7, 3.8, 0.9});
    obj.box({2.3, 1.8, 0.0}, {2.8, 2.2, 0.4});
}

}  // namespace

TEST(MaterialMeshes, MeshesStayAsTheyAreIfAsked) {
    ObjWriter obj;
    obj.object("Cube").room({5, 4, 2.6}, false);
    // Three boxes on each other, whose names a modelling program generated, and two distant ones.
    obj.object("Cube.001").box({1, 1, 0}, {1.3, 1.3, 0.3});
    obj.object("Cube.002").box({1, 1, 0.3}, {1.3, 1.3, 0.6});
    obj.object("Cube.003").box({1, 1, 0.6}, {1.3, 1.3, 0.9});
    obj.object("Cube.004").box({3, 3, 0}, {3.4, 3.4, 0.4}).box({0.5, 3, 0}, {0.9, 3.4, 0.4});
    EXPECT_LT(test::countTargets(importedWith(obj.text(), true)), 4);
    const Scene scene = importedWith(obj.text(), false);
    ASSERT_EQ(scene.objects.size(), 5U);
    for (const char* name : {"Cube.001", "Cube.002", "Cube.003", "Cube.004"}) {
        EXPECT_NE(test::find(scene, name), nullptr) << name;
    }
}

TEST(MaterialMeshes, AreRegroupedToTheObjectsTheyHoldPartsOf) {
    const Scene scene = importedWith(classroom(), true);
    EXPECT_EQ(test::countTargets(scene), 20);
    EXPECT_EQ(targetsOf(scene, nyu40FromName("chair")), 10);
    EXPECT_EQ(targetsOf(scene, nyu40FromName("desk")), 10);
    const Object* chair = find(scene, "chair_1");
    ASSERT_NE(chair, nullptr);
    EXPECT_EQ(chair->triangle_count, 8U * 12U);  // frame, seat and feet
    EXPECT_LT((2.0 * chair->box.half_size - Vector3d(0.4, 0.4, 0.82)).norm(), 0.01);
    EXPECT_TRUE(says(scene.report.warnings,
                     "5 meshes contain parts of several objects: ChairFrame, ChairSeat, Rubber, "
                     "DeskTop, DeskLegs; they were regrouped into 20 objects"))
        << (scene.report.warnings.empty() ? "no warnings" : scene.report.warnings.front());
    EXPECT_EQ(scene.report.warnings.size(), 1U);
}

TEST(MaterialMeshes, AreKeptAndDoubtfulWhereTheyAreToBeKept) {
    const Scene scene = importedWith(classroom(), false);
    EXPECT_LT(targetsOf(scene, nyu40FromName("chair")), 10);
    EXPECT_TRUE(says(scene.report.warnings, "5 meshes contain parts of several objects"));
    EXPECT_TRUE(says(scene.report.warnings, "have unusual sizes for their classes"));
}

// An optimizer joins meshes of equal materials, and gives the result the name of the first.
TEST(MaterialMeshes, AMeshOfAllObjectsIsNotWhatItsNameSays) {
    ObjWriter obj;
    obj.object("dresser").room({5.0, 4.0, 2.6}, false);
    addFiveBoxes(obj);
    for (int i = 0; i < 6; ++i) {
        const double y = 0.5 + 0.5 * i;
        obj.object("wall_strip_" + std::to_string(i)).box({0.0, y, 1.0}, {0.02, y + 0.1, 2.4});
    }
    const Scene scene = importedWith(obj.text(), true);
    EXPECT_EQ(targetsOf(scene, nyu40FromName("dresser")), 0);
    EXPECT_EQ(test::countTargets(scene), 5);
    // The same mesh in a file of its own may be what its name says.
    ObjWriter alone;
    alone.object("dresser").box({0.0, 0.0, 0.0}, {2.0, 1.6, 1.2});
    EXPECT_EQ(targetsOf(importedWith(alone.text(), true), nyu40FromName("dresser")), 1);
}

// Shelves of different sizes, 0.4 m apart: their tops are one mesh, their sides another.
TEST(MaterialMeshes, MeshesWithoutAClassAcrossTheRoomAreRegrouped) {
    ObjWriter obj;
    obj.room({5.0, 4.0, 2.6}, true);
    const auto atEachShelf = [](const auto& draw) {
        for (int i = 0; i < 12; ++i) {
            const int column = i % 4;
            draw(Vector3d(0.3 + 1.15 * column, 0.3 + 1.2 * static_cast<int>(i / 4), 0.15 * i),
                 Vector3d(0.75, 0.8, 0.5 + 0.02 * i));
        }
    };
    obj.object("xyz");
    atEachShelf([&](const Vector3d& low, const Vector3d& size) {
        obj.box(low + Vector3d(0.0, 0.0, size.z()), low + size + Vector3d(0.0, 0.0, 0.03));
    });
    obj.object("uvw");
    atEachShelf([&](const Vector3d& low, const Vector3d& size) {
        obj.box(low, low + Vector3d(0.04, 0.8, size.z()));
        obj.box(low + Vector3d(0.71, 0.0, 0.0), low + size);
    });
    const Scene scene = importedWith(obj.text(), true);
    EXPECT_EQ(test::countTargets(scene), 12);
    EXPECT_EQ(find(scene, "xyz_1")->triangle_count, 3U * 12U);
    EXPECT_LT(test::countTargets(importedWith(obj.text(), false)), 12);
}

TEST(MaterialMeshes, ObjectsOfSeveralPiecesStayWhole) {
    ObjWriter obj = test::furnished();
    // Books on a board, a table on four loose legs, a long curtain of three lengths.
    obj.object("books");
    for (int i = 0; i < 12; ++i) {
        obj.box({1.0 + 0.1 * i, 3.7, 1.5}, {1.03 + 0.1 * i, 3.9, 1.75});
    }
    obj.object("table").box({3.0, 0.3, 0.7}, {4.8, 1.1, 0.74});
    for (const double x : {3.0, 4.75}) {
        for (const double y : {0.3, 1.05}) obj.box({x, y, 0.0}, {x + 0.05, y + 0.05, 0.7});
    }
    obj.object("curtain");
    for (int i = 0; i < 3; ++i) {
        obj.box({0.2 + 0.9 * i, 0.02, 0.3}, {1.0 + 0.9 * i, 0.05, 2.4});
    }
    const Scene scene = importedWith(obj.text(), true);
    const Scene kept = importedWith(obj.text(), false);
    ASSERT_EQ(scene.objects.size(), kept.objects.size());
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        EXPECT_EQ(scene.objects[i].name, kept.objects[i].name);
        EXPECT_EQ(scene.objects[i].triangle_count, kept.objects[i].triangle_count);
    }
    EXPECT_FALSE(says(scene.report.notes, "parts of several objects"));
    EXPECT_FALSE(says(kept.report.warnings, "parts of several objects"));
}

// Bars less than half a metre apart: one object or several, which only a user can decide.
TEST(MaterialMeshes, AlikePiecesOfNoClassAreDoubtful) {
    ObjWriter obj = test::furnished();
    obj.object("Blorb");
    for (int i = 0; i < 5; ++i) obj.box({0.5 + 0.8 * i, 3.2, 0.9}, {1.0 + 0.8 * i, 3.6, 1.3});
    const Scene scene = importedWith(obj.text(), true);
    EXPECT_NE(find(scene, "Blorb"), nullptr);
    EXPECT_TRUE(
        says(scene.report.warnings, "1 mesh may contain several similar, separate objects: Blorb"));
}

/// The furniture, and six chairs whose seat, frame, back, legs and screws are separate meshes with
/// one material each.
std::string splitByMaterial(bool apart) {
    ObjWriter obj = test::furnished();
    int number = 0;
    const auto part = [&](const Vector3d& low, const Vector3d& high) {
        const std::string name = "Mat" + std::to_string(++number);
        obj.object(name).material(name).box(low, high);
    };
    for (int i = 0; i < 6; ++i) {
        const Vector3d at(0.4 + 0.75 * i, 2.4, 0.0);
        part(at, at + Vector3d(0.45, 0.45, 0.9));
        for (int k = 0; k < 5; ++k) {
            const Vector3d low = at + Vector3d(0.05 + 0.07 * k, 0.1, apart ? 1.0 : 0.45);
            part(low, low + Vector3d(0.05, 0.2, 0.02 + 0.03 * k));
        }
    }
    return obj.text();
}

TEST(MaterialMeshes, ThatSplitEachObjectAreRegrouped) {
    const Scene split = importedWith(splitByMaterial(false), true);
    EXPECT_TRUE(says(split.report.warnings, "the meshes look split by material: 30 of 40"));
    EXPECT_TRUE(says(split.report.warnings, "all 40 were regrouped into 10 objects"));
    ASSERT_EQ(test::countTargets(split), 10);
    for (const char* furniture : {"sofa", "chair", "lamp", "coffee_table"}) {
        EXPECT_NE(find(split, furniture), nullptr) << furniture;
    }
    for (int i = 0; i < 6; ++i) {
        const Object* whole = find(split, "Mat" + std::to_string(6 * i + 1));
        ASSERT_NE(whole, nullptr) << i;
        EXPECT_EQ(whole->triangle_count, 6U * 12U) << i;
        EXPECT_NEAR(whole->box.center.x(), 0.625 + 0.75 * i, 1e-5) << i;
    }
    const Scene kept = importedWith(splitByMaterial(false), false);
    EXPECT_EQ(test::countTargets(kept), 40);
    EXPECT_TRUE(says(kept.report.warnings, "leave out --keep-meshes to regroup them"));
    const Scene apart = importedWith(splitByMaterial(true), true);
    EXPECT_EQ(test::countTargets(apart), 40);
    EXPECT_FALSE(says(apart.report.warnings, "split by material"));
}

// Objects in or on another object stay separate, as do objects with their own class.
TEST(MaterialMeshes, ThatSplitEachObjectKeepWhatStandsInIt) {
    ObjWriter obj(1.0, false);
    obj.room({6, 5, 2.6}, true);
    int number = 0;
    const auto part = [&](const std::string& name, const Vector3d& low, const Vector3d& size) {
        obj.object(name).material("Mat" + std::to_string(++number)).box(low, low + size);
    };
    // Cases of five meshes, each with a jar and a book on its bottom board.
    for (int i = 0; i < 6; ++i) {
        const Vector3d at(0.3 + 0.9 * i, 0.3, 0.0);
        const std::string mark = std::to_string(i);
        part("Oak" + mark, at, {0.03, 0.3, 1.0});
        part("Yew" + mark, at + Vector3d(0.57, 0, 0), {0.03, 0.3, 1.0});
        part("Elm" + mark, at + Vector3d(0.03, 0.27, 0), {0.54, 0.03, 1.0});
        part("Fir" + mark, at + Vector3d(0.03, 0, 0), {0.54, 0.27, 0.03});
        part("bookshelf" + mark, at, {0.6, 0.3, 1.03});
        part("Jar" + mark, at + Vector3d(0.2, 0.1, 0.03), {0.1, 0.1, 0.15});
        part("book" + mark, at + Vector3d(0.4, 0.1, 0.03), {0.03, 0.15, 0.22});
    }
    const Scene scene = importedWith(obj.text(), true);
    EXPECT_TRUE(says(scene.report.warnings, "all 42 were regrouped into 18 objects"));
    EXPECT_EQ(test::countTargets(scene), 18);
    for (int i = 0; i < 6; ++i) {
        for (const char* name : {"bookshelf", "Jar", "book"}) {
            EXPECT_NE(find(scene, name + std::to_string(i)), nullptr) << name << i;
        }
    }
}

// Books with one material each are not parts of the bookcase around them.
TEST(MaterialMeshes, BooksInABookcaseStay) {
    ObjWriter obj = test::furnished();
    int number = 0;
    for (int i = 0; i < 2; ++i) {
        const Vector3d at(0.4 + 2.0 * i, 0.02, 0.0);
        obj.object("bookcase_" + std::to_string(i)).material("Oak" + std::to_string(i));
        obj.box(at, at + Vector3d(1.2, 0.02, 1.0));
        for (const double x : {0.0, 1.17}) {
            obj.box(at + Vector3d(x, 0.02, 0.0), at + Vector3d(x + 0.03, 0.3, 1.0));
        }
        for (const double z : {0.05, 0.5}) {
            const Vector3d board = at + Vector3d(0.03, 0.02, z);
            obj.box(board, board + Vector3d(1.14, 0.28, 0.02));
            for (int k = 0; k < 10; ++k) {
                const std::string name = "Red" + std::to_string(++number);
                const Vector3d low = board + Vector3d(0.04 * k, 0.05, 0.02);
                obj.object(name).material(name).box(low, low + Vector3d(0.038, 0.16, 0.25));
            }
            obj.object("bookcase_" + std::to_string(i)).material("Oak" + std::to_string(i));
        }
    }
    const Scene scene = importedWith(obj.text(), true);
    EXPECT_FALSE(says(scene.report.warnings, "split by material"));
    EXPECT_EQ(test::countTargets(scene), 4 + 2 + 40);
}

// A third mesh that touches both does not join a table to a chair.
TEST(MaterialMeshes, ThatSplitEachObjectKeepClassesApart) {
    ObjWriter obj(1.0, false);
    obj.room({8, 5, 2.6}, true);
    int number = 0;
    const auto part = [&](const std::string& name, const Vector3d& low, const Vector3d& size) {
        ++number;
        obj.object(name + std::to_string(number)).material("Paint" + std::to_string(number));
        obj.box(low, low + size);
    };
    for (int i = 0; i < 6; ++i) {
        const Vector3d at(0.5 + 1.2 * i, 1.0, 0.0);
        part("table_", at, {0.8, 0.6, 0.7});
        part("chair_", at + Vector3d(0.1, 0.8, 0.0), {0.45, 0.45, 0.9});
        part("Zinc", at + Vector3d(0.3, 0.5, 0.3), {0.04, 0.4, 0.04});  // connects two objects
        for (int k = 0; k < 3; ++k) {
            part("Bit", at + Vector3d(0.1 + 0.2 * k, 0.2, 0.3), {0.1, 0.1, 0.1});
            part("Bit", at + Vector3d(0.15 + 0.12 * k, 0.95, 0.3), {0.05, 0.1, 0.1});
        }
    }
    const Scene scene = importedWith(obj.text(), true);
    EXPECT_TRUE(says(scene.report.warnings, "split by material"));
    EXPECT_EQ(targetsOf(scene, nyu40FromName("table")), 6);
    EXPECT_EQ(targetsOf(scene, nyu40FromName("chair")), 6);
}

// An object that is too small for its class, and one whose size is only unusual.
TEST(SizeDoubts, NameWhatItsClassCannotBe) {
    ObjWriter obj = test::furnished();
    obj.object("chair_small").box({3.5, 3.5, 0.0}, {3.54, 3.54, 0.04});
    obj.object("stool_low").box({4.5, 0.3, 0.0}, {4.8, 0.6, 0.2});
    const Scene scene = importedWith(obj.text(), true);
    EXPECT_TRUE(says(scene.report.warnings,
                     "1 object has an unusual size for its class: chair_small (chair, "
                     "0.04 m)"));
}

}  // namespace dollytrack::material_meshes_test
