#pragma once

#include <nlohmann/json.hpp>

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace dollytrack::habitat {

/// Finds misspelt keys ("translaton") in Habitat's files. Other unknown keys are accepted, because
/// programs add their own.
class KeyCheck {
  public:
    enum class Place { DatasetConfig, Section, SceneInstance, Instance, Description };

    /// Checks the keys of a JSON object in the file named `file`. The same misspelling in the same
    /// file is recorded once.
    void check(const nlohmann::json& object, Place place, const std::string& file);

    /// One line per misspelt key; beyond 20, only their number.
    [[nodiscard]] std::vector<std::string> warnings() const;

  private:
    std::vector<std::string> lines_;
    std::set<std::pair<std::string, std::string>> seen_;  // file and key
    std::set<std::pair<Place, std::string>> fine_;        // keys that are not misspelt
};

}  // namespace dollytrack::habitat
