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

/// A class as datasets name and number it.
struct DatasetClass {
    int id = 0;  // the value in class masks and the category of annotations
    std::string name;
    std::array<std::uint8_t, 3> color = {0, 0, 0};  // 8-bit sRGB
    std::string supercategory;                      // empty: none
};

/// A class of a user's own table, and which objects belong to it.
struct ClassRule {
    DatasetClass made;
    std::vector<std::string> patterns;  // see ClassTable::classFor()
};

/// The classes of a dataset: NYU40, or those of a label file. Planning and import know NYU40 alone;
/// a table maps its classes and the objects' names to the classes that the dataset is written with.
class ClassTable {
  public:
    static constexpr int kLargestId = 65'535;
    static constexpr const char* kVoidName = "void";

    static const ClassTable& nyu40();

    /// A table of one's own. Names and ids are unique, ids lie in 0 .. kLargestId.
    /// @param other    index of the class of all objects that fit no pattern; without one they have
    ///                 none: their pixels are void and they get no boxes
    /// @param void_id  of pixels without a class; an id that no class has
    ClassTable(std::vector<ClassRule> rules, std::optional<std::size_t> other, int void_id);

    /// Whether it is the built-in one.
    [[nodiscard]] bool isNyu40() const { return is_nyu40_; }
    /// By their order in the table, void not among them.
    [[nodiscard]] std::span<const DatasetClass> classes() const { return classes_; }
    [[nodiscard]] const DatasetClass& voidClass() const { return void_; }
    /// Null for an id that is neither a class's nor that of void.
    [[nodiscard]] const DatasetClass* find(int id) const;
    /// Whether class masks need 16 bits a pixel, not 8.
    [[nodiscard]] bool isWide() const { return is_wide_; }
    /// Position in classes(), which is the number YOLO gives it.
    [[nodiscard]] int indexOf(const DatasetClass& one) const {
        return static_cast<int>(&one - classes_.data());
    }

    /// The class of an object's pixels. In a table of one's own the first class counts that has a
    /// fitting pattern: the name of an NYU40 class stands for all objects of that class, whatever
    /// they are called; any other pattern, with `*` and `?`, fits the object's whole name, this
    /// name without numbers and with blanks between its words ("SofaBed_02": "sofa bed"), or that
    /// of its NYU40 class. Case does not count.
    [[nodiscard]] const DatasetClass& classFor(std::string_view object_name, int nyu40) const;
    [[nodiscard]] const DatasetClass& classOf(const Object& object) const;
    /// The class of an object's boxes and outlines: as above, but null for void; NYU40 has
    /// "otherprop" for unknown things.
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

/// The color of the class at this place of a table: hues a golden angle apart, none of those taken.
[[nodiscard]] std::array<std::uint8_t, 3> distinctColor(
    std::size_t index, std::span<const std::array<std::uint8_t, 3>> taken);

/// Sets Object::dataset_class of every object by the scene's own table; does nothing for NYU40.
/// To be called again when names or NYU40 classes have changed.
void assignDatasetClasses(Scene& scene);

}  // namespace dollytrack
