#include "app/editor/export/export_folders.h"
#include "app/editor/export/export_program.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

namespace dollytrack::editor::export_folders_test {

TEST(ExportPlaces, GivesEveryProjectAFolderOfItsOwn) {
    ui::ExportJob job;
    job.request.folder = "/data/flat";
    EXPECT_EQ(folderBeside("/data/room", "/else/flat.dolly", {}), "/data/flat");
    EXPECT_EQ(folderBeside("/data/room/", "/else/flat.dolly", {}), "/data/flat");
    EXPECT_EQ(folderBeside("/data/room", "/else/flat.dolly", {job}), "/data/flat_2");
    EXPECT_EQ(folderBeside("/data/room", "/else/room.dolly", {job}), "/data/room_2");
}

TEST(ExportPlaces, FindsAFreeFolderForOneMoreDataset) {
    const dollytrack::test::TempFolder temporary;
    const std::filesystem::path folder = temporary.path() / "dataset";
    ui::ExportJob job;
    job.request.folder = temporary.path() / "dataset_3";
    EXPECT_EQ(freeFolderBeside(folder, {}), temporary.path() / "dataset_2");
    EXPECT_EQ(freeFolderBeside(folder / "", {job}), temporary.path() / "dataset_2");
    (void)temporary.write("dataset_2/dataset.json", "{}");
    EXPECT_EQ(freeFolderBeside(folder, {job}), temporary.path() / "dataset_4");
    EXPECT_EQ(freeFolderBeside(temporary.path() / "dataset_2", {}), temporary.path() / "dataset_3");
    EXPECT_EQ(freeFolderBeside(temporary.path() / "v1.5", {}), temporary.path() / "v1.5_2");
}

TEST(ExportProgram, IsAskedForWhatWasChosen) {
    ui::ExportJob job;
    job.request.folder = "/data/flat";
    const std::vector<std::string> plain = exportCommand("dollytrack", "/a b/flat.dolly", job);
    EXPECT_EQ(plain,
              (std::vector<std::string>{"dollytrack", "export", "/a b/flat.dolly", "--out",
                                        "/data/flat", "--range", "::", "--progress", "json"}));
    job.request.modalities = {"rgb", "depth"};
    job.request.rig = "cameras.json";
    job.request.still = true;
    std::vector<std::string> more = plain;
    for (const char* word : {"--modalities", "rgb,depth", "--rig", "cameras.json", "--still"}) {
        more.emplace_back(word);
    }
    EXPECT_EQ(exportCommand("dollytrack", "/a b/flat.dolly", job), more);
}

}  // namespace dollytrack::editor::export_folders_test
