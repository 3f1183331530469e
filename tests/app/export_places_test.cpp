#include "app/editor/export_places.h"

#include <gtest/gtest.h>

namespace dollytrack::editor {

TEST(ExportPlaces, GivesEveryProjectAFolderOfItsOwn) {
    ui::ExportJob job;
    job.request.folder = "/data/flat";
    EXPECT_EQ(folderBeside("/data/room", "/else/flat.dolly", {}), "/data/flat");
    EXPECT_EQ(folderBeside("/data/room/", "/else/flat.dolly", {}), "/data/flat");
    EXPECT_EQ(folderBeside("/data/room", "/else/flat.dolly", {job}), "/data/flat_2");
    EXPECT_EQ(folderBeside("/data/room", "/else/room.dolly", {job}), "/data/room_2");
}

}  // namespace dollytrack::editor
