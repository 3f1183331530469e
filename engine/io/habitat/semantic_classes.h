#pragma once

#include "engine/io/habitat/dataset_config.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack::habitat {

/// The classes that a dataset's semantic files give its objects: by the `semantic_id` of an object
/// and a lexicon, {"classes": [{"id": 5, "name": "chair"}]}, else by the name of its model and a
/// table, as HSSD's objects.csv.
class SemanticClasses {
  public:
    /// Reads the files of a scene instance: its `semantic_scene_instance` names the lexicon, or a
    /// semantic config (NAME.semantic_config.json) that names it; without a name the dataset's only
    /// lexicon is taken. Files that are missing or cannot be used are warned of by name.
    static SemanticClasses read(const Dataset& dataset, const nlohmann::json& instance,
                                const std::filesystem::path& scene);

    /// The class of an object, as the files write it; empty without one. The instance's attributes
    /// count before its template's. `model` is the template's name without folders and endings.
    std::string classOf(const nlohmann::json& instance, const nlohmann::json& attributes,
                        const std::string& model);

    /// What is missing, and which numbers of objects have no class.
    [[nodiscard]] std::vector<std::string> warnings() const;
    [[nodiscard]] const std::vector<std::string>& notes() const { return notes_; }

  private:
    void readDescriptor(const Dataset& dataset, const std::filesystem::path& file,
                        const std::string& handle);
    void readOnlyLexicon(const Dataset& dataset);
    void readLexicon(const std::filesystem::path& file);
    bool takeClasses(const nlohmann::json& document, const std::filesystem::path& file);
    void readTable(const std::filesystem::path& file);

    std::map<std::int64_t, std::string> by_id_;
    std::map<std::string, std::string> by_model_;
    std::filesystem::path lexicon_;                    // empty: none was read
    std::map<std::int64_t, std::size_t> unknown_ids_;  // and how many objects have them
    std::string no_lexicon_;  // why there is none, of a semantic config that holds regions alone
    std::vector<std::string> problems_;
    std::vector<std::string> notes_;
};

}  // namespace dollytrack::habitat
