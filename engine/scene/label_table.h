#pragma once

#include "engine/core/result.h"

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dollytrack {

/// What a word in an object's name says about it.
enum class LabelKind {
    None,       // no known word
    Target,     // a thing to look at
    Structure,  // wall, floor, ceiling, door, window and the like
    Part,       // a piece of something: leg, handle, leaves
    Weak,       // a material or a vague word, used when nothing better is there
};

struct Label {
    LabelKind kind = LabelKind::None;
    int nyu40 = 0;        // 0 for None and for parts without a class
    std::string pattern;  // the words that decided, "coffee table"
};

/// Finds the NYU40 class of a name. Names are split into words at capitals, digits and signs
/// ("SofaC_01" gives sofa, c); of the patterns found in it the one that ends last counts, and of
/// those the longest ("coffee_table_book" is a book, "coffee_table_01" a coffee table). Words
/// after "with", "of", "for", "in", "on" describe and do not count. A component is a thing of its
/// own, but a part of the thing that is named before it ("frame" is a picture, "chair frame" a part
/// of a chair; "picture frame" is a pattern of its own). A line "=text" is for the name
/// that is just that text, capitals aside, and goes before all words: categories and numbers of
/// data sets.
class LabelTable {
  public:
    /// The tables that come with the program: assets/labels/*.csv.
    static const LabelTable& builtIn();

    /// Reads lines "pattern,class[,structure|target|part|weak|component]"; '#' starts a comment.
    /// The class is an NYU40 name, or empty for a part. Later lines replace earlier ones of the
    /// same pattern.
    Status add(std::string_view csv, const std::string& where);

    [[nodiscard]] Label find(std::string_view name) const;
    /// Whether one of the name's patterns names a thing of this class, be it the one that counts or
    /// not: "chair_tables" holds both.
    [[nodiscard]] bool mentions(std::string_view name, int nyu40) const;
    /// Of several words said of one thing: the first that names a thing; else a part of the
    /// building, else a vague word. Points into `words`; null where none is known.
    [[nodiscard]] const std::string* mostTelling(std::span<const std::string> words) const;
    [[nodiscard]] std::size_t size() const { return entries_.size() + whole_names_.size(); }

  private:
    struct Entry {
        LabelKind kind = LabelKind::Target;
        int nyu40 = 0;
        bool component = false;  // a part where a thing is named before it
    };
    std::map<std::string, Entry, std::less<>> entries_;      // words in singular, one space between
    std::map<std::string, Entry, std::less<>> whole_names_;  // lower case
    std::size_t longest_ = 1;                                // words in the longest pattern
};

/// Whether things of this class are part of the building: wall, floor, ceiling, door, window, ...
bool isStructureClass(int nyu40);

/// "SofaC_01.002" gives {"sofa", "c"}: lower case, no digits.
std::vector<std::string> splitWords(std::string_view name);

/// The name without the number a program appended: "Sofa.001", "chair_2", "Lamp 03" give "Sofa",
/// "chair", "Lamp". Never empty unless the name is.
std::string withoutNumber(std::string_view name);

}  // namespace dollytrack
