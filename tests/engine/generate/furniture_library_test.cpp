#include "engine/generate/furniture/furniture_role.h"
#include "engine/generate/room_spec.h"
#include "engine/io/files/zip_writer.h"
#include "engine/io/homes/home_writer.h"
#include "engine/io/homes/home_xml.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

namespace dollytrack::generate::furniture_library_test {
namespace {

constexpr const char* kCatalog =
    "id=Test#Models\nname=Test caf\xE9\nlicense=CC-BY\n# a comment\n\n"
    "id#1=Test#chair\nname#1=Chair\ncategory#1=Office\nmodel#1=/test/chair/chair.obj\n"
    "width#1=50.5\r\ndepth#1=40\nheight#1=90\ncreator#1=Jos\\u00e9\n"
    "id#2=Test#nothing\nname#2=No size\nmodel#2=/a.obj\nwidth#2=5\ndepth#2=x\nheight#2=1\n"
    "id#3=Test#window\nname#3=Turn window\nmodel#3=/w/w.obj\nwidth#3=60\ndepth#3=14\n"
    "height#3=100\nelevation#3=104\ndoorOrWindow#3=true\ndoorOrWindowCutOutShape#3=M0,0 v1 h1 z\n"
    "modelRotation#3=1 0 0 0 0 1 0 -1 0\n";

CatalogPiece piece(const std::string& name, double width, double elevation = 0.0) {
    CatalogPiece one;
    one.id = "Test#" + name;
    one.name = name;
    one.category = "Lights";
    one.width = one.depth = one.height = width;
    one.elevation = elevation;
    return one;
}

}  // namespace

TEST(FurnitureCatalog, ReadsWhatALibraryLists) {
    const CatalogText text = parseCatalog(kCatalog);
    EXPECT_EQ(text.name, "Test caf\xC3\xA9");
    ASSERT_EQ(text.pieces.size(), 2U);
    const CatalogPiece& chair = text.pieces[0];
    EXPECT_EQ(chair.id, "Test#chair");
    EXPECT_EQ(chair.model, "test/chair/chair.obj");
    EXPECT_EQ(chair.creator, "Jos\xC3\xA9");
    EXPECT_EQ(chair.license, "CC-BY");
    EXPECT_DOUBLE_EQ(chair.width, 50.5);
    EXPECT_FALSE(chair.opening);
    const CatalogPiece& window = text.pieces[1];
    EXPECT_TRUE(window.opening);
    EXPECT_EQ(window.cut_out, "M0,0 v1 h1 z");
    ASSERT_TRUE(window.model_rotation);
    EXPECT_DOUBLE_EQ((*window.model_rotation)(2, 1), -1.0);
}

TEST(FurnitureCatalog, SaysWhichPackageIsMissing) {
    const test::TempFolder folder;
    const auto catalog = FurnitureCatalog::open(folder.path());
    ASSERT_FALSE(catalog);
    EXPECT_EQ(catalog.error().code, ErrorCode::BadInput);
    EXPECT_NE(catalog.error().message.find("sweethome3d-furniture"), std::string::npos);
}

TEST(FurnitureRoles, TakeTheirPiecesByNamePlaceAndSize) {
    const auto rules = parseRoles(
        "# comment\nfloor_lamp,floor,Lights,15-70,0-70,10-200,Lamp;!Test#x\n"
        "ceiling_lamp,high,-Office,10-100,0-100,3-90,Lamp\n",
        "roles.csv");
    ASSERT_TRUE(rules) << describe(rules.error());
    const RoleRule& stands = rules->at(0);
    const RoleRule& hangs = rules->at(1);
    EXPECT_TRUE(stands.admits(piece("Lamp", 30)));
    EXPECT_FALSE(stands.admits(piece("Lamp", 30, 180)));
    EXPECT_FALSE(stands.admits(piece("Lamp", 90)));
    EXPECT_FALSE(stands.admits(piece("Chair", 30)));
    EXPECT_TRUE(hangs.admits(piece("Lamp", 30, 180)));
    EXPECT_FALSE(hangs.admits(piece("Lamp", 30)));
    CatalogPiece excluded = piece("Lamp", 30);
    excluded.id = "Test#x";
    EXPECT_FALSE(stands.admits(excluded));
    CatalogPiece opening = piece("Lamp", 30);
    opening.opening = true;
    EXPECT_FALSE(stands.admits(opening));
}

TEST(FurnitureRoles, NameTheLineThatIsWrong) {
    for (const char* line : {"lump,floor,,1-2,1-2,1-2,Lamp", "bed,roof,,1-2,1-2,1-2,Bed",
                             "bed,floor,,2-1,1-2,1-2,Bed", "bed,floor,,1-2,1-2,Bed"}) {
        const auto rules = parseRoles(std::string("# roles\n") + line, "roles.csv");
        ASSERT_FALSE(rules) << line;
        EXPECT_EQ(rules.error().where, "roles.csv:2");
    }
}

TEST(RoomPresets, VaryLittleAndRepeat) {
    for (const RoomPreset& preset : roomPresets()) {
        const RoomSpec a = varied(preset.spec, 3, 5);
        const RoomSpec b = varied(preset.spec, 3, 5);
        EXPECT_EQ(a.length_m, b.length_m);
        EXPECT_NE(a.length_m, varied(preset.spec, 3, 6).length_m);
        EXPECT_NEAR(a.width_m, preset.spec.width_m, 0.05 * preset.spec.width_m + 0.005);
        EXPECT_NEAR(a.objects, preset.spec.objects, 0.1 * preset.spec.objects + 0.5);
    }
}

TEST(HomeWriter, WritesWhatIsReadBack) {
    homes::Home home;
    home.wall_height = 270.5;
    homes::HomeWall wall;
    wall.end = {400.1, 0};
    wall.thickness = 24;
    wall.height = wall.height_at_end = 270.5;
    wall.at_start = wall.at_end = 0;
    wall.left.texture = homes::HomeTexture{"wall.png", 150, 140};
    wall.right.color = Eigen::Vector3f(1.0F, 0.0F, 0.0F);
    home.walls.push_back(wall);
    homes::HomeRoom room;
    room.name = "A & B";
    room.points = {{0, 0}, {400, 0}, {400, 300}};
    room.floor.texture = homes::HomeTexture{"floor.png", 100, 100};
    home.rooms.push_back(room);
    homes::HomePiece piece;
    piece.kind = homes::PieceKind::Opening;
    piece.name = "Door <1>";
    piece.catalog_id = "Test#door";
    piece.model = "a/b.obj";
    piece.position = {0.1, 1.0 / 3.0};
    piece.elevation = 2;
    piece.angle = 1.25;
    piece.width = 90;
    piece.mirrored = true;
    piece.model_rotation = Eigen::Matrix3d(Eigen::Vector3d(1, -1, -1).asDiagonal());
    piece.wall_cut_out = "M0,0 v1 h1 v-1 z";
    home.pieces.push_back(piece);

    const auto read = homes::parseHomeXml(homes::homeXml(home, "t.sh3d"), "t.sh3d");
    ASSERT_TRUE(read) << describe(read.error());
    EXPECT_EQ(read->wall_height, 270.5);
    ASSERT_EQ(read->walls.size(), 1U);
    EXPECT_EQ(read->walls[0].end, wall.end);
    EXPECT_EQ(read->walls[0].at_end, 0);
    EXPECT_EQ(read->walls[0].left.texture->image, "wall.png");
    EXPECT_EQ(read->walls[0].left.texture->height_cm, 140);
    EXPECT_FALSE(read->walls[0].right.texture);
    EXPECT_EQ(read->walls[0].right.color, wall.right.color);
    ASSERT_EQ(read->rooms.size(), 1U);
    EXPECT_EQ(read->rooms[0].name, "A & B");
    EXPECT_EQ(read->rooms[0].points, room.points);
    EXPECT_EQ(read->rooms[0].floor.texture->image, "floor.png");
    EXPECT_FALSE(read->rooms[0].ceiling.texture);
    ASSERT_EQ(read->pieces.size(), 1U);
    const homes::HomePiece& door = read->pieces[0];
    EXPECT_EQ(door.kind, homes::PieceKind::Opening);
    EXPECT_EQ(door.name, "Door <1>");
    EXPECT_EQ(door.position, piece.position) << "to the last bit";
    EXPECT_EQ(door.angle, 1.25);
    EXPECT_TRUE(door.mirrored);
    EXPECT_EQ(*door.model_rotation, *piece.model_rotation);
}

TEST(ZipWriter, WritesWhatIsReadBack) {
    std::vector<std::uint8_t> long_text(100'000, 'x');
    const std::vector<ArchiveFile> files = {
        {"a.txt", {'h', 'i'}}, {"b/c.txt", long_text}, {"d.png", {1, 2, 3}}};
    const auto archive = makeArchive(files);
    ASSERT_TRUE(archive) << describe(archive.error());
    EXPECT_LT(archive->size(), 2000U) << "deflated";
    EXPECT_EQ(*archive, makeArchive(files).value());
    const auto source = openArchive(*archive, "test");
    ASSERT_TRUE(source) << describe(source.error());
    EXPECT_EQ((*source)->names().size(), 3U);
    EXPECT_EQ((*source)->read("b/c.txt").value(), long_text);
    EXPECT_EQ((*source)->read("d.png").value(), files[2].bytes);
}

}  // namespace dollytrack::generate::furniture_library_test
