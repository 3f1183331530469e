#pragma once

#include "engine/scene/object.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dollytrack {

struct Scene;

/// A class as it is named and numbered in datasets.
struct DatasetClass {
    int id = 0;  // the value in class masks and the category of annotations
    std::string name;
    std::array<std::uint8_t, 3> color = {0, 0, 0};  // 8-bit sRGB
    std::string supercategory;                      // empty: none
};

/// A class of a user-defined table, and the patterns of the objects that belong to it.
struct ClassRule {
    DatasetClass made;
    std::vector<std::string> patterns;  // see ClassTable::classFor()
};

/// The classes of a dataset: NYU40, or those of a label file. Planning and import always work with
/// NYU40; a user-defined table maps NYU40 classes and object names to the classes that the dataset
/// is written with.
class ClassTable {
  public:
    static constexpr int kLargestId = 65'535;
    static constexpr const char* kVoidName = "void";

    static const ClassTable& nyu40();

    /// A user-defined table. Names and ids are unique, ids lie in 0 .. kLargestId.
    /// @param other    index of the class of objects that match no pattern; if empty they have no
    ///                 class: their pixels are void and they get no boxes
    /// @param void_id  id of pixels without a class; no class may have it
    ClassTable(std::vector<ClassRule> rules, std::optional<std::size_t> other, int void_id);

    /// Whether this is the built-in NYU40 table.
    [[nodiscard]] bool isNyu40() const { return is_nyu40_; }
    /// In the order of the table, without void.
    [[nodiscard]] std::span<const DatasetClass> classes() const { return classes_; }
    [[nodiscard]] const DatasetClass& voidClass() const { return void_; }
    /// The class with this id, or void; null if there is none.
    [[nodiscard]] const DatasetClass* find(int id) const;
    /// Whether class masks need 16 bits per pixel instead of 8.
    [[nodiscard]] bool isWide() const { return is_wide_; }
    /// Index in classes(); YOLO files number classes by it.
    [[nodiscard]] int indexOf(const DatasetClass& one) const {
        return static_cast<int>(&one - classes_.data());
    }

    /// The class of an object's pixels. In a user-defined table this is the first class with a
    /// matching pattern. A pattern that is the name of an NYU40 class matches all objects of that
    /// class, whatever their names. Any other pattern, in which `*` and `?` are wildcards, must
    /// match one of these entirely: the object's name; the name without numbers and with spaces
    /// between words ("SofaBed_02" becomes "sofa bed"); the name of its NYU40 class. Case does not
    /// matter.
    [[nodiscard]] const DatasetClass& classFor(std::string_view object_name, int nyu40) const;
    [[nodiscard]] const DatasetClass& classOf(const Object& object) const;
    /// The class of an object's boxes and outlines: as classFor(), but null instead of void. With
    /// NYU40, objects of unknown class are "otherprop".
    [[nodiscard]] const DatasetClass* boxClassFor(std::string_view object_name, int nyu40) const;
    [[nodiscard]] const DatasetClass* boxClassOf(const Object& object) const;

    [[nodiscard]] std::span<const ClassRule> rules() const { return rules_; }
    [[nodiscard]] std::optional<std::size_t> other() const { return other_; }

  private:
    ClassTable();  // NYU40
    [[nodiscard]] const DatasetClass* boxClass(const DatasetClass& of_pixels) const;

    std::vector<ClassRule> rules_;  // empty in NYU40
    std::vector<DatasetClass> classes_;
    DatasetClass void_;
    std::optional<std::size_t> other_;
    bool is_nyu40_ = false;
    bool is_wide_ = false;
};

/// A colour for the class with this index: hues spaced by the golden angle, different from all
/// colours in `taken`.
[[nodiscard]] std::array<std::uint8_t, 3> distinctColor(
    std::size_t index, std::span<const std::array<std::uint8_t, 3>> taken);

/// Sets Object::dataset_class of every object by the scene's own table; does nothing for NYU40.
/// Must be called again after names or NYU40 classes have changed.
void assignDatasetClasses(Scene& scene);

}  // namespace dollytrack
