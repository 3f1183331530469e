#include "engine/core/disjoint_sets.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

namespace dollytrack::disjoint_sets_test {
namespace {

using Pairs = std::vector<std::pair<int, int>>;

/// Pairs of numbers below `count`.
rc::Gen<Pairs> anyPairs(int count) {
    return rc::gen::container<Pairs>(
        rc::gen::pair(rc::gen::inRange(0, count), rc::gen::inRange(0, count)));
}

/// A label for each element, by definition: joining two sets relabels all members of one.
std::vector<int> labelsOf(int count, const Pairs& joined) {
    std::vector<int> labels(count);
    std::iota(labels.begin(), labels.end(), 0);
    for (const auto& [a, b] : joined) {
        const int from = labels[a];
        const int to = labels[b];
        std::replace(labels.begin(), labels.end(), from, to);
    }
    return labels;
}

RC_GTEST_PROP(DisjointSets, AJoinedRootIsTheSmallestMember, ()) {
    const int count = *rc::gen::inRange(1, 40);
    const Pairs pairs = *anyPairs(count);

    DisjointSets<int> sets(static_cast<std::size_t>(count));
    for (const auto& [a, b] : pairs) sets.join(a, b);

    const std::vector<int> labels = labelsOf(count, pairs);
    for (int i = 0; i < count; ++i) {
        const auto first = std::find(labels.begin(), labels.end(), labels[i]);
        RC_ASSERT(sets.find(i) == static_cast<int>(first - labels.begin()));
    }
}

// joinTo() makes the root of the second set the root of both.
RC_GTEST_PROP(DisjointSets, JoinToKeepsTheSecondRoot, ()) {
    const int count = *rc::gen::inRange(1, 40);
    const Pairs pairs = *anyPairs(count);

    DisjointSets<int> sets(static_cast<std::size_t>(count));
    for (const auto& [a, b] : pairs) sets.joinTo(a, b);

    const std::vector<int> labels = labelsOf(count, pairs);
    for (int i = 0; i < count; ++i) RC_ASSERT(sets.find(i) == labels[i]);
}

TEST(DisjointSets, AnAddedNumberIsASetOfItsOwn) {
    DisjointSets sets;
    for (int i = 0; i < 3; ++i) sets.add();
    sets.join(0, 2);
    sets.add();
    ASSERT_EQ(sets.size(), 4U);
    EXPECT_EQ(sets.find(1), 1U);
    EXPECT_EQ(sets.find(2), 0U);
    EXPECT_EQ(sets.find(3), 3U);
}

}  // namespace
}  // namespace dollytrack::disjoint_sets_test
