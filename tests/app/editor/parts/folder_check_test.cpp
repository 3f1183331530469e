#include "app/editor/export/folder_check.h"

#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

namespace dollytrack::editor::folder_check_test {
namespace {

namespace fs = std::filesystem;
using Kind = FolderFinding::Kind;

TEST(FolderCheck, KnowsWhatADatasetWouldFind) {
    const test::TempFolder temporary;
    const fs::path& root = temporary.path();
    fs::create_directories(root / "empty");
    for (const char* folder : {"others", "dataset", "unfinished", "rooms"}) {
        fs::create_directories(root / folder);
    }
    for (const char* file : {"file", "others/note.txt", "dataset/dataset.json",
                             "unfinished/.dollytrack-export", "rooms/rooms.json"}) {
        ASSERT_TRUE(fs::exists(temporary.write(file, "{}")));
    }
    const auto kindOf = [](const fs::path& folder) { return lookAtFolder(folder).kind; };
    EXPECT_EQ(kindOf(root / "empty"), Kind::Free);
    EXPECT_EQ(kindOf(root / "new"), Kind::New);
    EXPECT_EQ(kindOf(root / "new/"), Kind::New);
    EXPECT_EQ(kindOf(root / "new" / "below"), Kind::NewInNew);
    EXPECT_EQ(lookAtFolder(root / "new" / "below" / "it").around, root);
    EXPECT_EQ(kindOf(root / "file"), Kind::NoFolder);
    EXPECT_EQ(kindOf(root / "file" / "below"), Kind::NoFolder);
    EXPECT_EQ(kindOf(root / "others"), Kind::OtherFiles);
    EXPECT_EQ(kindOf(root / "dataset"), Kind::Dataset);
    EXPECT_EQ(kindOf(root / "rooms"), Kind::Dataset);
    EXPECT_EQ(kindOf(root / "unfinished"), Kind::Unfinished);
}

}  // namespace
}  // namespace dollytrack::editor::folder_check_test
