#include "engine/io/habitat/dataset_config.h"

#include "engine/core/clean_text.h"
#include "engine/core/field_list.h"
#include "engine/core/name_pattern.h"
#include "engine/core/natural_order.h"
#include "engine/core/text_lists.h"
#include "engine/io/files/bounded_json.h"
#include "engine/io/files/input_file.h"
#include "engine/io/habitat/folder_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>
#include <system_error>
#include <utility>

namespace dollytrack::habitat {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kSemanticDescriptor = "semantic_descriptor_filename";
constexpr std::uint64_t kMostTemplateBytes = std::uint64_t{64} << 20U;
constexpr std::size_t kMostFitting = 10;          // matching files collected per name
constexpr std::size_t kMostSlowSearches = 2'000;  // for names missing in the file name index

struct KindWords {
    Kind kind;
    const char* section;
    const char* ending;                // file name ending of a description
    bool models;                       // whether models without a description are allowed
    std::array<const char*, 4> usual;  // folders in datasets without a config
};

constexpr std::array<KindWords, 5> kWords = {
    {{Kind::Stage, "stages", ".stage_config.json", true, {"stages", "configs/stages", "", ""}},
     {Kind::Object, "objects", ".object_config.json", true, {"objects", "configs/objects", "", ""}},
     {Kind::ArticulatedObject,
      "articulated_objects",
      ".urdf",
      false,
      {"urdf", "configs/urdf", "", ""}},
     {Kind::SceneInstance,
      "scene_instances",
      ".scene_instance.json",
      false,
      {"scenes", "configs/scenes", "scene_instances", ""}},
     {Kind::SemanticScene,
      "semantic_scene_descriptor_instances",
      ".json",
      false,
      {"semantics", "ssd", "configs/ssd", ""}}}};

const KindWords& wordsOf(Kind kind) {
    return *std::find_if(kWords.begin(), kWords.end(),
                         [&](const KindWords& words) { return words.kind == kind; });
}

bool isModel(const std::string& name) {
    return name.ends_with(".glb") || name.ends_with(".gltf") || name.ends_with(".ply") ||
           name.ends_with(".obj");
}

bool isOfKind(const std::string& name, const KindWords& words) {
    // HSSD has a lexicon, and a table of its models as CSV.
    if (words.kind == Kind::SemanticScene && name.ends_with(".csv")) return true;
    return name.ends_with(words.ending) || (words.models && isModel(name));
}

/// The name without folders: "chair" for "objects/chair".
std::string lastName(const std::string& name) {
    const auto slash = name.find_last_of('/');
    return slash == std::string::npos ? name : name.substr(slash + 1);
}

/// `defaults`, with values replaced and added by `changes`.
json merged(json defaults, const json& changes) {
    if (!defaults.is_object()) defaults = json::object();
    if (changes.is_object()) defaults.update(changes);
    return defaults;
}

Result<json> readConfig(const fs::path& path, std::uint64_t most_bytes) {
    const Result<std::string> text = readNamedFile(path, most_bytes);
    if (!text) return tl::unexpected(text.error());
    return parseBoundedJson(*text, path.string());
}

const json& sectionOf(const json& document, const char* key) {
    static const json nothing = json::object();
    const auto found = document.find(key);
    return found != document.end() && found->is_object() ? *found : nothing;
}

/// The index of each template of a config's list, by its handle or else its file name.
std::map<std::string, std::size_t> indexByName(const json::array_t& configs,
                                               const std::string& ending) {
    std::map<std::string, std::size_t> index;
    for (std::size_t i = 0; i < configs.size(); ++i) {
        std::string name = textIn(configs[i], "template_handle");
        if (name.empty()) {
            name = lastName(textIn(configs[i], "original_file"));
            name = withoutEnding(name, ending).value_or(name);
        }
        index.try_emplace(std::move(name), i);
    }
    return index;
}

}  // namespace

