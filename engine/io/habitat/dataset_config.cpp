#include "engine/io/habitat/dataset_config.h"

#include "engine/core/name_pattern.h"
#include "engine/io/files/bounded_json.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <system_error>
#include <tuple>

namespace dollytrack::habitat {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::string_view kConfigEnding = ".scene_dataset_config.json";
constexpr std::size_t kMostPlaces = 20'000;  // folders and files that patterns may stand for

struct KindWords {
    Kind kind;
    const char* section;
    const char* ending;            // of a description; "" where models stand for themselves
    std::array<const char*, 4> usual;  // folders of datasets without a config
};

constexpr std::array<KindWords, 5> kWords = {
    {{Kind::Stage, "stages", ".stage_config.json", {"stages", "configs/stages", "", ""}},
     {Kind::Object, "objects", ".object_config.json", {"objects", "configs/objects", "", ""}},
     {Kind::ArticulatedObject, "articulated_objects", ".urdf", {"urdf", "configs/urdf", "", ""}},
     {Kind::SceneInstance,
      "scene_instances",
      ".scene_instance.json",
      {"scenes", "configs/scenes", "scene_instances", ""}},
     {Kind::SemanticScene,
      "semantic_scene_descriptor_instances",
      ".json",
      {"semantics", "ssd", "configs/ssd", ""}}}};

const KindWords& wordsOf(Kind kind) {
    return *std::find_if(kWords.begin(), kWords.end(),
                         [&](const KindWords& words) { return words.kind == kind; });
}

bool isModel(const std::string& name) {
    return name.ends_with(".glb") || name.ends_with(".gltf") || name.ends_with(".ply") ||
           name.ends_with(".obj");
}

bool isPattern(const std::string& text) {
    return text.find_first_of("*?") != std::string::npos;
}

/// The folders and files that a path with wildcards stands for.
std::vector<fs::path> expand(const io::ReachableFiles& files, const fs::path& folder,
                             const std::string& pattern) {
    std::vector<fs::path> level = {folder};
    for (const fs::path& step : fs::path(pattern)) {
        const std::string part = step.string();
        if (part.empty()) continue;
        std::vector<fs::path> next;
        for (const fs::path& at : level) {
            if (!isPattern(part)) {
                next.push_back((at / part).lexically_normal());
                continue;
            }
            for (const std::string& name : files.namesIn(at)) {
                const bool fits = part == "*" || part == "**" || fitsPattern(part, name);
                if (fits && next.size() < kMostPlaces) next.push_back(at / name);
            }
        }
        level = std::move(next);
    }
    return level;
}

/// A stem that several datasets write before the name: "objects/chair" of "chair".
std::string lastName(const std::string& name) {
    const auto slash = name.find_last_of('/');
    return slash == std::string::npos ? name : name.substr(slash + 1);
}

std::string withoutEnding(const std::string& name, std::string_view ending) {
    return name.ends_with(ending) ? name.substr(0, name.size() - ending.size()) : name;
}

json over(json below, const json& above) {
    if (!below.is_object()) below = json::object();
    if (above.is_object()) below.update(above);
    return below;
}

const json& sectionOf(const json& document, const char* key) {
    static const json nothing = json::object();
    const auto found = document.find(key);
    return found != document.end() && found->is_object() ? *found : nothing;
}

std::vector<fs::path> configsIn(const fs::path& folder) {
    std::vector<fs::path> configs;
    std::error_code error;
    std::size_t seen = 0;
    fs::directory_iterator at(folder, error);
    for (const fs::directory_iterator end; !error && at != end && ++seen < 10'000;
         at.increment(error)) {
        if (at->path().filename().string().ends_with(kConfigEnding)) configs.push_back(at->path());
    }
    std::sort(configs.begin(), configs.end());
    return configs;
}

}  // namespace

