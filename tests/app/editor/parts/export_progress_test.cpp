#include "app/editor/export/export_progress.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace dollytrack::editor::export_progress_test {

TEST(LineSplitter, CutsHoweverTheTextArrives) {
    LineSplitter splitter;
    std::vector<std::string> lines;
    std::string line;
    for (const char* part : {"a", "b\n", "\nc\nd", "e", "\n", "rest"}) {
        splitter.add(part);
        while (splitter.take(line)) lines.push_back(line);
    }
    EXPECT_EQ(lines, (std::vector<std::string>{"ab", "", "c", "de"}));
    EXPECT_EQ(splitter.rest(), "rest");
}

TEST(ReadProgressLine, NamesMenusInsteadOfCommandLineOptions) {
    ui::ExportJob job;
    readProgressLine(
        R"({"log": {"level": "warning", "message":
            "2 meshes contain parts of several objects; leave out --keep-meshes to regroup them"}})",
        job);
    ASSERT_EQ(job.last_words.size(), 1U);
    EXPECT_EQ(job.last_words.front(),
              "2 meshes contain parts of several objects; uncheck File > Keep the file's meshes as "
              "objects to regroup them");
}

}  // namespace dollytrack::editor::export_progress_test
