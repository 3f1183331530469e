#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack::verify {

/// One deviation and its location.
struct Finding {
    std::string file;                         // relative to the dataset folder
    std::optional<int> frame;                 // index in the dataset
    std::optional<std::array<int, 2>> pixel;  // column, row
    std::string found;                        // for example "2.314 m"
    std::string expected;                     // for example "2.301 m"; may be empty
};

/// Findings of one check: all are counted, the first kKept are stored.
struct Findings {
    static constexpr std::size_t kKept = 20;

    std::vector<Finding> first;
    std::size_t count = 0;

    void add(Finding finding) {
        ++count;
        if (first.size() < kKept) first.push_back(std::move(finding));
    }
    void append(const Findings& more) {
        count += more.count;
        for (const Finding& one : more.first) {
            if (first.size() < kKept) first.push_back(one);
        }
    }
};

/// Collects wrong pixels of one kind in one image, for a single finding with the first pixel and
/// the count.
class WrongPixels {
  public:
    /// `describe()` returns {found, expected}; it is called for the first pixel only.
    template <class Describe>
    void add(int x, int y, Describe&& describe) {
        if (count_++ > 0) return;
        pixel_ = {x, y};
        text_ = describe();
    }
    [[nodiscard]] std::size_t count() const { return count_; }

    void report(const std::string& file, int frame, Findings& findings) const {
        if (count_ == 0) return;
        std::string found = text_.found;
        if (count_ > 1) found += " (and " + std::to_string(count_ - 1) + " pixels more)";
        findings.add({file, frame, pixel_, std::move(found), text_.expected});
    }

    struct Text {
        std::string found, expected;
    };

  private:
    std::size_t count_ = 0;
    std::array<int, 2> pixel_ = {0, 0};
    Text text_;
};

}  // namespace dollytrack::verify