std::optional<fs::path> findDatasetConfig(const fs::path& scene_instance) {
    constexpr int kMostFoldersUp = 4;
    const fs::path own = io::absoluteNormal(scene_instance).parent_path();
    fs::path folder = own;
    for (int up = 0; up <= kMostFoldersUp && folder.has_relative_path(); ++up) {
        const std::vector<fs::path> configs = configsIn(folder);
        if (configs.size() == 1) return configs.front();
        for (const fs::path& config : configs) {
            const auto dataset = Dataset::open(config, folder, io::ReachableFiles({folder}));
            if (!dataset) continue;
            for (const DatasetScene& scene : dataset->scenes()) {
                if (scene.file.parent_path() == own) return config;
            }
        }
        if (!configs.empty()) return configs.front();
        folder = folder.parent_path();
    }
    return std::nullopt;
}

Result<Dataset> Dataset::open(const fs::path& config, const fs::path& folder,
                              io::ReachableFiles files) {
    Dataset dataset(folder, std::move(files));
    json document = json::object();
    if (!config.empty()) {
        Result<json> read = io::readBoundedJson(config);
        if (!read) return tl::unexpected(read.error());
        if (!read->is_object()) {
            return fail(ErrorCode::BadInput, "a dataset config is a JSON object", config.string());
        }
        document = std::move(*read);
    }
    for (const KindWords& words : kWords) {
        json section = sectionOf(document, words.section);
        if (config.empty()) {
            for (const char* usual : words.usual) {
                if (*usual != '\0') section["paths"][".json"].push_back(usual);
            }
        }
        dataset.readPlaces(section, words.kind);
    }
    dataset.lexicons_ = sectionOf(document, "semantic_scene_descriptor_instances");
    return dataset;
}

void Dataset::readPlaces(const json& section, Kind kind) {
    Places& places = places_[kind];
    places.defaults = sectionOf(section, "default_attributes");
    places.configs = io::listIn(section, "configs");
    for (const auto& [ending, list] : sectionOf(section, "paths").items()) {
        if (!list.is_array()) continue;
        for (const json& entry : list) {
            if (!entry.is_string()) continue;
            const auto& pattern = entry.get_ref<const std::string&>();
            // Files that the last part fits lie in the folder before it.
            if (isPattern(lastName(pattern))) {
                const std::string before = fs::path(pattern).parent_path().string();
                for (fs::path& folder : expand(files_, folder_, before)) {
                    places.folders.push_back(std::move(folder));
                }
            }
            for (fs::path& found : expand(files_, folder_, pattern)) {
                if (places.folders.size() + places.files.size() > kMostPlaces) break;
                // Files are known by their ending: this may run where nothing can be asked.
                const std::string name = found.filename().string();
                const bool file = name.ends_with(".json") || name.ends_with(".urdf") ||
                                  isModel(name);
                (file ? places.files : places.folders).push_back(std::move(found));
            }
        }
    }
}

Result<Template> Dataset::load(const fs::path& file, const Places& places) const {
    Template found{places.defaults, file.parent_path(), file};
    if (file.extension() != ".json") {
        found.attributes["render_asset"] = file.filename().string();
        return found;
    }
    Result<json> read = io::readBoundedJson(file);
    if (!read) return tl::unexpected(read.error());
    found.attributes = over(std::move(found.attributes), *read);
    return found;
}

