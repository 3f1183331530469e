#include "engine/io/import/scene_import.h"
#include "engine/io/trajectories/trajectory_file.h"
#include "engine/scene/labels.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace dollytrack::home_import_test {
namespace {

using Eigen::Vector3d;

/// A room of 4 x 3 m between the centre lines of 10 cm walls, with additional elements.
std::string home(const std::string& more) {
    return R"(<?xml version='1.0'?>
<home version='5500' name='t.sh3d' wallHeight='250.0'>
  <wall id='a' wallAtStart='d' wallAtEnd='b' xStart='0' yStart='0' xEnd='400' yEnd='0'
        height='250' thickness='10'/>
  <wall id='b' wallAtStart='a' wallAtEnd='c' xStart='400' yStart='0' xEnd='400' yEnd='300'
        height='250' thickness='10'/>
  <wall id='c' wallAtStart='b' wallAtEnd='d' xStart='400' yStart='300' xEnd='0' yEnd='300'
        height='250' thickness='10'/>
  <wall id='d' wallAtStart='c' wallAtEnd='a' xStart='0' yStart='300' xEnd='0' yEnd='0'
        height='250' thickness='10'/>
  <room name='Hall'><point x='5' y='5'/><point x='395' y='5'/><point x='395' y='295'/>
        <point x='5' y='295'/></room>
)" + more + "</home>\n";
}

/// A tetrahedron with different edges along the axes, so that its corners reveal rotations and
/// mirroring.
constexpr const char* kTetrahedron =
    "v 0 0 0\nv 2 0 0\nv 0 1 0\nv 0 0 4\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

class HomeImport : public testing::Test {
  protected:
    Scene read(const std::string& more) {
        static_cast<void>(folder.write("model.obj", kTetrahedron));
        const auto scene = importScene(folder.write("home.xml", home(more)));
        EXPECT_TRUE(scene) << describe(scene.error());
        return scene.value_or(Scene{});
    }
    std::string refusal(const std::string& text) {
        const auto scene = importScene(folder.write("home.xml", text));
        return scene ? "" : scene.error().message;
    }
    test::TempFolder folder;
};

const Object& named(const Scene& scene, const std::string& name) {
    const auto found = std::find_if(scene.objects.begin(), scene.objects.end(),
                                    [&](const Object& o) { return o.name == name; });
    EXPECT_NE(found, scene.objects.end()) << name;
    return found == scene.objects.end() ? scene.objects.front() : *found;
}

bool hasCorner(const Scene& scene, const Object& object, const Vector3d& corner) {
    for (std::uint32_t i = 0; i < object.vertex_count; ++i) {
        if ((scene.positions[object.first_vertex + i].cast<double>() - corner).norm() < 1e-4) {
            return true;
        }
    }
    return false;
}

/// Area of an object's triangles that face a direction.
double areaFacing(const Scene& scene, const Object& object, const Vector3d& direction) {
    double area = 0.0;
    for (std::uint32_t i = 0; i < object.triangle_count; ++i) {
        const Triangle& t = scene.triangles[object.first_triangle + i];
        const Vector3d a = scene.positions[t[0]].cast<double>();
        const Vector3d n = (scene.positions[t[1]].cast<double>() - a)
                               .cross(scene.positions[t[2]].cast<double>() - a);
        if (n.normalized().dot(direction) > 0.999) area += 0.5 * n.norm();
    }
    return area;
}

const std::string kPiece =
    " name='Armchair' model='model.obj' x='100' y='200' elevation='10' width='80' depth='40' "
    "height='50'";

}  // namespace

// The plan's y points down the page, so a mirrored import would look right from above.
TEST_F(HomeImport, TurnsAPieceClockwiseOnThePage) {
    const Scene scene = read("<pieceOfFurniture angle='1.5707963267948966'" + kPiece + "/>");
    const Object& piece = named(scene, "Armchair");
    EXPECT_TRUE(hasCorner(scene, piece, {1.2, -1.6, 0.1}));
    EXPECT_TRUE(hasCorner(scene, piece, {1.2, -2.4, 0.1}));
    EXPECT_TRUE(hasCorner(scene, piece, {1.2, -1.6, 0.6}));
    EXPECT_TRUE(hasCorner(scene, piece, {0.8, -1.6, 0.1}));
    EXPECT_NEAR((piece.front - Vector3d(-1, 0, 0)).norm(), 0.0, 1e-9) << piece.front;
    EXPECT_EQ(piece.front_source, FrontSource::Annotation);
    EXPECT_EQ(nyu40Name(piece.nyu40), "chair");
    EXPECT_FALSE(piece.structure);
}

