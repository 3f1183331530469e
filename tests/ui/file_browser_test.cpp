#include "ui/widgets/files/file_browser.h"

#include "tests/support/temp_folder.h"
#include "tests/ui/screen.h"
#include "ui/widgets/files/file_list.h"
#include "ui/widgets/files/folder_reader.h"
#include "ui/widgets/keyboard_wait.h"

#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <thread>

namespace dollytrack::ui::file_browser_test {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> shownNames(const FolderListing& listing, const FolderOrder& order) {
    std::vector<std::string> names;
    for (const std::uint32_t row : arrange(listing, order)) {
        names.push_back(listing.entries[row].name);
    }
    return names;
}

TEST(FolderOrder, FoldersFirstAndNumbersAsNumbers) {
    const FolderListing listing{"/",
                                {{"room_10.glb", false, 5, 30},
                                 {"Room_9.glb", false, 7, 10},
                                 {"zoo", true},
                                 {".hidden.glb", false, 1, 20},
                                 {"notes.txt", false, 9, 40}},
                                {}};
    FolderOrder order;
    order.extensions = {".glb"};
    EXPECT_EQ(shownNames(listing, order),
              (std::vector<std::string>{"zoo", "Room_9.glb", "room_10.glb"}));
    order.hidden = true;
    order.key = FolderOrder::Key::Size;
    order.descending = true;
    EXPECT_EQ(shownNames(listing, order),
              (std::vector<std::string>{"zoo", "Room_9.glb", "room_10.glb", ".hidden.glb"}));
    order.key = FolderOrder::Key::Date;
    order.descending = false;
    EXPECT_EQ(shownNames(listing, order),
              (std::vector<std::string>{"zoo", "Room_9.glb", ".hidden.glb", "room_10.glb"}));
    order.folders_only = true;
    EXPECT_EQ(shownNames(listing, order), (std::vector<std::string>{"zoo"}));
}

/// A dialog that shows a folder with two scenes, a text file and a folder.
class FileBrowserTest : public testing::Test {
  protected:
    FileBrowserTest() {
        static_cast<void>(folder.write("kitchen.glb", "glb"));
        static_cast<void>(folder.write("bedroom.obj", "obj"));
        static_cast<void>(folder.write("notes.txt", "text"));
        fs::create_directory(folder.path() / "more");
        std::ofstream(folder.path() / "more" / "attic.glb") << "glb";
    }
    void ask(FileRequest::Purpose purpose, const fs::path& start = {}) {
        FileRequest request;
        request.purpose = purpose;
        request.id = "test";
        request.title = "Choose";
        request.filters = {{"Scenes", {".glb", ".obj"}}};
        request.start = start.empty() ? folder.path() : start;
        request.name = purpose == FileRequest::Purpose::Save ? "new" : "";
        request.extension = ".dolly";
        browser.ask(request);
        waitFor("files.accept");
        settle();
    }
    /// Draws frames until the widget appears, since reading the disk may take a while.
    bool waitFor(const std::string& name) {
        for (int i = 0; i < 500; ++i) {
            screen.frame();
            if (screen.shows(name)) return true;
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        return false;
    }
    void settle() {
        for (int i = 0; i < 40; ++i) {
            screen.frame();
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
    }
    test::TempFolder folder;
    FileBrowser browser;
    std::optional<FileAnswer> answer;
    test::Screen screen{[this] {
        if (auto now = browser.draw()) answer = now;
    }};
};

TEST_F(FileBrowserTest, OpensTheFileThatIsDoubleClicked) {
    ask(FileRequest::Purpose::Open);
    ASSERT_TRUE(waitFor("files.row.kitchen.glb")) << screen.names();
    EXPECT_FALSE(screen.shows("files.row.notes.txt"));
    EXPECT_FALSE(screen.enabled("files.accept"));
    screen.doubleClick("files.row.kitchen.glb");
    settle();
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->path, folder.path() / "kitchen.glb");
    EXPECT_EQ(answer->id, "test");
    EXPECT_FALSE(browser.isOpen());
}

TEST_F(FileBrowserTest, GoesIntoFoldersAndUpWithTheKeyboard) {
    ask(FileRequest::Purpose::Open);
    ASSERT_TRUE(waitFor("files.row.more"));
    screen.type("mo");
    screen.press(GLFW_KEY_ENTER);
    ASSERT_TRUE(waitFor("files.row.attic.glb")) << screen.names();
    screen.press(GLFW_KEY_BACKSPACE);
    ASSERT_TRUE(waitFor("files.row.bedroom.obj"));
    settle();
    // After going up, the folder just left is selected; the next entry is the first file.
    screen.press(GLFW_KEY_DOWN);
    screen.press(GLFW_KEY_ENTER);
    settle();
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->path, folder.path() / "bedroom.obj");
}

TEST_F(FileBrowserTest, FilterShowsOtherKinds) {
    ask(FileRequest::Purpose::Open);
    ASSERT_TRUE(screen.click("files.filter"));
    ASSERT_TRUE(screen.click("files.filter.1")) << screen.names();
    EXPECT_TRUE(waitFor("files.row.notes.txt"));
}

TEST_F(FileBrowserTest, SavingOverAFileAsksFirst) {
    static_cast<void>(folder.write("kept.dolly", "{}"));
    ask(FileRequest::Purpose::Save, folder.path() / "kept.dolly");
    screen.press(GLFW_KEY_ENTER);
    ASSERT_TRUE(waitFor("message.cancel")) << screen.names();
    EXPECT_FALSE(answer);
    ASSERT_TRUE(screen.click("message.cancel"));
    EXPECT_TRUE(browser.isOpen());
    EXPECT_FALSE(answer);
    ASSERT_TRUE(screen.click("files.accept"));
    ASSERT_TRUE(waitFor("message.replace"));
    ASSERT_TRUE(screen.click("message.replace"));
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->path, folder.path() / "kept.dolly");
}

