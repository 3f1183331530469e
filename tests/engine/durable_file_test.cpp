#include "engine/io/files/durable_file.h"

#include "engine/io/files/sha256.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <fstream>
#include <iterator>

namespace dollytrack::durable_file_test {
namespace {

namespace fs = std::filesystem;

class DurableFile : public testing::Test {
  protected:
    void SetUp() override {
        std::string name = (fs::temp_directory_path() / "dollytrack_XXXXXX").string();
        ASSERT_NE(::mkdtemp(name.data()), nullptr);
        folder = name;
    }
    void TearDown() override { fs::remove_all(folder); }

    static std::string read(const fs::path& path) {
        std::ifstream file(path, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }
    [[nodiscard]] auto fileCount() const {
        return std::distance(fs::directory_iterator(folder), fs::directory_iterator());
    }

    fs::path folder;
};

TEST_F(DurableFile, ReplacesAFileAndLeavesNoTemporary) {
    ASSERT_TRUE(writeWhole(folder / "a.txt", "first"));
    ASSERT_TRUE(writeWhole(folder / "a.txt", "second", Durability::Renamed));
    EXPECT_EQ(read(folder / "a.txt"), "second");
    EXPECT_EQ(fileCount(), 1);
    EXPECT_TRUE(syncFolder(folder));
}

TEST_F(DurableFile, NamesTheMissingFolder) {
    const Status status = writeWhole(folder / "none" / "a.txt", "x");
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().code, ErrorCode::CannotWrite);
    EXPECT_NE(status.error().message.find("does not exist"), std::string::npos);
    EXPECT_EQ(status.error().where, (folder / "none" / "a.txt").string());
}

// The file size limit interrupts a real write, like a full disk.
TEST_F(DurableFile, KeepsTheOldFileWhenAWriteFailsHalfWay) {
    ASSERT_TRUE(writeWhole(folder / "a.bin", "old"));
    rlimit before{};
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{100'000, before.rlim_max};
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
    const Status status = writeWhole(folder / "a.bin", std::string(300'000, 'x'));
    ::setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);

    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().code, ErrorCode::CannotWrite);
    EXPECT_EQ(read(folder / "a.bin"), "old");
    EXPECT_EQ(fileCount(), 1);
}

TEST(CompletedName, DropsOnlyWhatWriteWholeAdds) {
    EXPECT_EQ(completedName("rgb/000000.png.tmp.123"), "rgb/000000.png");
    for (const char* other : {"000000.png", "a.tmp.", "a.tmp.12x", "a.tmp", "tmp.1", ""}) {
        EXPECT_EQ(completedName(other), other);
    }
}

TEST(WriteError, TellsTheCausesApart) {
    EXPECT_NE(writeError(ENOSPC, "x").message.find("full"), std::string::npos);
    EXPECT_NE(writeError(EACCES, "x").message.find("permission"), std::string::npos);
    EXPECT_NE(writeError(EROFS, "x").message.find("read-only"), std::string::npos);
    EXPECT_NE(writeError(EDQUOT, "x").message.find("quota"), std::string::npos);
}

// The examples of FIPS 180-2, appendix B.
TEST(Sha256, MatchesThePublishedExamples) {
    EXPECT_EQ(sha256Of("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    Sha256 pieces;
    pieces.add("abcdbcdecdefdefgefghfghighijhi");
    pieces.add("jkijkljklmklmnlmnomnopnopq");
    EXPECT_EQ(pieces.finish(), "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
}

}  // namespace
}  // namespace dollytrack::durable_file_test