TEST_F(HomeImport, MirrorsAcrossTheWidth) {
    const Scene scene = read("<pieceOfFurniture modelMirrored='true'" + kPiece + "/>");
    const Object& piece = named(scene, "Armchair");
    // Without mirroring, the long edge along the width starts at the left, x = 0.6.
    EXPECT_TRUE(hasCorner(scene, piece, {1.4, -1.8, 0.1}));
    EXPECT_TRUE(hasCorner(scene, piece, {0.6, -1.8, 0.1}));
    EXPECT_TRUE(hasCorner(scene, piece, {1.4, -1.8, 0.6}));
    EXPECT_TRUE(hasCorner(scene, piece, {1.4, -2.2, 0.1}));
    EXPECT_FALSE(hasCorner(scene, piece, {0.6, -1.8, 0.6}));
    EXPECT_NEAR((piece.front - Vector3d(0, -1, 0)).norm(), 0.0, 1e-9) << piece.front;
}

TEST_F(HomeImport, TurnsTheModelBeforeItIsSized) {
    // x to z, z to -x: the depth of 4 becomes the width.
    const Scene scene =
        read("<pieceOfFurniture modelRotation='0 0 -1 0 1 0 1 0 0'" + kPiece + "/>");
    const Object& piece = named(scene, "Armchair");
    EXPECT_TRUE(hasCorner(scene, piece, {1.4, -1.8, 0.1}));  // the right angle, at +x and -z
    EXPECT_TRUE(hasCorner(scene, piece, {0.6, -1.8, 0.1}));  // 4 along z became -x
    EXPECT_TRUE(hasCorner(scene, piece, {1.4, -2.2, 0.1}));  // 2 along x became z
}

TEST_F(HomeImport, TheUsersTableOfLabelsComesFirst) {
    static_cast<void>(folder.write("model.obj", kTetrahedron));
    const auto path = folder.write(
        "home.xml", home("<pieceOfFurniture name='Zorbling' catalogId='eTeks#bed' "
                         "model='model.obj' x='100' y='200' width='40' depth='80' height='50'/>"));
    ImportOptions options;
    options.labels = folder.write("labels.csv", "zorbling,bookshelf\n");
    const auto scene = importScene(path, options);
    ASSERT_TRUE(scene) << describe(scene.error());
    EXPECT_EQ(nyu40Name(named(*scene, "Zorbling").nyu40), "bookshelf");
    EXPECT_EQ(nyu40Name(named(read("<pieceOfFurniture name='Zorbling' catalogId='eTeks#bed' "
                                   "model='model.obj' x='100' y='200' width='40' depth='80' "
                                   "height='50'/>"),
                              "Zorbling")
                            .nyu40),
              "bed");
}

// Models with a rotation are rotated first; then the rotated model is scaled to the piece's size.
TEST_F(HomeImport, SizesAModelByItsOwnShapeAndNotItsBox) {
    const Scene scene =
        read("<pieceOfFurniture modelRotation='0.8 0 0.6 0 1 0 -0.6 0 0.8'" + kPiece + "/>");
    const Object& piece = named(scene, "Armchair");
    Eigen::AlignedBox3d box;
    for (std::uint32_t i = 0; i < piece.vertex_count; ++i) {
        box.extend(scene.positions[piece.first_vertex + i].cast<double>());
    }
    EXPECT_NEAR((box.sizes() - Vector3d(0.8, 0.4, 0.5)).norm(), 0.0, 1e-5) << box.sizes();
    EXPECT_NEAR((box.center() - Vector3d(1.0, -2.0, 0.35)).norm(), 0.0, 1e-5) << box.center();
}

