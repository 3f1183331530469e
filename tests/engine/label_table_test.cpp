#include "engine/scene/label_table.h"
#include "engine/scene/labels.h"

#include <gtest/gtest.h>

namespace dollytrack {
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
        Case{"Circle.012", "void", LabelKind::None}, Case{"", "void", LabelKind::None},
        Case{"0042", "void", LabelKind::None}));

TEST(LabelTable, UserLinesReplaceAndAdd) {
    LabelTable table = LabelTable::builtIn();
    ASSERT_TRUE(table.add("# mine\nzork,lamp\ncurtain,otherfurniture,structure\n", "mine.csv"));
    EXPECT_EQ(table.find("Zork_3").nyu40, nyu40FromName("lamp"));
    EXPECT_EQ(table.find("curtain_1").kind, LabelKind::Structure);
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
    // From the last lines of the file: an error on the way would have stopped before them.
    EXPECT_EQ(LabelTable::builtIn().find("paneling").kind, LabelKind::Weak);
}

TEST(Names, LoseTheirNumbers) {
    EXPECT_EQ(withoutNumber("Sofa.001"), "Sofa");
    EXPECT_EQ(withoutNumber("chair_2_3"), "chair");
    EXPECT_EQ(withoutNumber("12"), "12");
}

}  // namespace
}  // namespace dollytrack
