#include "engine/core/log.h"

#include <gtest/gtest.h>

#include <vector>

namespace dollytrack {

TEST(Log, FoldsRepeatsIntoOneRecordWithACount) {
    std::vector<log::Record> records;
    const log::Sink before = log::setSink([&](const log::Record& r) { records.push_back(r); });
    log::warn("import", "no texture");
    log::warn("import", "no texture");
    log::warn("import", "no texture");
    log::info("import", "done");
    log::debug("import", "below the level");
    log::setSink(before);

    ASSERT_EQ(records.size(), 3U);
    EXPECT_EQ(records[0].repeats, 1);
    EXPECT_EQ(records[1].message, "no texture");
    EXPECT_EQ(records[1].repeats, 3);
    EXPECT_EQ(records[2].message, "done");
}

}  // namespace dollytrack