TEST_F(HomeImport, JoinsWallsAtTheirCorners) {
    const Scene scene = read("");
    const Object& wall = named(scene, "wall_1");
    EXPECT_TRUE(wall.structure);
    EXPECT_EQ(wall.nyu40, kNyuWall);
    EXPECT_TRUE(hasCorner(scene, wall, {-0.05, 0.05, 0.0}));
    EXPECT_TRUE(hasCorner(scene, wall, {4.05, 0.05, 2.5}));
    EXPECT_TRUE(hasCorner(scene, wall, {0.05, -0.05, 0.0}));
    EXPECT_TRUE(hasCorner(scene, wall, {3.95, -0.05, 2.5}));
    EXPECT_NEAR(areaFacing(scene, wall, {0, 1, 0}), 4.10 * 2.5, 1e-4);
    EXPECT_NEAR(areaFacing(scene, named(scene, "floor_Hall"), {0, 0, 1}), 3.9 * 2.9, 1e-4);
    EXPECT_NEAR(areaFacing(scene, named(scene, "ceiling_Hall"), {0, 0, -1}), 3.9 * 2.9, 1e-4);
    EXPECT_NEAR(named(scene, "ceiling_Hall").box.center.z(), 2.5, 1e-5);
}

TEST_F(HomeImport, CutsTheHoleOfADoor) {
    const Scene scene = read(
        "<doorOrWindow name='Door' model='model.obj' x='200' y='0' width='90' depth='12' "
        "height='200' cutOutShape='M0,0 v1 h1 v-1 z'/>");
    const Object& wall = named(scene, "wall_1");
    EXPECT_NEAR(areaFacing(scene, wall, {0, 1, 0}), 4.10 * 2.5 - 0.9 * 2.0, 1e-4);
    EXPECT_NEAR(areaFacing(scene, wall, {0, -1, 0}), 3.90 * 2.5 - 0.9 * 2.0, 1e-4);
    // The ends and the reveal that face +x.
    EXPECT_NEAR(areaFacing(scene, wall, {1, 0, 0}), 0.1 * 2.0, 1e-4);
    EXPECT_NEAR(areaFacing(scene, wall, {0, 0, -1}), 0.1 * (4.0 + 0.9), 1e-4);  // bottom, lintel
    const Object& door = named(scene, "Door");
    EXPECT_TRUE(door.structure);
    EXPECT_EQ(door.nyu40, kNyuDoor);
    EXPECT_NEAR(areaFacing(scene, named(scene, "wall_3"), {0, -1, 0}), 4.10 * 2.5, 1e-4);
}

TEST_F(HomeImport, CutsRoundWindowsRound) {
    const Scene scene = read(
        "<doorOrWindow name='Round window' model='model.obj' x='0' y='150' angle='1.5707964' "
        "elevation='100' width='100' depth='12' height='80' "
        "cutOutShape='M0,0.5 a0.5,0.5 0 1,0 1,0 a0.5,0.5 0 1,0 -1,0 z'/>");
    const double hole = std::numbers::pi / 4.0 * 1.0 * 0.8;
    EXPECT_NEAR(areaFacing(scene, named(scene, "wall_4"), {-1, 0, 0}), 3.1 * 2.5 - hole,
                0.01 * hole);
    EXPECT_EQ(named(scene, "Round window").nyu40, kNyuWindow);
}

TEST_F(HomeImport, DrawsArcsWithoutASizeStraight) {
    const Scene scene = read(
        "<doorOrWindow name='Door' model='model.obj' x='200' y='0' width='90' depth='12' "
        "height='200' cutOutShape='M0,0 A1e-200,1e-200 0 0 1 1,1 L1,0 z'/>");
    EXPECT_NEAR(areaFacing(scene, named(scene, "wall_1"), {0, 1, 0}), 4.10 * 2.5 - 0.5 * 0.9 * 2.0,
                1e-4);
}

TEST_F(HomeImport, BendsRoundWallsToTheirLeft) {
    const Scene scene = read(
        "<wall id='r' xStart='100' yStart='200' xEnd='300' yEnd='200' height='250' "
        "heightAtEnd='150' thickness='10' arcExtent='3.1415927'/>");
    const Object& wall = named(scene, "wall_5");
    double top = 0.0;
    double high_y = -1e9;
    for (std::uint32_t i = 0; i < wall.vertex_count; ++i) {
        const auto& p = scene.positions[wall.first_vertex + i];
        high_y = std::max(high_y, static_cast<double>(p.y()));
        const double r = std::hypot(p.x() - 2.0, p.y() + 2.0);
        EXPECT_TRUE(std::abs(r - 1.05) < 1e-3 || std::abs(r - 0.95) < 1e-3) << r;
        if (p.x() > 2.9 && std::abs(p.y() + 2.0) < 1e-3)
            top = std::max(top, static_cast<double>(p.z()));
    }
    EXPECT_NEAR(high_y, -2.0 + 1.05, 1e-3);  // up the page is +y in the world
    EXPECT_NEAR(top, 1.5, 0.05);
}

