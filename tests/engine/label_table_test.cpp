#include "engine/scene/label_table.h"
#include "engine/scene/labels.h"

#include <gtest/gtest.h>

namespace dollytrack::label_table_test {
namespace {

struct Case {
    const char* name;
    const char* nyu40;
    LabelKind kind = LabelKind::Target;
};

class LabelCases : public testing::TestWithParam<Case> {};

TEST_P(LabelCases, FindsTheClass) {
    const Label label = LabelTable::builtIn().find(GetParam().name);
    EXPECT_EQ(nyu40Name(label.nyu40), GetParam().nyu40) << "by pattern " << label.pattern;
    EXPECT_EQ(label.kind, GetParam().kind);
}

constexpr LabelKind kTarget = LabelKind::Target;
constexpr LabelKind kStructure = LabelKind::Structure;

INSTANTIATE_TEST_SUITE_P(
    Names, LabelCases,
    testing::Values(
        Case{"coffee_table_01", "table"}, Case{"coffee_table_book", "books"},
        Case{"bed side table", "night stand"}, Case{"Bedside_table_1", "night stand"},
        Case{"SofaC_01_001", "sofa"}, Case{"TVCabinet_01_001", "cabinet"},
        Case{"wall_shelf", "shelves"}, Case{"WallArt", "picture"}, Case{"floor_lamp", "lamp"},
        Case{"window_plant", "otherprop"}, Case{"doormat", "floor mat"},
        Case{"DeskPortraitA_01", "picture"}, Case{"cabinet_door", "cabinet"},
        Case{"Wall_double_switch_12", "otherprop"}, Case{"Bowl_with_fruits_17", "otherprop"},
        Case{"chest of drawers", "dresser"}, Case{"IKEA_cupboard_BILLY_1", "bookshelf"},
        Case{"bookShelves.003", "bookshelf"}, Case{"ShowerCurtain", "shower curtain"},
        Case{"NightStand_01_002", "night stand"}, Case{"Apple_iBook_27", "otherprop"},
        Case{"Refrigerator_01_001", "refrigerator"}, Case{"curtains", "curtain"},
        Case{"Mirror.001", "mirror"}, Case{"carpet", "floor mat"}, Case{"TV_02", "television"},
        Case{"toilet_brush", "otherprop"}, Case{"trash_can", "otherprop"},
        Case{"wall_n", "wall", kStructure}, Case{"HouseWallB_01", "wall", kStructure},
        Case{"RoomWindow_01", "window", kStructure}, Case{"FloorB_01", "floor", kStructure},
        Case{"FoldingDoor_02", "door", kStructure}, Case{"ceiling", "ceiling", kStructure},
        Case{"skydome", "otherstructure", kStructure}, Case{"ground_plane", "floor", kStructure},
        Case{"baseboard_3", "wall", kStructure}, Case{"SofaLegs_Mesh021", "sofa", LabelKind::Part},
        Case{"ChairFrame", "chair", LabelKind::Part},
        Case{"ChairFrame_2", "chair", LabelKind::Part},
        Case{"mirror_frame", "mirror", LabelKind::Part}, Case{"Frame_01", "picture"},
        Case{"picture_frame", "picture"}, Case{"PosterFrame", "picture"},
        Case{"window_frame", "window", kStructure}, Case{"chair_leg", "chair", LabelKind::Part},
        Case{"TableTop", "table"}, Case{"DeskTop", "desk"},
        Case{"lamp_shade", "lamp", LabelKind::Part}, Case{"bed_frame", "bed"},
        Case{"DarkWoodMat_1", "otherfurniture", LabelKind::Weak}, Case{"GlassTableMat", "table"},
        Case{"orange_1_orangeMat_0", "void", LabelKind::None}, Case{"kitchen_mat", "floor mat"},
        Case{"Pic03", "picture"}, Case{"ChromeMat", "otherprop", LabelKind::Weak},
        Case{"VelvetMat", "otherprop", LabelKind::Weak}, Case{"bath_mat", "floor mat"},
        Case{"Circle.012", "void", LabelKind::None}, Case{"", "void", LabelKind::None},
        Case{"0042", "void", LabelKind::None}));

TEST(LabelTable, UserLinesReplaceAndAdd) {
    LabelTable table = LabelTable::builtIn();
    ASSERT_TRUE(table.add("# mine\nzork,lamp\ncurtain,otherfurniture,structure\n", "mine.csv"));
    EXPECT_EQ(table.find("Zork_3").nyu40, nyu40FromName("lamp"));
    EXPECT_EQ(table.find("curtain_1").kind, LabelKind::Structure);
}

TEST(LabelTable, WholeNamesGoBeforeWords) {
    LabelTable table = LabelTable::builtIn();
    ASSERT_TRUE(table.add("=Desk/Lamp,desk\n=04379243,lamp\n", "mine.csv"));
    EXPECT_EQ(table.find(" desk/LAMP").nyu40, nyu40FromName("desk"));
    EXPECT_EQ(table.find("desk/lamp_2").nyu40, nyu40FromName("lamp"));
    EXPECT_EQ(table.find("04379243").nyu40, nyu40FromName("lamp"));
    // A user's words take precedence over full names of the built-in table.
    EXPECT_EQ(table.find("Wine Cooler").nyu40, nyu40FromName("cabinet"));
    ASSERT_TRUE(table.add("wine coolers,refrigerator\n", "mine.csv"));
    EXPECT_EQ(table.find("Wine Cooler").nyu40, nyu40FromName("refrigerator"));
    EXPECT_FALSE(table.add("=,lamp\n", "mine.csv"));
}

struct DatasetCase {
    const char* name;
    const char* nyu40;
};

// Categories of data sets, with the expected NYU40 classes.
TEST(LabelTable, KnowsTheCategoriesOfDataSets) {
    for (const DatasetCase& c : std::initializer_list<DatasetCase>{
             {"Bookcase / jewelry Armoire", "bookshelf"},
             {"Drawer Chest / Corner cabinet", "cabinet"},
             {"Sideboard / Side Cabinet / Console Table", "cabinet"},
             {"Cabinet/Shelf/Desk", "cabinet"},
             {"Pier/Stool", "chair"},
             {"Lounge Chair / Cafe Chair / Office Chair", "chair"},
             {"Footstool / Sofastool / Bed End Stool / Stool", "chair"},
             {"Three-Seat / Multi-seat Sofa", "sofa"},
             {"Chaise Longue Sofa", "sofa"},
             {"King-size Bed", "bed"},
             {"Nightstand", "night stand"},
             {"Corner/Side Table", "table"},
             {"TV Stand", "cabinet"},
             {"Pendant Lamp", "lamp"},
             {"Others", "otherfurniture"},
             {"e7a0801e-7abd-4634-b3bc-8777342d124e", "lamp"},
             {"24670BF9-9c9f-41ae-b190-f5f65eab4ddb", "bed"},
             {"d6bba626-68d1-4bd7-a32a-bd21457e54a0", "otherfurniture"},
             {"WallInner", "wall"},
             {"SlabTop", "ceiling"},
             {"CustomizedFeatureWall", "wall"},
             {"03001627", "chair"},
             {"04256520", "sofa"},
             {"03928116", "otherfurniture"},
             {"02691156", "otherprop"},
             {"20000039", "table"}}) {
        const Label label = LabelTable::builtIn().find(c.name);
        EXPECT_EQ(nyu40Name(label.nyu40), c.nyu40) << c.name;
    }
}

// Real names of furniture, from Kenney's furniture kit (main noun first) and the catalogues of
// Sweet Home 3D (main noun last), with the classes that the models show.
TEST(LabelTable, KnowsTheMainNounOfRealNames) {
    for (const DatasetCase& c :
         std::initializer_list<DatasetCase>{{"bookcaseClosedDoors", "bookshelf"},
                                            {"bookcaseClosedDoors(Clone)", "bookshelf"},
                                            {"bookcaseOpenLow", "bookshelf"},
                                            {"lampRoundTable", "lamp"},
                                            {"lampSquareTable", "lamp"},
                                            {"lampRoundFloor", "lamp"},
                                            {"lampSquareFloor", "lamp"},
                                            {"lampSquareCeiling", "lamp"},
                                            {"lampWall", "lamp"},
                                            {"chairModernCushion", "chair"},
                                            {"chairModernFrameCushion", "chair"},
                                            {"chairDesk", "chair"},
                                            {"stoolBarSquare", "chair"},
                                            {"tableCoffeeGlassSquare", "table"},
                                            {"tableCrossCloth", "table"},
                                            {"tableRound", "table"},
                                            {"sideTableDrawers", "table"},
                                            {"cabinetTelevision", "cabinet"},
                                            {"cabinetTelevisionDoors", "cabinet"},
                                            {"cabinetBedDrawerTable", "night stand"},
                                            {"kitchenCabinetDrawer", "cabinet"},
                                            {"bathroomSinkSquare", "sink"},
                                            {"cardboardBoxOpen", "box"},
                                            {"kitchenFridgeLarge", "refrigerator"},
                                            {"loungeSofaLong", "sofa"},
                                            {"pillowBlueLong", "pillow"},
                                            {"rugRectangle", "floor mat"},
                                            {"televisionVintage", "television"},
                                            {"wallWindowSlide", "window"},
                                            {"doorwayOpen", "door"},
                                            {"floorCornerRound", "floor"},
                                            {"Baby_high_chair_7", "chair"},
                                            {"Bedside table", "night stand"},
                                            {"Coffee table", "table"},
                                            {"Dresser with drawers", "dresser"},
                                            {"kitchenDrawersCabinet", "cabinet"},
                                            {"Sliding doors", "door"},
                                            {"wardrobeWithSlidingDoors", "cabinet"},
                                            {"Table lamp", "lamp"},
                                            {"Toilet paper dispenser", "otherprop"},
                                            {"CompoundCeiling:GypsumBoard", "ceiling"},
                                            {"GypsumBoard", "wall"},
                                            {"Wall lamp", "lamp"}}) {
        const Label label = LabelTable::builtIn().find(c.name);
        EXPECT_EQ(nyu40Name(label.nyu40), c.nyu40) << c.name << " by pattern " << label.pattern;
    }
}

TEST(LabelTable, NamesTheLineThatIsWrong) {
    LabelTable table;
    const Status status = table.add("sofa,sofa\nlamp,candelabrum\n", "mine.csv");
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().code, ErrorCode::BadInput);
    EXPECT_EQ(status.error().where, "mine.csv:2");
}

TEST(LabelTable, BuiltInTableIsReadToItsEnd) {
    EXPECT_GT(LabelTable::builtIn().size(), 1500U);
    // Words from the last lines of the file, which would not be read after an error.
    EXPECT_EQ(LabelTable::builtIn().find("paneling").kind, LabelKind::Weak);
    EXPECT_EQ(LabelTable::builtIn().find("c280a0a3-4a30-4683-8f8d-f55da3f7b53a").kind,
              LabelKind::Weak);
    EXPECT_EQ(LabelTable::builtIn().find("20000041").kind, LabelKind::Target);
}

TEST(LabelTable, KnowsWordsOfOtherLanguages) {
    const LabelTable& table = LabelTable::builtIn();
    const auto classOf = [&](std::string_view name) { return table.find(name).nyu40; };
    for (const char* name : {"стол", "Стол_02", "СТОЛ", "mesa.001", "Tisch", "桌子_3", "Stół"}) {
        EXPECT_EQ(classOf(name), nyu40FromName("table")) << name;
    }
    EXPECT_EQ(classOf("Żłóbek"), 0);
    EXPECT_EQ(table.find("duvar").kind, LabelKind::Structure);
    EXPECT_EQ(table.find("Fenêtre").kind, LabelKind::Structure);
    EXPECT_EQ(table.find("FENÊTRE").nyu40, nyu40FromName("window"));
    // "机" is a desk or a machine, so that any other word counts more.
    EXPECT_EQ(table.find("机").kind, LabelKind::Weak);
    EXPECT_EQ(classOf("lamp_机"), nyu40FromName("lamp"));
}

// "wood" is less specific than "chair", in any position.
TEST(LabelTable, TheMostTellingWordNamesAThing) {
    const LabelTable& table = LabelTable::builtIn();
    const std::vector<std::string> both = {"wood_thing", "", "wall_2", "chair_01"};
    ASSERT_EQ(table.find(both[0]).kind, LabelKind::Weak);
    EXPECT_EQ(table.mostTelling(both), &both[3]);
    EXPECT_EQ(table.mostTelling(std::span(both).first(3)), &both[2]);
    EXPECT_EQ(table.mostTelling(std::span(both).first(2)), both.data());
    EXPECT_EQ(table.mostTelling(std::span(both).subspan(1, 1)), nullptr);
}

TEST(Names, LoseTheirNumbers) {
    EXPECT_EQ(withoutNumber("Sofa.001"), "Sofa");
    EXPECT_EQ(withoutNumber("chair_2_3"), "chair");
    EXPECT_EQ(withoutNumber("12"), "12");
}

}  // namespace
}  // namespace dollytrack::label_table_test
