#pragma once

#include "engine/core/result.h"

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dollytrack {

/// What a word in an object's name tells about the object.
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

/// Finds the NYU40 class of a name by a table of patterns. A name is split into words at capitals,
/// digits and punctuation ("SofaC_01" gives sofa, c). Of all patterns found in the name, the one
/// that ends last counts, and of those the longest: "coffee_table_book" is a book,
/// "coffee_table_01" a coffee table. Words after "with", "of", "for", "in" or "on" only describe
/// the object and are ignored, and so are the words from an adjective on that follows a noun:
/// "lampRoundTable" is a lamp, "bookcaseClosedDoors" a bookcase. A component is an object of its
/// own unless another object is named before it: "frame" is a picture, but "chair frame" is a part
/// of a chair ("picture frame" is a pattern of its own). A pattern "=text" matches only names that
/// are equal to the text, ignoring case, and takes precedence; it is used for the categories and
/// numbers of data sets.
class LabelTable {
  public:
    /// The built-in tables, assets/labels/*.csv.
    static const LabelTable& builtIn();

    /// Adds lines "pattern,class[,structure|target|part|weak|component]"; '#' starts a comment. The
    /// class is an NYU40 name, or empty for a part. A later line replaces an earlier one with the
    /// same pattern.
    Status add(std::string_view csv, const std::string& where);

    [[nodiscard]] Label find(std::string_view name) const;
    /// Whether any word of the name stands for an object of this class, also if find() decides for
    /// another word: "chair_tables" mentions both chairs and tables.
    [[nodiscard]] bool mentions(std::string_view name, int nyu40) const;
    /// The most informative of several words for one object: the first that names an object; else a
    /// part of the building; else a vague word. Points into `words`; null if all are unknown.
    [[nodiscard]] const std::string* mostTelling(std::span<const std::string> words) const;
    [[nodiscard]] std::size_t size() const { return entries_.size() + whole_names_.size(); }

  private:
    struct Entry {
        LabelKind kind = LabelKind::Target;
        int nyu40 = 0;
        bool component = false;  // a part where a thing is named before it
    };
    /// Whether a pattern of two or more words begins at words[at].
    [[nodiscard]] bool beginsPattern(const std::vector<std::string>& words, std::size_t at) const;

    std::map<std::string, Entry, std::less<>> entries_;      // words in singular, one space between
    std::map<std::string, Entry, std::less<>> whole_names_;  // lower case
    std::size_t longest_ = 1;                                // words in the longest pattern
};

/// Whether objects of this class are part of the building: wall, floor, ceiling, door, window, ...
bool isStructureClass(int nyu40);

/// Whether a name is that of a sky or a backdrop. Such an object surrounds the building and is no
/// part of it.
bool namesBackdrop(std::string_view name);

/// "SofaC_01.002" gives {"sofa", "c"}: lower case, no digits.
std::vector<std::string> wordsOfName(std::string_view name);

/// The name without an appended number: "Sofa.001", "chair_2" and "Lamp 03" give "Sofa", "chair"
/// and "Lamp". Never empty unless the name is.
std::string withoutNumber(std::string_view name);

}  // namespace dollytrack
