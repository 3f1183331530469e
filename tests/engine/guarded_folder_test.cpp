#include "engine/io/files/guarded_folder.h"

#include "tests/support/temp_folder.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>

namespace dollytrack::guarded_folder_test {
namespace {

namespace fs = std::filesystem;

class GuardedFolderTest : public testing::Test {
  protected:
    [[nodiscard]] std::string victim() const {
        std::ifstream file(victim_, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }

    test::TempFolder temporary_;
    fs::path victim_ = temporary_.write("outside/000000.png", "victim");
    fs::path path_ = temporary_.path() / "own";
    GuardedFolder folder_ = *GuardedFolder::make(path_);
};

TEST_F(GuardedFolderTest, WritesReadsMovesAndRemoves) {
    ASSERT_TRUE(folder_.write("a/b/file", std::string_view("text")));
    const auto bytes = folder_.read("a/b/file");
    ASSERT_TRUE(bytes);
    EXPECT_EQ(std::string(bytes->begin(), bytes->end()), "text");
    ASSERT_TRUE(folder_.move("a/b/file", folder_, "c/file").value_or(false));
    EXPECT_FALSE(folder_.move("a/b/file", folder_, "c/file").value_or(true));
    EXPECT_FALSE(folder_.move("missing/file", folder_, "c/file").value_or(true));
    EXPECT_EQ(*folder_.list(""), (std::vector<std::string>{"a", "c"}));
    EXPECT_TRUE(folder_.list("a/missing/below")->empty());
    EXPECT_TRUE(folder_.remove("a/missing/below"));
    EXPECT_TRUE(folder_.remove("c/file"));
    folder_.removeEmpty("a/b");
    folder_.removeEmpty("c");
    EXPECT_TRUE(fs::is_empty(path_));
}

TEST_F(GuardedFolderTest, FollowsNoLink) {
    fs::create_directory_symlink("../outside", path_ / "pictures");
    fs::create_symlink("../outside/000000.png", path_ / "file");
    for (const std::string name : {"pictures/000000.png", "file"}) {
        const Status written = folder_.write(name, std::string_view("lost"));
        ASSERT_FALSE(written) << name;
        EXPECT_EQ(written.error().code, ErrorCode::CannotWrite);
        EXPECT_NE(written.error().message.find("link"), std::string::npos);
        EXPECT_EQ(written.error().where, (path_ / name.substr(0, name.find('/'))).string());
        EXPECT_FALSE(folder_.openEmptied(name));
        EXPECT_FALSE(folder_.read(name));
    }
    EXPECT_FALSE(folder_.remove("pictures/000000.png"));
    EXPECT_FALSE(folder_.list("pictures"));
    EXPECT_FALSE(folder_.checkFolder("pictures/more"));
    EXPECT_FALSE(folder_.makeWithin("pictures/more"));
    EXPECT_FALSE(folder_.move("file", folder_, "pictures/000000.png"));
    EXPECT_TRUE(folder_.remove("file"));  // the link itself
    EXPECT_EQ(victim(), "victim");
    EXPECT_EQ(std::distance(fs::directory_iterator(victim_.parent_path()), {}), 1);
}

TEST_F(GuardedFolderTest, LeavesFilesWithASecondNameAlone) {
    fs::create_hard_link(victim_, path_ / "file");
    fs::create_hard_link(victim_, path_ / ("written.tmp." + std::to_string(::getpid())));
    EXPECT_FALSE(folder_.openEmptied("file"));
    EXPECT_FALSE(folder_.openFile("file", O_WRONLY | O_TRUNC));
    EXPECT_TRUE(folder_.write("file", std::string_view("new")));  // replaces only this name
    EXPECT_TRUE(folder_.write("written", std::string_view("new")));
    EXPECT_EQ(victim(), "victim");
}

TEST_F(GuardedFolderTest, RefusesNamesThatLeadOut) {
    for (const std::string name :
         {"", ".", "..", "../outside/000000.png", "a/../../outside", "/tmp", "a//b", "a/", "./a"}) {
        EXPECT_FALSE(folder_.write(name, std::string_view("lost"))) << name;
        EXPECT_FALSE(folder_.makeWithin(name)) << name;
        (void)folder_.remove(name);
    }
    EXPECT_EQ(victim(), "victim");
    EXPECT_TRUE(fs::is_empty(path_));
}

// A folder that is replaced by a link after it was opened: the opened folder is used.
TEST_F(GuardedFolderTest, HoldsAFolderThatIsReplacedByALink) {
    const auto held = folder_.makeWithin("rgb");
    ASSERT_TRUE(held);
    fs::rename(path_ / "rgb", path_ / "moved");
    fs::create_directory_symlink("../outside", path_ / "rgb");
    EXPECT_TRUE(held->write("000000.png", std::string_view("new")));
    EXPECT_TRUE(fs::exists(path_ / "moved/000000.png"));
    EXPECT_EQ(victim(), "victim");
}

}  // namespace
}  // namespace dollytrack::guarded_folder_test
