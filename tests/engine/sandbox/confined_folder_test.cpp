#include "engine/io/files/confined_folder.h"
#include "engine/io/files/input_record.h"
#include "engine/io/sandbox/input_list.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <filesystem>

namespace dollytrack::confined_folder_test {
namespace {

namespace fs = std::filesystem;
using test::TempFolder;

/// A scene's folder beside a secret file.
struct Folders {
    TempFolder all;
    fs::path scene = all.path() / "scene";

    Folders() {
        fs::create_directories(scene / "maps");
        EXPECT_FALSE(all.write("secret.txt", "secret").empty());
        EXPECT_FALSE(all.write("scene/room.mtl", "newmtl a").empty());
        EXPECT_FALSE(all.write("scene/maps/oak.png", "png").empty());
    }
};

TEST(ConfinedFolder, OpensWhatLiesBeneath) {
    const Folders folders;
    const ConfinedFolder folder(folders.scene);
    for (const fs::path& name :
         {fs::path("room.mtl"), fs::path("./room.mtl"), fs::path("maps/../room.mtl"),
          fs::path(folder.relative(folders.scene / "room.mtl")),
          fs::path(folder.relative(folders.scene / "maps" / "oak.png"))}) {
        const auto file = folder.open(name);
        ASSERT_TRUE(file) << name << file.error().message;
        EXPECT_EQ(file->size(), name.filename() == "room.mtl" ? 8U : 3U);
        EXPECT_TRUE(folder.has(name));
    }
    fs::create_symlink("room.mtl", folders.scene / "link.mtl");
    const auto linked = folder.open("link.mtl");
    ASSERT_TRUE(linked);
    EXPECT_EQ(*linked->readAll(100), "newmtl a");
    EXPECT_FALSE(linked->readAll(7));
}

// A reader prepends the folder to all names in a scene, including absolute ones.
TEST(ConfinedFolder, AbsoluteNamesStayAbsolute) {
    const Folders folders;
    const ConfinedFolder folder(folders.scene);
    const std::string before = folders.scene.string() + "/";
    EXPECT_EQ(folder.relative(before + "/etc/passwd"), "/etc/passwd");
    EXPECT_EQ(folder.relative(before + "/etc/pass"), "etc/pass");  // no such file
    EXPECT_EQ(folder.relative(before + "/room.mtl"), "room.mtl");
    EXPECT_EQ(folder.relative(before + "none.mtl"), "none.mtl");
    InputRecord record;
    EXPECT_FALSE(folder.has(folder.relative(before + "/etc/passwd")));
    const std::vector<InputUse> uses = record.uses();
    ASSERT_EQ(uses.size(), 1U);
    EXPECT_EQ(uses[0].kind, InputUse::Refused);
    EXPECT_EQ(uses[0].path, "/etc/passwd");
}

TEST(ConfinedFolder, RefusesWhatLiesOutside) {
    const Folders folders;
    fs::create_symlink(folders.all.path() / "secret.txt", folders.scene / "out");
    fs::create_symlink("..", folders.scene / "up");
    fs::create_symlink("loop", folders.scene / "loop");
    fs::create_symlink("/proc/self", folders.scene / "self");
    const ConfinedFolder folder(folders.scene);
    for (const fs::path& name :
         {fs::path("../secret.txt"), fs::path("maps/../../secret.txt"), fs::path("out"),
          fs::path("up/secret.txt"), fs::path("loop"), fs::path("self/environ"),
          fs::path("/etc/hostname"), folders.all.path() / "secret.txt",
          folders.scene / ".." / "secret.txt"}) {
        EXPECT_FALSE(folder.open(name)) << name;
        EXPECT_FALSE(folder.has(name)) << name;
    }
}

// A pipe would block its reader forever, and a folder is not a file.
TEST(ConfinedFolder, RefusesWhatIsNoFile) {
    const Folders folders;
    ASSERT_EQ(mkfifo((folders.scene / "pipe").c_str(), 0600), 0);
    const int made = socket(AF_UNIX, SOCK_STREAM, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    (folders.scene / "sock").string().copy(address.sun_path, sizeof(address.sun_path) - 1);
    ASSERT_EQ(bind(made, reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
    close(made);
    const ConfinedFolder folder(folders.scene);
    for (const std::string& name : {std::string("pipe"), std::string("sock"), std::string("maps"),
                                    std::string(""), std::string("."), std::string("gone"),
                                    std::string(300, 'x'), std::string("room.mtl\0.png", 13)}) {
        EXPECT_FALSE(folder.open(name)) << name;
        EXPECT_FALSE(folder.has(name)) << name;
    }
}

// The list of inputs is returned, and one with such a name would be refused.
TEST(ConfinedFolder, ForgetsNamesThatNoFileCanHave) {
    const Folders folders;
    const InputRecord record;
    const ConfinedFolder folder(folders.scene);
    EXPECT_FALSE(folder.has(std::string("maps/\0.png", 10)));
    EXPECT_TRUE(record.uses().empty());
    EXPECT_FALSE(folder.has("maps/elm.png"));
    ASSERT_EQ(record.uses().size(), 1U);
    EXPECT_TRUE(parseInputList(inputListText(record.uses())));
}

// All folders in the list are listed again for validation.
TEST(ConfinedFolder, NoReadingListsThousandsOfFolders) {
    std::vector<InputUse> uses(1000);
    for (InputUse& use : uses) use.kind = InputUse::Listing;
    EXPECT_TRUE(parseInputList(inputListText(uses)));
    uses.push_back(uses.front());
    EXPECT_FALSE(parseInputList(inputListText(uses)));
}

TEST(ConfinedFolder, ListsFilesButNoLinks) {
    const Folders folders;
    fs::create_symlink("/etc", folders.scene / "etc");
    fs::create_symlink("room.mtl", folders.scene / "link.mtl");
    const ConfinedFolder folder(folders.scene);
    EXPECT_EQ(folder.list(), (std::vector<fs::path>{"room.mtl", "maps/oak.png"}));
    EXPECT_TRUE(ConfinedFolder(folders.all.path() / "gone").list().empty());
    EXPECT_FALSE(ConfinedFolder(folders.all.path() / "gone").open("room.mtl"));
}

}  // namespace
}  // namespace dollytrack::confined_folder_test