Result<Dataset> Dataset::open(const fs::path& config, const fs::path& folder, ReachableFiles files,
                              const JobContext& job, const DatasetScope& scope) {
    Dataset dataset(folder, std::move(files));
    json document = json::object();
    if (!config.empty()) {
        Result<json> read = readConfig(config, scope.most_config_bytes);
        if (!read) return tl::unexpected(read.error());
        if (!read->is_object()) {
            return fail(
                ErrorCode::BadInput,
                "the dataset config is not a JSON object; it is damaged or not a Habitat file",
                config.string());
        }
        document = std::move(*read);
        dataset.config_name_ = config.filename().string();
        dataset.keys_.check(document, KeyCheck::Place::DatasetConfig, dataset.config_name_);
    }
    FolderSearch search(dataset.files_, folder, config.empty() ? folder.string() : config.string(),
                        job, scope.most_names);
    for (const KindWords& words : kWords) {
        const bool has_scenes = words.kind == Kind::Stage || words.kind == Kind::SceneInstance;
        if (scope.scenes_only && !has_scenes) continue;
        json section = sectionOf(document, words.section);
        if (config.empty()) {
            for (const char* usual : words.usual) {
                if (*usual != '\0') section["paths"][".json"].push_back(usual);
            }
        }
        if (Status read = dataset.readSection(section, words.kind, search); !read) {
            return tl::unexpected(read.error());
        }
    }
    dataset.lexicons_ = sectionOf(document, "semantic_scene_descriptor_instances");
    return dataset;
}

Status Dataset::readSection(const json& values, Kind kind, FolderSearch& search) {
    constexpr std::size_t kLongestPattern = 4096;
    const KindWords& words = wordsOf(kind);
    Section& section = sections_[kind];
    section.defaults = sectionOf(values, "default_attributes");
    section.configs = listIn(values, "configs");
    checkKeys(section.defaults, kind, config_name_);
    // In the section of semantic files, all other keys are handles.
    if (kind != Kind::SemanticScene) {
        keys_.check(values, KeyCheck::Place::Section, config_name_);
    }
    section.config_of = indexByName(section.configs, words.ending);
    const auto add = [&](const fs::path& file, const std::string& ending) {
        const std::string name = file.filename().string();
        section.files.push_back(file);
        if (isModel(name) && name.ends_with(ending)) section.named_models.push_back(file);
    };
    struct Asked {
        fs::path folder;
        std::string ending;  // requested file extension
        std::size_t pattern;
    };
    std::vector<Asked> folders;
    std::vector<std::pair<std::string, bool>> patterns;  // with whether they lead to a file
    for (const auto& [ending, list] : sectionOf(values, "paths").items()) {
        if (!list.is_array()) continue;
        for (const json& entry : list) {
            if (!entry.is_string()) continue;
            const auto& pattern = entry.get_ref<const std::string&>();
            if (pattern.size() > kLongestPattern) continue;
            if (patterns.size() >= FolderSearch::kMostPatterns) {
                return search.tooManyPatterns(words.section);
            }
            patterns.emplace_back(pattern, false);
            auto found = search.expand(pattern);
            if (!found) return tl::unexpected(found.error());
            for (const fs::path& path : *found) {
                if (isOfKind(path.filename().string(), words)) {
                    add(path, ending);
                    bool& useful = patterns.back().second;
                    useful = useful || files_.find(folder_, path.string()).has_value();
                } else {
                    folders.push_back({path, ending, patterns.size() - 1});
                }
            }
            // Template names may also refer to files in the same folder that do not match the
            // pattern's last part.
            if (FolderSearch::isPattern(lastName(pattern))) {
                found = search.expand(fs::path(pattern).parent_path().string());
                if (!found) return tl::unexpected(found.error());
                for (const fs::path& path : *found) {
                    folders.push_back({path, ".json", patterns.size() - 1});
                }
            }
            if (folders.size() + section.files.size() > FolderSearch::kMostFiles)
                return search.tooMany("files");
        }
    }
    for (const auto& [folder, ending, pattern] : folders) {
        const auto names = search.list(folder);
        if (!names) return tl::unexpected(names.error());
        for (const std::string& name : **names) {
            if (!isOfKind(name, words)) continue;
            add(folder / name, ending);
            patterns[pattern].second = true;
        }
        if (section.files.size() > FolderSearch::kMostFiles) return search.tooMany("files");
    }
    for (std::size_t i = 0; i < section.files.size(); ++i) {
        const std::string name = section.files[i].filename().string();
        const auto [at, is_new] = section.file_of.try_emplace(name, i);
        if (!is_new && section.files[at->second] != section.files[i]) section.doubled.insert(name);
    }
    section.patterns = patterns.size();
    for (auto& [pattern, useful] : patterns) {
        if (!useful) section.useless_patterns.push_back(std::move(pattern));
    }
    return {};
}

