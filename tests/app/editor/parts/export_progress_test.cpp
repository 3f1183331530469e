#include "app/editor/export/export_progress.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace dollytrack::editor {

TEST(LineCutter, CutsHoweverTheTextArrives) {
    LineCutter cutter;
    std::vector<std::string> lines;
    std::string line;
    for (const char* part : {"a", "b\n", "\nc\nd", "e", "\n", "rest"}) {
        cutter.add(part);
        while (cutter.take(line)) lines.push_back(line);
    }
    EXPECT_EQ(lines, (std::vector<std::string>{"ab", "", "c", "de"}));
    EXPECT_EQ(cutter.rest(), "rest");
}

}  // namespace dollytrack::editor