// "room.do" could not be opened as a project, so ".dolly" is appended; an existing "room.do.dolly"
// is not overwritten without a question.
TEST_F(FileBrowserTest, SavesUnderANameThatCanBeOpenedAgain) {
    static_cast<void>(folder.write("there.do.dolly", "{}"));
    ask(FileRequest::Purpose::Save);
    screen.press(GLFW_KEY_A, true);
    screen.type("there.do");
    screen.press(GLFW_KEY_ENTER);
    ASSERT_TRUE(waitFor("message.cancel")) << screen.names();
    ASSERT_TRUE(screen.click("message.cancel"));
    ASSERT_TRUE(screen.click("files.name"));
    screen.press(GLFW_KEY_A, true);
    screen.type("room.do");
    screen.press(GLFW_KEY_ENTER);
    settle();
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->path, folder.path() / "room.do.dolly");
}

TEST_F(FileBrowserTest, WaitsForTheKeyboardOnlyUntilAFieldHasIt) {
    static_cast<void>(takeKeyboardAwaited());
    ask(FileRequest::Purpose::Save);
    EXPECT_TRUE(takeKeyboardAwaited()) << "what is typed at once is for the name";
    screen.frame(2);
    EXPECT_FALSE(takeKeyboardAwaited());
}

TEST_F(FileBrowserTest, SavingUnderANewNameAddsTheExtension) {
    ask(FileRequest::Purpose::Save);
    ASSERT_TRUE(screen.click("files.accept")) << screen.names();
    settle();
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->path, folder.path() / "new.dolly");
}

TEST_F(FileBrowserTest, TypedPathIsCompletedByTab) {
    ask(FileRequest::Purpose::Open, folder.path() / "more");
    ASSERT_TRUE(screen.click("files.path"));
    screen.press(GLFW_KEY_A, true);
    screen.type((folder.path() / "kit").string());
    ASSERT_TRUE(waitFor("files.offer.kitchen.glb")) << screen.names();
    screen.press(GLFW_KEY_TAB);
    screen.press(GLFW_KEY_ENTER);
    settle();
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->path, folder.path() / "kitchen.glb");
}

TEST_F(FileBrowserTest, AClickTakesAnOfferedFolder) {
    ask(FileRequest::Purpose::Open);
    ASSERT_TRUE(screen.click("files.path"));
    screen.press(GLFW_KEY_A, true);
    screen.type((folder.path() / "mo").string());
    ASSERT_TRUE(waitFor("files.offer.more/")) << screen.names();
    ASSERT_TRUE(screen.click("files.offer.more/"));
    EXPECT_TRUE(waitFor("files.row.attic.glb")) << screen.names();
    EXPECT_FALSE(answer);
}