Result<std::shared_ptr<const Template>> Dataset::load(Kind kind, const fs::path& file) const {
    const auto known = by_file_.find({kind, file});
    if (known != by_file_.end()) return known->second;
    auto found =
        std::make_shared<Template>(Template{sections_.at(kind).defaults, file.parent_path(), file});
    if (file.extension() == ".json") {
        const Result<json> read = readConfig(file, kMostTemplateBytes);
        if (!read) return tl::unexpected(read.error());
        if (!read->is_object()) {
            return fail(ErrorCode::BadInput,
                        "the file is not a JSON object; it is damaged or not a Habitat file",
                        file.string());
        }
        checkKeys(*read, kind, file.filename().string());
        found->attributes = merged(std::move(found->attributes), *read);
    } else {
        found->attributes["render_asset"] = file.filename().string();
    }
    return by_file_[{kind, file}] = std::move(found);
}

/// The template with this handle in the config's list; null if there is none or its file is
/// missing.
Result<std::shared_ptr<const Template>> Dataset::findConfigured(const Section& section, Kind kind,
                                                                const std::string& handle) const {
    const auto at = section.config_of.find(handle);
    if (at == section.config_of.end()) return std::shared_ptr<const Template>();
    const auto [known, is_new] = by_handle_.try_emplace({kind, handle});
    if (!is_new) return known->second;
    const json& config = section.configs[at->second];
    const std::string original = textIn(config, "original_file");
    Template found{section.defaults, folder_, {}};
    if (!original.empty()) {
        const auto file = files_.find(folder_, original);
        if (!file) return known->second;
        const auto loaded = load(kind, *file);
        if (!loaded) return tl::unexpected(loaded.error());
        found = **loaded;
    }
    const json& changes = sectionOf(config, "attributes");
    checkKeys(changes, kind, config_name_);
    // File names in the config itself are relative to the config.
    if (changes.contains("render_asset")) found.folder = folder_;
    found.attributes = merged(std::move(found.attributes), changes);
    return known->second = std::make_shared<const Template>(std::move(found));
}

Result<std::shared_ptr<const Template>> Dataset::find(Kind kind, const std::string& name) const {
    const Section& section = sections_.at(kind);
    const std::string last = lastName(name);
    for (const std::string& handle :
         {name, withoutEnding(last, wordsOf(kind).ending).value_or(last)}) {
        auto configured = findConfigured(section, kind, handle);
        if (!configured || *configured) return configured;
    }
    const auto file = findFile(kind, name);
    if (!file) return std::shared_ptr<const Template>();
    return load(kind, *file);
}

std::string Dataset::closestTemplate(Kind kind, const std::string& name) const {
    const KindWords& words = wordsOf(kind);
    const Section& section = sections_.at(kind);
    std::vector<std::string> names;
    for (const auto& [file_name, index] : section.file_of) {
        names.push_back(withoutEnding(file_name, words.ending)
                            .value_or(std::filesystem::path(file_name).stem().string()));
    }
    for (const auto& [handle, index] : section.config_of) names.push_back(handle);
    return closestName(lastName(name), names);
}

bool Dataset::searchesWereCut() const {
    return slow_searches_ > kMostSlowSearches;
}

