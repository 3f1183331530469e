#include "app/editor/export/other_projects.h"

#include "engine/io/settings/project_file.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

#include <thread>

namespace dollytrack::editor::other_projects_test {
namespace {

OtherProject next(OtherProjects& projects) {
    while (true) {
        if (std::optional<OtherProject> read = projects.take()) return std::move(*read);
        std::this_thread::yield();
    }
}

TEST(OtherProjects, AreReadInTheOrderInWhichTheyWereAdded) {
    const test::TempFolder temporary;
    ProjectFile project;
    project.scene = temporary.path() / "room.obj";
    const std::filesystem::path plain = temporary.path() / "plain.dolly";
    const std::filesystem::path traced = temporary.path() / "traced.dolly";
    const std::filesystem::path missing = temporary.path() / "missing.dolly";
    ASSERT_TRUE(saveProject(project, plain));
    project.parameters = {{"picture", {{"render_mode", "traced"}}}};
    ASSERT_TRUE(saveProject(project, traced));

    OtherProjects projects([] {});
    EXPECT_TRUE(projects.reading().empty());
    for (const auto& file : {traced, missing, plain}) projects.read(file);
    EXPECT_EQ(projects.reading(), traced);
    const OtherProject first = next(projects);
    EXPECT_EQ(first.file, traced);
    ASSERT_TRUE(first.render_mode) << describe(first.render_mode.error());
    EXPECT_EQ(*first.render_mode, RenderMode::Traced);
    const OtherProject second = next(projects);
    EXPECT_EQ(second.file, missing);
    EXPECT_FALSE(second.render_mode);
    const OtherProject third = next(projects);
    EXPECT_EQ(third.file, plain);
    ASSERT_TRUE(third.render_mode);
    EXPECT_EQ(*third.render_mode, PictureParams().render_mode);
    EXPECT_TRUE(projects.reading().empty());
}

TEST(OtherProjects, ThoseThatWereCancelledNeverArrive) {
    const test::TempFolder temporary;
    OtherProjects projects([] {});
    projects.read(temporary.path() / "one.dolly");
    projects.read(temporary.path() / "two.dolly");
    projects.cancel();
    EXPECT_TRUE(projects.reading().empty());
    EXPECT_FALSE(projects.take());
    projects.read(temporary.path() / "three.dolly");
    EXPECT_EQ(next(projects).file, temporary.path() / "three.dolly");
    EXPECT_FALSE(projects.take());
}

}  // namespace
}  // namespace dollytrack::editor::other_projects_test
