#include "engine/core/natural_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace dollytrack::natural_order_test {

TEST(NaturalOrder, NumbersCountByTheirValue) {
    std::vector<std::string> names = {"b1",
                                      "a10",
                                      "a2",
                                      "a",
                                      "a2b10",
                                      "a2b9",
                                      "a02",
                                      "a1.png",
                                      "a1.jpg",
                                      "10",
                                      "9",
                                      "",
                                      "a18446744073709551617",
                                      "a18446744073709551616"};
    std::sort(names.begin(), names.end(), comesBefore);
    const std::vector<std::string> expected = {"",
                                               "9",
                                               "10",
                                               "a",
                                               "a1.jpg",
                                               "a1.png",
                                               "a02",
                                               "a2",
                                               "a2b9",
                                               "a2b10",
                                               "a10",
                                               "a18446744073709551616",
                                               "a18446744073709551617",
                                               "b1"};
    EXPECT_EQ(names, expected);
}

// A strict weak order: no name precedes itself, and one of two different names comes first.
TEST(NaturalOrder, IsStrict) {
    const std::vector<std::string> names = {"", "0", "00", "a", "a0", "a00", "a0b", "a00a", "b"};
    for (const std::string& a : names) {
        EXPECT_FALSE(comesBefore(a, a)) << a;
        for (const std::string& b : names) {
            EXPECT_EQ(comesBefore(a, b) != comesBefore(b, a), a != b) << a << " " << b;
        }
    }
}

}  // namespace dollytrack::natural_order_test