Result<std::optional<Template>> Dataset::find(Kind kind, const std::string& name) const {
    const KindWords& words = wordsOf(kind);
    const Places& places = places_.at(kind);
    const auto wrapped = [](Result<Template> loaded) -> Result<std::optional<Template>> {
        if (!loaded) return tl::unexpected(loaded.error());
        return std::optional<Template>(std::move(*loaded));
    };
    const std::string stem = withoutEnding(lastName(name), words.ending);
    for (const json& config : places.configs) {
        const std::string handle = io::textIn(config, "template_handle");
        const std::string original = io::textIn(config, "original_file");
        const bool fits = !handle.empty() ? handle == name || handle == stem
                                          : withoutEnding(lastName(original), words.ending) == stem;
        if (!fits) continue;
        Template found{places.defaults, folder_, {}};
        if (!original.empty()) {
            const auto file = files_.find(folder_, original);
            if (!file) continue;
            Result<Template> loaded = load(*file, places);
            if (!loaded) return tl::unexpected(loaded.error());
            found = std::move(*loaded);
        }
        const json& changes = sectionOf(config, "attributes");
        // Names of files that the config itself gives count from the config.
        if (changes.contains("render_asset")) found.folder = folder_;
        found.attributes = over(std::move(found.attributes), changes);
        return std::optional<Template>(std::move(found));
    }
    const std::array<std::string, 4> endings = {words.ending, ".glb", ".gltf", ".ply"};
    for (const fs::path& file : places.files) {
        for (const std::string& ending : endings) {
            if (file.filename().string() != stem + ending) continue;
            if (const auto there = files_.find(folder_, file.string())) {
                return wrapped(load(*there, places));
            }
        }
    }
    for (const std::string& ending : endings) {
        for (const fs::path& folder : places.folders) {
            if (const auto file = files_.find(folder, stem + ending)) {
                return wrapped(load(*file, places));
            }
        }
        // A path: as it is written, from the dataset's folder.
        const std::string path = name.ends_with(ending) ? name : name + ending;
        if (const auto file = files_.find(folder_, path)) return wrapped(load(*file, places));
    }
    if (const auto file = findPart(places, words.ending, stem)) return wrapped(load(*file, places));
    return std::optional<Template>();
}

/// Habitat takes a part of a name, too: "chair" for "chair_0", the first in the order of names.
std::optional<fs::path> Dataset::findPart(const Places& places, std::string_view ending,
                                          const std::string& part) const {
    if (part.empty()) return std::nullopt;
    const auto fits = [&](const std::string& name) {
        return name.ends_with(ending) && name.find(part) != std::string::npos;
    };
    for (const fs::path& file : places.files) {
        if (!fits(file.filename().string())) continue;
        if (auto there = files_.find(folder_, file.string())) return there;
    }
    for (const fs::path& folder : places.folders) {
        for (const std::string& name : files_.namesIn(folder)) {
            if (!fits(name)) continue;
            if (auto there = files_.find(folder, name)) return there;
        }
    }
    return std::nullopt;
}

std::vector<DatasetScene> Dataset::scenes() const {
    std::vector<DatasetScene> scenes;
    const auto gather = [&](Kind kind, bool models) {
        const KindWords& words = wordsOf(kind);
        const Places& places = places_.at(kind);
        std::vector<fs::path> found = places.files;
        for (const fs::path& folder : places.folders) {
            for (const std::string& name : files_.namesIn(folder)) {
                if (name.ends_with(words.ending)) found.push_back(folder / name);
            }
        }
        for (const fs::path& file : found) {
            const std::string name = file.filename().string();
            const bool described = name.ends_with(words.ending);
            if (!described && !(models && isModel(name))) continue;
            scenes.push_back({described ? withoutEnding(name, words.ending) : file.stem().string(),
                              file});
        }
    };
    gather(Kind::SceneInstance, false);
    // A dataset without scene instances (HM3D, Gibson) has a scene for each stage.
    if (scenes.empty()) gather(Kind::Stage, true);
    std::sort(scenes.begin(), scenes.end(), [](const DatasetScene& a, const DatasetScene& b) {
        return std::tie(a.name, a.file) < std::tie(b.name, b.file);
    });
    scenes.erase(std::unique(scenes.begin(), scenes.end(),
                             [](const DatasetScene& a, const DatasetScene& b) {
                                 return a.file == b.file;
                             }),
                 scenes.end());
    return scenes;
}

std::optional<fs::path> Dataset::findLexicon(const std::string& name) const {
    const std::string written = io::textIn(lexicons_, name.c_str());
    if (!written.empty()) {
        if (auto file = files_.find(folder_, written)) return file;
    }
    const Places& places = places_.at(Kind::SemanticScene);
    const std::string stem = withoutEnding(lastName(name), ".json");
    for (const fs::path& file : places.files) {
        if (withoutEnding(file.filename().string(), ".json") == stem) {
            return files_.find(folder_, file.string());
        }
    }
    for (const fs::path& folder : places.folders) {
        if (auto file = files_.find(folder, stem + ".json")) return file;
    }
    return files_.find(folder_, name);
}

}  // namespace dollytrack::habitat