TEST_F(HomeImport, StacksLevelsAndCutsStairs) {
    const Scene scene = read(
        "<level id='l0' elevation='0' floorThickness='12' height='250'/>"
        "<level id='l1' elevation='262' floorThickness='12' height='250'/>"
        "<room name='Loft' level='l1'><point x='0' y='0'/><point x='400' y='0'/>"
        "<point x='400' y='300'/><point x='0' y='300'/></room>"
        "<pieceOfFurniture level='l0' name='Staircase' model='model.obj' x='100' y='150' "
        "width='80' depth='200' height='262' staircaseCutOutShape='M0,0 v1 h1 v-1 z'/>"
        "<pieceOfFurniture level='l1' name='Sofa' model='model.obj' x='300' y='150' width='80' "
        "depth='80' height='80'/>");
    const Object& floor = named(scene, "floor_Loft");
    EXPECT_NEAR(areaFacing(scene, floor, {0, 0, 1}), 12.0 - 0.8 * 2.0, 1e-4);
    EXPECT_TRUE(hasCorner(scene, floor, {0.6, -0.5, 2.62}));
    EXPECT_TRUE(hasCorner(scene, floor, {0.6, -0.5, 2.50}));  // the side of the hole
    const Object& sofa = named(scene, "Sofa");
    EXPECT_NEAR(sofa.box.center.z() - sofa.box.half_size.z(), 2.62, 1e-4);
    EXPECT_TRUE(named(scene, "Staircase").structure);
}

TEST_F(HomeImport, ColorsPiecesAndTakesGroupsApart) {
    const Scene scene = read(
        "<furnitureGroup name='Set'><furnitureGroup name='Inner'>"
        "<pieceOfFurniture color='FFFF0000'" +
        kPiece + "/></furnitureGroup><pieceOfFurniture visible='false'" + kPiece +
        "/></furnitureGroup>");
    const Object& piece = named(scene, "Armchair");
    const Material& material = scene.materials[scene.triangle_material[piece.first_triangle]];
    EXPECT_EQ(material.base_color, Eigen::Vector3f(1, 0, 0));
    EXPECT_EQ(std::count_if(scene.objects.begin(), scene.objects.end(),
                            [](const Object& o) { return o.name == "Armchair"; }),
              1);
}

// Two of three groups have the same material, so only names distinguish pane and frame.
TEST_F(HomeImport, PanesKeepTheirOwnMaterialUnderAPiecesColor) {
    static_cast<void>(folder.write("window.mtl",
                                   "newmtl glass\nKd 0.2 0.4 0.6\nd 0.3\n"
                                   "newmtl paint\nKd 0.9 0.1 0.1\n"));
    static_cast<void>(folder.write(
        "window.obj",
        "mtllib window.mtl\nv 0 0 0\nv 3 0 0\nv 0 3 0\nv 0 0 1\ng frame\nusemtl paint\nf 1 2 3\n"
        "g sweethome3d_window_pane_on_hinge_1\nusemtl glass\nf 1 2 4\n"
        "g sweethome3d_window_pane_2\nusemtl paint\nf 1 3 4\n"));
    const std::string png("\x89PNG none");
    static_cast<void>(folder.write("wood", png));
    for (const std::string surface : {"color='FF0000FF'>",
                                      "><texture catalogId='w' name='w' width='10' height='10' "
                                      "image='wood'/>"}) {
        const Scene scene = read(
            "<doorOrWindow name='Window' catalogId='eTeks#window' model='window.obj' x='200' "
            "y='0' elevation='100' width='100' depth='10' height='100' " +
            surface + "</doorOrWindow>");
        const Object& window = named(scene, "Window");
        ASSERT_EQ(window.triangle_count, 3U);
        int glass = 0;
        int red = 0;
        for (std::uint32_t i = 0; i < window.triangle_count; ++i) {
            const Material& material =
                scene.materials[scene.triangle_material[window.first_triangle + i]];
            const Eigen::Vector3f& color = material.base_color;
            if (material.opacity < 0.5F && color.z() > color.x()) ++glass;
            if (material.texture < 0 && color.x() > 0.5F && color.z() < 0.2F) ++red;
        }
        EXPECT_EQ(glass, 1) << surface;
        EXPECT_EQ(red, 1) << "the second pane and not the frame, " << surface;
    }
}

