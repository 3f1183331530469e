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

/// The classes of objects in a dataset's semantic files: by `semantic_id` and a lexicon,
/// {"classes": [{"id": 5, "name": "chair"}]}, otherwise by model name and a table like HSSD's
/// objects.csv.
class SemanticClasses {
  public:
    /// Reads the semantic files of a scene instance. Its `semantic_scene_instance` names the
    /// lexicon, or a semantic config (NAME.semantic_config.json) that names it; without it the
    /// dataset's only lexicon is used. Missing or unusable files become warnings().
    static SemanticClasses read(const Dataset& dataset, const nlohmann::json& instance,
                                const std::filesystem::path& scene);

    /// The class name of an object as written in the files; empty without one. Attributes of the
    /// instance take precedence over those of its template. `model` is the template's shortName().
    std::string classOf(const nlohmann::json& instance, const nlohmann::json& attributes,
                        const std::string& model);

    /// Problems with the files, and the semantic_ids that the lexicon does not contain.
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
    std::filesystem::path lexicon_;                    // empty if none was read
    std::map<std::int64_t, std::size_t> unknown_ids_;  // number of objects by unknown id
    std::string no_lexicon_;  // why there is none: the semantic config holds regions only
    std::vector<std::string> problems_;
    std::vector<std::string> notes_;
};

}  // namespace dollytrack::habitat
