#include "app/process/find_program.h"

#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

namespace dollytrack::find_program_test {
namespace {

namespace fs = std::filesystem;

/// Sets PATH and the working folder; restores both at the end.
class Surroundings {
  public:
    Surroundings(const std::string& path, const fs::path& folder) {
        const char* now = std::getenv("PATH");
        before_ = now != nullptr ? now : "";
        setenv("PATH", path.c_str(), 1);
        fs::current_path(folder);
    }
    ~Surroundings() {
        setenv("PATH", before_.c_str(), 1);
        fs::current_path(folder_before_);
    }
    Surroundings(const Surroundings&) = delete;
    Surroundings& operator=(const Surroundings&) = delete;

  private:
    std::string before_;
    fs::path folder_before_ = fs::current_path();
};

void makeFile(const fs::path& path, fs::perms permissions) {
    fs::create_directories(path.parent_path());
    std::ofstream(path) << "#!/bin/sh\n";
    fs::permissions(path, permissions);
}

TEST(FindProgram, TakesTheFirstExecutableOfThePath) {
    const test::TempFolder temporary;
    const fs::path root = fs::canonical(temporary.path());
    makeFile(root / "one" / "tool", fs::perms::owner_read);
    makeFile(root / "two" / "tool", fs::perms::owner_all);
    makeFile(root / "three" / "tool", fs::perms::owner_all);
    fs::create_directories(root / "zero" / "tool");
    const std::string path = (root / "zero").string() + ":" + (root / "one").string() +
                             "::" + (root / "two").string() + ":" + (root / "three").string();
    const Surroundings surroundings(path, root);
    EXPECT_EQ(findProgram("tool"), root / "two" / "tool");
    EXPECT_EQ(findProgram("no-such-tool"), std::nullopt);
}

TEST(FindProgram, NeverTakesAProgramOfARelativeFolder) {
    const test::TempFolder temporary;
    const fs::path root = fs::canonical(temporary.path());
    makeFile(root / "tool", fs::perms::owner_all);
    makeFile(root / "bin" / "tool", fs::perms::owner_all);
    const Surroundings surroundings(".::bin:./bin", root);
    ASSERT_TRUE(fs::exists("tool"));
    EXPECT_EQ(findProgram("tool"), std::nullopt);
}

}  // namespace
}  // namespace dollytrack::find_program_test
