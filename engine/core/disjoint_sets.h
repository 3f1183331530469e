#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace dollytrack {

/// Union-find: a partition of the numbers 0 to size() - 1 into sets that can be joined. Each set
/// is represented by one of its members, its root.
template <class Index = std::size_t>
class DisjointSets {
  public:
    /// Each number starts as a set of its own.
    explicit DisjointSets(std::size_t count = 0) : parent_(count) {
        std::iota(parent_.begin(), parent_.end(), Index{0});
    }

    /// Adds the number size() as a set of its own.
    void add() { parent_.push_back(static_cast<Index>(parent_.size())); }

    [[nodiscard]] std::size_t size() const { return parent_.size(); }

    /// The root of the set that `i` belongs to. Not const: it halves the path to the root.
    Index find(Index i) {
        while (parentOf(i) != i) i = parentOf(i) = parentOf(parentOf(i));
        return i;
    }

    /// Makes one set of two. Its root is the smaller of the two roots; so, where only this function
    /// joins sets, the root of each set is its smallest member.
    void join(Index a, Index b) {
        const Index root_a = find(a);
        const Index root_b = find(b);
        parentOf(std::max(root_a, root_b)) = std::min(root_a, root_b);
    }

    /// Makes one set of two. Its root is the root of the set that `b` belonged to.
    void joinTo(Index a, Index b) {
        const Index root_b = find(b);
        parentOf(find(a)) = root_b;
    }

  private:
    Index& parentOf(Index i) { return parent_[i]; }

    std::vector<Index> parent_;
};

}  // namespace dollytrack
