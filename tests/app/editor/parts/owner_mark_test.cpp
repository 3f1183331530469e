#include "app/editor/files/owner_mark.h"

#include "tests/support/temp_folder.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>

namespace dollytrack::editor::owner_mark_test {
namespace {

namespace fs = std::filesystem;

/// The result of isHeld() in another process.
bool heldForOthers(const fs::path& folder, const std::string& mark) {
    const pid_t other = fork();
    if (other == 0) _exit(OwnerMark::isHeld(folder, mark) ? 1 : 0);
    int status = 0;
    waitpid(other, &status, 0);
    return WIFEXITED(status) && WEXITSTATUS(status) == 1;
}

TEST(OwnerMark, IsHeldAsLongAsItsOwnerLives) {
    const test::TempFolder folder;
    std::string text;
    {
        OwnerMark mark(folder.path() / "state");
        text = mark.text();
        mark.hold();
        EXPECT_TRUE(OwnerMark::isHeld(folder.path() / "state", text)) << "by this process as well";
        EXPECT_TRUE(heldForOthers(folder.path() / "state", text));
        EXPECT_TRUE(fs::exists(folder.path() / "state" / (text + ".lock")));
    }
    EXPECT_FALSE(fs::exists(folder.path() / "state" / (text + ".lock")));
}

TEST(OwnerMark, EndsWithAProcessThatIsKilled) {
    const test::TempFolder folder;
    int told[2] = {};
    ASSERT_EQ(pipe(told), 0);
    const pid_t owner = fork();
    if (owner == 0) {
        OwnerMark mark(folder.path());
        mark.hold();
        const ssize_t written = write(told[1], mark.text().data(), mark.text().size());
        pause();
        _exit(written > 0 ? 0 : 1);
    }
    char text[256] = {};
    ASSERT_GT(read(told[0], text, sizeof text - 1), 0);
    EXPECT_TRUE(OwnerMark::isHeld(folder.path(), text));
    kill(owner, SIGKILL);
    waitpid(owner, nullptr, 0);
    EXPECT_FALSE(OwnerMark::isHeld(folder.path(), text));
    EXPECT_TRUE(fs::exists(folder.path() / (std::string(text) + ".lock")));
    OwnerMark::tidy(folder.path());
    EXPECT_FALSE(fs::exists(folder.path() / (std::string(text) + ".lock")));
    close(told[0]);
    close(told[1]);
}

// In a home folder that several computers share, this computer cannot look up the process numbers
// of the others.
TEST(OwnerMark, OfAnotherComputerIsJudgedByItsLockAlone) {
    const test::TempFolder folder;
    const std::string other = "elsewhere-1-77";
    EXPECT_TRUE(OwnerMark::isHeld(folder.path(), other)) << "no lock: it may run";
    const fs::path lock = folder.write(other + ".lock", "");
    EXPECT_FALSE(OwnerMark::isHeld(folder.path(), other)) << "a lock that nobody holds";
    const int file = open(lock.c_str(), O_RDWR);
    ASSERT_EQ(flock(file, LOCK_SH | LOCK_NB), 0);
    EXPECT_FALSE(OwnerMark::isHeld(folder.path(), other)) << "a lock of another kind";
    struct flock whole {};
    whole.l_type = F_WRLCK;
    whole.l_whence = SEEK_SET;
    ASSERT_EQ(fcntl(file, F_OFD_SETLK, &whole), 0);
    EXPECT_TRUE(OwnerMark::isHeld(folder.path(), other));
    close(file);
}

TEST(OwnerMark, OfAProcessOfThisComputerIsLookedUpWhereThereIsNoLock) {
    const test::TempFolder folder;
    const OwnerMark self(folder.path());  // not held
    EXPECT_TRUE(OwnerMark::isHeld(folder.path(), self.text()));
    const std::string text = self.text();
    const std::string host = text.substr(0, text.find('-'));
    EXPECT_FALSE(OwnerMark::isHeld(folder.path(), host + "-" + std::to_string(getpid()) + "-1"))
        << "another process had the number before";
    // Marks of earlier versions do not contain a host name.
    EXPECT_TRUE(OwnerMark::isHeld(folder.path(), text.substr(text.find('-') + 1)));
    EXPECT_FALSE(OwnerMark::isHeld(folder.path(), "room"));
    EXPECT_FALSE(OwnerMark::isHeld(folder.path(), ""));
}

}  // namespace
}  // namespace dollytrack::editor::owner_mark_test
