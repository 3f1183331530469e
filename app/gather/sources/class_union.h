#pragma once

#include "app/gather/sources/class_map.h"
#include "app/gather/sources/source.h"
#include "engine/core/result.h"
#include "engine/scene/class_table.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace dollytrack::gather {

/// A class of the gathered dataset.
struct GatheredClass {
    int id = 0;  // of COCO categories
    std::string name;
    std::string supercategory;
};

/// The classes of all datasets in one list. Without a class map each class keeps its id, and
/// datasets whose class tables contradict each other are refused: NYU40 in one and a user's table
/// in the other, an id with two names, a name with two ids, or a class that covers different
/// objects. With a map, classes that it gives the same name become one, numbered from 1.
class ClassUnion {
  public:
    /// Errors: BadInput, naming the two datasets, or a class of the map that no dataset has.
    [[nodiscard]] static Result<ClassUnion> of(std::span<const Source> sources,
                                               const std::optional<ClassMap>& map);

    /// In the order of the tables. YOLO and imagefolder number them from 0.
    [[nodiscard]] std::span<const GatheredClass> classes() const { return classes_; }
    /// The position in classes() of a class of a dataset.
    [[nodiscard]] std::size_t indexOf(const DatasetClass& one) const;
    /// Whether ids are those of the datasets, so that their class masks hold.
    [[nodiscard]] bool keepsIds() const { return !map_; }
    /// The classes that a dataset's table lacks: their objects have no boxes there.
    [[nodiscard]] std::vector<std::string> missingIn(const Source& source) const;

  private:
    [[nodiscard]] const std::string& nameOf(const DatasetClass& one) const;
    [[nodiscard]] std::optional<std::size_t> find(const std::string& name) const;

    std::optional<ClassMap> map_;
    std::vector<GatheredClass> classes_;
};

}  // namespace dollytrack::gather
