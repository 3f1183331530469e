#include "engine/io/habitat/semantic_classes.h"

#include "engine/core/clean_text.h"
#include "engine/core/name_pattern.h"
#include "engine/core/text_lists.h"
#include "engine/io/files/bounded_json.h"
#include "engine/io/files/input_file.h"
#include "engine/io/files/number_lines.h"
#include "engine/io/habitat/attributes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <set>
#include <string_view>

namespace dollytrack::habitat {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr double kMostSemanticId = 1e9;
constexpr std::uint64_t kMostTableBytes = std::uint64_t{64} << 20U;
constexpr const char* kDescriptorKey = "semantic_descriptor_filename";

/// Whether a class name is empty or a placeholder, such as "unknown".
bool saysNothing(const std::string& name) {
    const std::string small = inSmallLetters(name);
    return small.empty() || small == "unknown" || small == "undefined" || small == "none";
}

/// The cells of a CSV line; cells may be quoted.
std::vector<std::string> cellsOf(std::string_view line) {
    std::vector<std::string> cells(1);
    bool quoted = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const char c = line[i];
        if (c == '"') {
            const bool twice = quoted && i + 1 < line.size() && line[i + 1] == '"';
            if (twice) cells.back() += line[++i];
            quoted = twice ? quoted : !quoted;
        } else if (c == ',' && !quoted) {
            cells.emplace_back();
        } else if (c != '\r') {
            cells.back() += c;
        }
    }
    return cells;
}

/// The column whose title is the first of `names` that occurs.
std::optional<std::size_t> columnOf(const std::vector<std::string>& titles,
                                    std::initializer_list<std::string_view> names) {
    for (const std::string_view name : names) {
        const auto at = std::ranges::find(titles, name);
        if (at != titles.end()) return static_cast<std::size_t>(at - titles.begin());
    }
    return std::nullopt;
}

std::string shownName(const fs::path& file) {
    return cleanText(file.filename().string());
}

}  // namespace

SemanticClasses SemanticClasses::read(const Dataset& dataset, const json& instance,
                                      const fs::path& scene) {
    SemanticClasses classes;
    const std::string handle = withConfigName(textIn(instance, "semantic_scene_instance"), scene);
    if (handle.empty()) {
        classes.readOnlyLexicon(dataset);
    } else if (const auto file = dataset.findSemanticFile(handle)) {
        classes.readDescriptor(dataset, *file, handle);
    } else if (const auto usual = dataset.defaultLexicon()) {
        classes.readLexicon(*usual);
    } else {
        const std::string written = dataset.semanticPathOf(handle);
        classes.problems_.push_back(fmt::format(
            "the semantic file {} is missing, so that classes are found by name; correct its path "
            "in semantic_scene_descriptor_instances",
            cleanText(written.empty() ? handle : fmt::format("{} ({})", written, handle))));
    }
    std::set<fs::path> tables;
    for (const fs::path& file : dataset.semanticFiles()) {
        if (file.extension() == ".csv") tables.insert(file);
    }
    // HSSD's table is beside its lexicon and not listed in the config.
    if (!classes.lexicon_.empty()) {
        const auto beside = dataset.files().find(classes.lexicon_.parent_path(), "objects.csv");
        if (beside) tables.insert(*beside);
    }
    for (const fs::path& table : tables) classes.readTable(table);
    return classes;
}

/// Reads a lexicon, or a semantic config and the lexicon it names (relative to the config's folder,
/// otherwise to the dataset's).
void SemanticClasses::readDescriptor(const Dataset& dataset, const fs::path& file,
                                     const std::string& handle) {
    if (file.extension() != ".json") {
        readLexicon(file);
        return;
    }
    const Result<json> document = readBoundedJson(file);
    if (!document) {
        problems_.push_back(
            "the semantic file " + shownName(file) +
            " cannot be read, so that classes are found by name: " + document.error().message);
        return;
    }
    if (takeClasses(*document, file)) return;
    std::string named = textIn(*document, kDescriptorKey);
    if (named.empty()) named = textIn(dataset.semanticDefaults(), kDescriptorKey);
    if (named.empty()) {
        no_lexicon_ = "the semantic file " + shownName(file) + " has neither \"classes\" nor a " +
                      kDescriptorKey + ", so that classes are found by name";
        return;
    }
    named = withConfigName(named, file);
    auto lexicon = dataset.files().find(file.parent_path(), named);
    if (!lexicon) lexicon = dataset.files().find(dataset.folder(), named);
    if (lexicon) {
        readLexicon(*lexicon);
        return;
    }
    problems_.push_back("the semantic lexicon " + cleanText(named) + " that " + cleanText(handle) +
                        " names is missing, so that classes are found by name");
}

void SemanticClasses::readOnlyLexicon(const Dataset& dataset) {
    std::vector<fs::path> lexicons;
    for (const fs::path& file : dataset.semanticFiles()) {
        if (file.filename().string().ends_with("lexicon.json")) lexicons.push_back(file);
    }
    if (lexicons.empty()) {
        if (const auto usual = dataset.defaultLexicon()) readLexicon(*usual);
        return;
    }
    if (lexicons.size() == 1) {
        readLexicon(lexicons.front());
        return;
    }
    std::vector<std::string> names;
    for (const fs::path& file : lexicons) names.push_back(shownName(file));
    problems_.push_back("the dataset has several semantic lexicons (" + listOf(names, 5) +
                        ") and the scene names none; name one as semantic_scene_instance");
}

