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

}  // namespace dollytrack::editor::export_progress_test