TEST_F(FileBrowserTest, TypingWhatDoesNotExistSaysSoAndStays) {
    ask(FileRequest::Purpose::Open);
    ASSERT_TRUE(screen.click("files.path"));
    screen.press(GLFW_KEY_A, true);
    screen.type((folder.path() / "nothing.glb").string());
    screen.press(GLFW_KEY_ENTER);
    settle();
    EXPECT_FALSE(answer);
    EXPECT_TRUE(browser.isOpen());
}

TEST_F(FileBrowserTest, MakesAFolderAndChoosesIt) {
    ask(FileRequest::Purpose::ChooseFolder);
    EXPECT_FALSE(screen.shows("files.row.kitchen.glb"));
    ASSERT_TRUE(screen.click("files.new_folder"));
    ASSERT_TRUE(screen.shows("files.new_folder_name"));
    EXPECT_FALSE(screen.enabled("files.make_folder"));
    screen.type("dataset");
    ASSERT_TRUE(screen.click("files.make_folder")) << screen.names();
    settle();
    EXPECT_TRUE(fs::is_directory(folder.path() / "dataset"));
    ASSERT_TRUE(screen.click("files.accept"));
    settle();
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->path, folder.path() / "dataset");
}

TEST_F(FileBrowserTest, StartsAtTheNearestFolderThatExists) {
    ask(FileRequest::Purpose::Open, folder.path() / "gone" / "deeper" / "room.glb");
    EXPECT_TRUE(waitFor("files.row.kitchen.glb"));
}

TEST_F(FileBrowserTest, EscapeCancels) {
    ask(FileRequest::Purpose::Open);
    screen.press(GLFW_KEY_ESCAPE);
    EXPECT_FALSE(browser.isOpen());
    EXPECT_FALSE(answer);
}

TEST_F(FileBrowserTest, GoesToTheEndOfAFolderOfManyFiles) {
    const fs::path many = folder.path() / "many";
    fs::create_directory(many);
    for (int i = 0; i < 2000; ++i) {
        std::ofstream(many / ("frame_" + std::to_string(i) + ".glb"));
    }
    ask(FileRequest::Purpose::Open, many);
    ASSERT_TRUE(waitFor("files.row.frame_0.glb")) << screen.names();
    screen.press(GLFW_KEY_END);
    EXPECT_TRUE(waitFor("files.row.frame_1999.glb"));
    EXPECT_FALSE(screen.shows("files.row.frame_0.glb"));
}

TEST_F(FileBrowserTest, AFolderThatIsNoFolderAnyMoreIsExplained) {
    ask(FileRequest::Purpose::ChooseFolder);
    ASSERT_TRUE(waitFor("files.row.more"));
    ASSERT_TRUE(screen.click("files.row.more"));
    fs::remove_all(folder.path() / "more");
    ASSERT_TRUE(screen.click("files.accept"));
    settle();
    EXPECT_FALSE(answer);
    EXPECT_TRUE(browser.isOpen());
}

TEST(FileList, DrawsOnlyWhatIsVisibleOfAHundredThousandFiles) {
    FolderListing listing;
    for (int i = 0; i < 100'000; ++i) {
        listing.entries.push_back({"frame_" + std::to_string(i * 7919 % 100'000) + ".glb"});
    }
    FolderOrder order;
    const std::vector<std::uint32_t> rows = arrange(listing, order);
    ASSERT_EQ(rows.size(), 100'000U);
    EXPECT_EQ(listing.entries[rows[99'999]].name, "frame_99999.glb");
    FileListState state;
    test::Screen screen([&] { drawFileList({&listing, &rows, true}, order, state); });
    EXPECT_TRUE(screen.shows("files.row.frame_0.glb")) << screen.names();
    EXPECT_LT(item_map::items().size(), 100U);
    screen.type("frame_5000");
    EXPECT_EQ(state.selected, 5000);
    EXPECT_TRUE(screen.shows("files.row.frame_5000.glb"));
    screen.press(GLFW_KEY_END);
    EXPECT_TRUE(screen.shows("files.row.frame_99999.glb"));
    EXPECT_LT(item_map::items().size(), 100U);
}

}  // namespace
}  // namespace dollytrack::ui::file_browser_test