std::optional<fs::path> Dataset::findFile(Kind kind, const std::string& name) const {
    const KindWords& words = wordsOf(kind);
    const Section& section = sections_.at(kind);
    std::vector<std::string> endings = {words.ending};
    if (words.models) endings.insert(endings.end(), {".glb", ".gltf", ".ply", ".obj"});
    std::string stem = lastName(name);
    for (const std::string& ending : endings) {
        if (auto before = withoutEnding(stem, ending)) {
            stem = std::move(*before);
            break;
        }
    }
    if (stem.empty()) return std::nullopt;
    for (const std::string& ending : endings) {
        const auto at = section.file_of.find(stem + ending);
        if (at == section.file_of.end()) continue;
        noteSeveral(name, section, stem + ending);
        if (auto file = files_.find(folder_, section.files[at->second].string())) return file;
    }
    if (++slow_searches_ > kMostSlowSearches) return std::nullopt;
    // A path relative to the dataset's folder.
    for (const std::string& ending : endings) {
        const std::string path = name.ends_with(ending) ? name : name + ending;
        if (auto file = files_.find(folder_, path)) return file;
    }
    // Habitat also accepts a part of a file name ("chair" for "chair_0"): the first match by name.
    std::optional<fs::path> first;
    std::vector<std::string> fitting;
    for (const auto& [file_name, index] : section.file_of) {
        if (!file_name.ends_with(words.ending) || file_name.find(stem) == std::string::npos) {
            continue;
        }
        auto file = files_.find(folder_, section.files[index].string());
        if (!file) continue;
        if (!first) first = std::move(file);
        fitting.push_back(file_name);
        if (fitting.size() > kMostFitting) break;
    }
    if (fitting.size() > 1) several_.try_emplace(name, std::move(fitting));
    return first;
}

/// Records a name as ambiguous if files of this name are in several folders.
void Dataset::noteSeveral(const std::string& name, const Section& section,
                          const std::string& file_name) const {
    if (!section.doubled.contains(file_name) || several_.contains(name)) return;
    std::vector<std::string>& fitting = several_[name];
    for (const fs::path& file : section.files) {
        if (file.filename() != file_name) continue;
        const std::string shown = file.lexically_relative(folder_).string();
        if (std::ranges::find(fitting, shown) == fitting.end()) fitting.push_back(shown);
        if (fitting.size() > kMostFitting) return;
    }
}

void Dataset::checkKeys(const json& attributes, Kind kind, const std::string& file) const {
    if (kind == Kind::SemanticScene) return;
    const bool scene = kind == Kind::SceneInstance;
    keys_.check(attributes, scene ? KeyCheck::Place::SceneInstance : KeyCheck::Place::Description,
                file);
}

std::string Dataset::uselessPaths(Kind kind) const {
    const auto at = sections_.find(kind);
    if (config_name_.empty() || at == sections_.end()) return {};
    const Section& section = at->second;
    if (section.patterns == 0 || section.useless_patterns.size() < section.patterns) return {};
    return fmt::format("the paths of {} in {} match no file ({}); correct them",
                       wordsOf(kind).section, cleanText(config_name_),
                       cleanText(listOf(section.useless_patterns, 5)));
}

std::vector<std::string> Dataset::warnings(bool something_missing) const {
    constexpr std::size_t kMostNames = 20;
    std::vector<std::string> lines;
    for (const auto& [kind, section] : sections_) {
        if (kind == Kind::SemanticScene || config_name_.empty()) continue;
        const bool matters = something_missing || kind == Kind::SceneInstance;
        std::string line = matters ? uselessPaths(kind) : std::string();
        if (line.empty() && something_missing && !section.useless_patterns.empty()) {
            line = fmt::format("some paths of {} in {} match no file: {}", wordsOf(kind).section,
                               cleanText(config_name_),
                               cleanText(listOf(section.useless_patterns, 5)));
        }
        if (!line.empty()) lines.push_back(std::move(line));
    }
    std::size_t names = 0;
    for (const auto& [name, files] : several_) {
        if (++names > kMostNames) break;
        lines.push_back(
            cleanText(fmt::format("the template name \"{}\" matches several files ({}), and the "
                                  "first is used; name one of them",
                                  name, listOf(files, 3))));
    }
    if (several_.size() > kMostNames) {
        lines.push_back(fmt::format("{} more template names match several files",
                                    several_.size() - kMostNames));
    }
    const std::vector<std::string> slips = keys_.warnings();
    lines.insert(lines.end(), slips.begin(), slips.end());
    return lines;
}

