#pragma once

#include <nlohmann/json.hpp>

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace dollytrack::habitat {

/// Finds keys of Habitat's files that are slips of known ones: "translaton". Other unknown keys are
/// fine; programs add their own.
class KeyCheck {
  public:
    enum class Place { DatasetConfig, Section, SceneInstance, Instance, Description };

    /// Looks at the keys of one object of a file. `file` is its name; of the same slip in the same
    /// file the first is kept.
    void check(const nlohmann::json& object, Place place, const std::string& file);

    /// A line for each slip; of more than 20 how many there are.
    [[nodiscard]] std::vector<std::string> warnings() const;

  private:
    std::vector<std::string> lines_;
    std::set<std::pair<std::string, std::string>> seen_;  // file and key
    std::set<std::pair<Place, std::string>> fine_;        // keys that are no slips
};

}  // namespace dollytrack::habitat