void SemanticClasses::readLexicon(const fs::path& file) {
    if (file.extension() != ".json") {
        problems_.push_back(
            "the semantic file " + shownName(file) +
            " is not a lexicon of classes (JSON), so that classes are found by name");
        return;
    }
    const Result<json> document = readBoundedJson(file);
    if (!document) {
        problems_.push_back(
            "the semantic lexicon " + shownName(file) +
            " cannot be read, so that classes are found by name: " + document.error().message);
    } else if (!takeClasses(*document, file)) {
        problems_.push_back("the semantic lexicon " + shownName(file) +
                            " has no list \"classes\" of {\"id\", \"name\"}, so that classes are "
                            "found by name");
    }
}

/// Stores the classes of a lexicon. Returns false if the file has no list of classes.
bool SemanticClasses::takeClasses(const json& document, const fs::path& file) {
    for (const json& entry : listIn(document, "classes")) {
        if (!entry.is_object()) continue;
        const std::optional<double> id = numberAt(entry, "id");
        const std::string name = textIn(entry, "name");
        if (id && std::abs(*id) < kMostSemanticId && !name.empty()) {
            by_id_[static_cast<std::int64_t>(*id)] = name;
        }
    }
    if (by_id_.empty()) return false;
    lexicon_ = file;
    notes_.push_back(fmt::format("{} of the semantic lexicon {}",
                                 counted(by_id_.size(), "class", "classes"), shownName(file)));
    return true;
}

/// Reads a table of models (CSV with a header line). HSSD's has many columns, such as id and
/// main_category.
void SemanticClasses::readTable(const fs::path& file) {
    const Result<std::string> text = readNamedFile(file, kMostTableBytes);
    if (!text) {
        problems_.push_back("the table of models " + shownName(file) +
                            " cannot be read and was left out: " + text.error().message);
        return;
    }
    std::optional<std::size_t> id;
    std::optional<std::size_t> word;
    bool first = true;
    for (const std::string_view line : splitLines(*text)) {
        const std::vector<std::string> cells = cellsOf(line);
        if (first) {
            first = false;
            id = columnOf(cells, {"id", "object_id", "template_name", "handle", "name"});
            word = columnOf(cells, {"main_category", "clean_category", "semantic_category",
                                    "category", "class", "label"});
            if (id && word && id != word) continue;
            problems_.push_back("the table of models " + shownName(file) +
                                " was left out, since its first line names no column of models "
                                "(id) and of classes (main_category)");
            return;
        }
        if (std::max(*id, *word) >= cells.size() || saysNothing(cells[*word])) continue;
        by_model_.try_emplace(cleanText(cells[*id]), cleanText(cells[*word]));
    }
}

std::string SemanticClasses::classOf(const json& instance, const json& attributes,
                                     const std::string& model) {
    for (const json* said : {&instance, &attributes}) {
        std::string word = textIn(*said, "semantic_category");
        if (!saysNothing(word)) return word;
    }
    std::optional<double> id = numberAt(instance, "semantic_id");
    if (!id) id = numberAt(attributes, "semantic_id");
    if (id && std::abs(*id) < kMostSemanticId) {
        const auto number = static_cast<std::int64_t>(*id);
        const auto known = by_id_.find(number);
        if (known != by_id_.end() && !saysNothing(known->second)) return known->second;
        // 0 is the default of objects without a semantic_id.
        const bool is_unknown = known == by_id_.end() && number != 0;
        if (is_unknown && !by_model_.contains(model)) ++unknown_ids_[number];
    }
    auto found = by_model_.find(model);
    // Parts of a split model are named MODEL_part_1.
    if (found == by_model_.end()) found = by_model_.find(model.substr(0, model.find("_part_")));
    return found == by_model_.end() ? std::string() : found->second;
}

std::vector<std::string> SemanticClasses::warnings() const {
    std::vector<std::string> lines = problems_;
    if (unknown_ids_.empty()) return lines;
    std::size_t objects = 0;
    std::vector<std::string> ids;
    for (const auto& [id, count] : unknown_ids_) {
        objects += count;
        ids.push_back(std::to_string(id));
    }
    const std::string have = counted(objects, "object has", "objects have");
    if (!lexicon_.empty()) {
        lines.push_back(fmt::format("{} a semantic_id that {} does not list: {}", have,
                                    shownName(lexicon_), listOf(ids, 10)));
    } else if (!no_lexicon_.empty()) {
        lines.push_back(fmt::format("{} a semantic_id, but {}", have, no_lexicon_));
    } else if (problems_.empty()) {
        lines.push_back(
            fmt::format("{} a semantic_id, but no semantic lexicon has its class; list one in "
                        "semantic_scene_descriptor_instances of the dataset config",
                        have));
    }
    return lines;
}

}  // namespace dollytrack::habitat