TEST_F(HomeImport, StandsInABoxForAModelThatIsMissing) {
    const Scene scene = read(
        "<pieceOfFurniture name='Bed' catalogId='eTeks#bed' model='../../etc/passwd' x='100' "
        "y='100' width='90' depth='190' height='50'/>");
    const Object& bed = named(scene, "Bed");
    EXPECT_NEAR(areaFacing(scene, bed, {0, 0, 1}), 0.9 * 1.9, 1e-4);
    EXPECT_EQ(nyu40Name(bed.nyu40), "bed");
    EXPECT_TRUE(std::any_of(scene.report.notes.begin(), scene.report.notes.end(), [](auto& note) {
        return note.find("it was replaced by a box") != std::string::npos;
    }));
}

TEST_F(HomeImport, KnowsPiecesOfOtherLanguagesByTheirCatalogue) {
    const Scene scene = read(
        "<pieceOfFurniture name='Fauteuil' catalogId='eTeks#armchair' model='model.obj' x='100' "
        "y='100' width='90' depth='90' height='90'/>");
    EXPECT_EQ(nyu40Name(named(scene, "Fauteuil").nyu40), "chair");
}

TEST_F(HomeImport, RefusesWhatIsNoHome) {
    EXPECT_NE(refusal("<?xml version='1.0'?><!DOCTYPE home [<!ENTITY a 'b'>]><home/>")
                  .find("document type"),
              std::string::npos);
    EXPECT_NE(
        refusal(home("<wall xStart='nan' yStart='0' xEnd='1' yEnd='1'/>")).find("not a number"),
        std::string::npos);
    EXPECT_NE(refusal(home("<room><point x='1e300' y='0'/></room>")).find("10 km"),
              std::string::npos);
    EXPECT_NE(refusal("<home><wall></home>").find("not complete XML"), std::string::npos);
    EXPECT_NE(refusal("<kitchen/>"), "");
    std::string nested = "<home>";
    for (int i = 0; i < 100'000; ++i) nested += "<furnitureGroup>";
    for (int i = 0; i < 100'000; ++i) nested += "</furnitureGroup>";
    EXPECT_NE(refusal(nested + "</home>").find("nested too deep"), std::string::npos);
}

TEST_F(HomeImport, ReadsItsCamerasAsATrajectory) {
    const auto path = folder.write(
        "home.xml",
        home("<observerCamera attribute='observerCamera' x='100' y='200' z='150' yaw='0' "
             "pitch='0' fieldOfView='1.0471976'/>"
             "<camera attribute='topCamera' x='0' y='0' z='900' yaw='0' pitch='1.5'/>"
             "<observerCamera attribute='storedCamera' name='Again' x='100' y='200' z='150' "
             "yaw='0' pitch='0' fieldOfView='1.0471976'/>"
             "<observerCamera attribute='storedCamera' name='West' x='300' y='100' z='160' "
             "yaw='1.5707963267948966' pitch='0.1' fieldOfView='1.0471976'/>"));
    const auto scene = importScene(path);
    ASSERT_TRUE(scene) << describe(scene.error());
    TrajectoryReading reading;
    reading.source_from_world = scene->source_from_world;
    const auto loaded = loadTrajectory(path, reading);
    ASSERT_TRUE(loaded) << describe(loaded.error());
    EXPECT_EQ(loaded->format, "sweethome3d");
    EXPECT_NEAR(loaded->hfov_deg.value_or(0.0), 60.0, 1e-4);
    const auto& frames = loaded->trajectory.frames;
    ASSERT_EQ(frames.size(), 2U);
    EXPECT_NEAR((frames[0].pose.position - Vector3d(1, -2, 1.5)).norm(), 0.0, 1e-6);
    EXPECT_NEAR((frames[0].pose.forward() - Vector3d(0, -1, 0)).norm(), 0.0, 1e-6);
    EXPECT_NEAR((frames[1].pose.forward() - Vector3d(-std::cos(0.1), 0, -std::sin(0.1))).norm(),
                0.0, 1e-6);
    const Vector3d down = frames[1].pose.rotation * Vector3d::UnitY();
    EXPECT_LT(down.z(), -0.9);
    EXPECT_NE(frames[0].path, frames[1].path);
}

}  // namespace dollytrack::home_import_test