std::vector<DatasetScene> Dataset::scenes() const {
    std::vector<DatasetScene> scenes;
    const auto gather = [&](Kind kind) {
        const std::string ending = wordsOf(kind).ending;
        for (const fs::path& file : sections_.at(kind).files) {
            const std::string name = file.filename().string();
            if (auto scene = withoutEnding(name, ending)) scenes.push_back({*scene, file});
        }
        for (const fs::path& file : sections_.at(kind).named_models) {
            scenes.push_back({file.stem().string(), file});
        }
    };
    gather(Kind::SceneInstance);
    // In a dataset without scene instances (HM3D, Gibson) each stage is a scene.
    if (scenes.empty()) gather(Kind::Stage);
    std::sort(scenes.begin(), scenes.end(), [](const DatasetScene& a, const DatasetScene& b) {
        return a.name == b.name ? a.file < b.file : comesBefore(a.name, b.name);
    });
    scenes.erase(
        std::unique(scenes.begin(), scenes.end(),
                    [](const DatasetScene& a, const DatasetScene& b) { return a.file == b.file; }),
        scenes.end());
    std::erase_if(scenes, [&](const DatasetScene& scene) {
        return !files_.find(folder_, scene.file.string());
    });
    return scenes;
}

std::string Dataset::semanticPathOf(const std::string& handle) const {
    const Section& section = sections_.at(Kind::SemanticScene);
    const auto at = section.config_of.find(handle);
    if (at == section.config_of.end()) return textIn(lexicons_, handle.c_str());
    const json& config = section.configs[at->second];
    std::string written = textIn(config, "original_file");
    if (!written.empty()) return written;
    return textIn(sectionOf(config, "attributes"), kSemanticDescriptor);
}

std::optional<fs::path> Dataset::findSemanticFile(const std::string& name) const {
    const Section& section = sections_.at(Kind::SemanticScene);
    const std::string written = semanticPathOf(name);
    if (!written.empty()) {
        if (auto file = files_.find(folder_, written)) return file;
    }
    constexpr std::array<const char*, 3> kEndings = {"", ".json", ".semantic_config.json"};
    for (const char* ending : kEndings) {
        const auto at = section.file_of.find(lastName(name) + ending);
        if (at == section.file_of.end()) continue;
        if (auto file = files_.find(folder_, section.files[at->second].string())) return file;
    }
    for (const char* ending : kEndings) {
        if (auto file = files_.find(folder_, name + ending)) return file;
    }
    return std::nullopt;
}

std::vector<fs::path> Dataset::semanticFiles() const {
    std::set<fs::path> files;
    for (const auto& [handle, written] : lexicons_.items()) {
        if (!written.is_string()) continue;
        if (const auto file = files_.find(folder_, written.get<std::string>())) files.insert(*file);
    }
    for (const fs::path& file : sections_.at(Kind::SemanticScene).files) {
        if (files_.find(folder_, file.string())) files.insert(file);
    }
    return {files.begin(), files.end()};
}

const json& Dataset::semanticDefaults() const {
    return sections_.at(Kind::SemanticScene).defaults;
}

std::optional<fs::path> Dataset::defaultLexicon() const {
    const std::string named = textIn(semanticDefaults(), kSemanticDescriptor);
    if (named.empty()) return std::nullopt;
    std::set<fs::path> folders;
    for (const fs::path& file : semanticFiles()) folders.insert(file.parent_path());
    for (const char* usual : {"semantics/scenes", "semantics", "ssd", "configs/ssd"}) {
        folders.insert(folder_ / usual);
    }
    folders.insert(folder_);
    for (const fs::path& folder : folders) {
        if (auto file = files_.find(folder, named)) return file;
    }
    return std::nullopt;
}

}  // namespace dollytrack::habitat
