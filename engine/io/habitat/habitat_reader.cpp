#include "engine/io/habitat/habitat_reader.h"

#include "engine/core/clean_text.h"
#include "engine/io/datasets/model_library.h"
#include "engine/io/datasets/object_names.h"
#include "engine/io/files/bounded_json.h"
#include "engine/io/gazebo/urdf_reader.h"
#include "engine/io/habitat/dataset_config.h"
#include "engine/io/import/import_labels.h"
#include "engine/io/import/model_placement.h"
#include "engine/io/import/model_reader.h"
#include "engine/io/object_parts/object_grouping.h"
#include "engine/io/semantics/labelled_reader.h"
#include "engine/scene/labels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <memory>
#include <optional>

namespace dollytrack::habitat {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::string_view kDatasetEnding = ".scene_dataset_config.json";
constexpr std::size_t kMostInstances = 100'000;

/// Three numbers; nothing where there is a value that is not three numbers.
std::optional<Eigen::Vector3d> vectorIn(const json& object, const char* key,
                                        const Eigen::Vector3d& usual) {
    const auto found = object.find(key);
    if (found == object.end() || found->is_null()) return usual;
    if (found->is_number()) return Eigen::Vector3d::Constant(found->get<double>());
    if (!found->is_array() || found->size() != 3) return std::nullopt;
    Eigen::Vector3d value;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::optional<double> number = io::numberIn((*found)[i]);
        if (!number) return std::nullopt;
        value[static_cast<Eigen::Index>(i)] = *number;
    }
    return value;
}

/// A rotation of four numbers, w first. Nothing where it is none.
std::optional<Eigen::Quaterniond> rotationIn(const json& object, const char* key) {
    const json::array_t& list = io::listIn(object, key);
    if (list.empty()) return Eigen::Quaterniond::Identity();
    if (list.size() != 4) return std::nullopt;
    Eigen::Vector4d q;
    for (std::size_t i = 0; i < 4; ++i) {
        const std::optional<double> number = io::numberIn(list[i]);
        if (!number) return std::nullopt;
        q[static_cast<Eigen::Index>(i)] = *number;
    }
    if (!(q.norm() > 1e-6)) return std::nullopt;
    q.normalize();
    return Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
}

std::optional<double> numberAt(const json& object, const char* key) {
    const auto found = object.find(key);
    return found == object.end() ? std::nullopt : io::numberIn(*found);
}

bool isOff(const json& object, const char* key) {
    const auto found = object.find(key);
    return found != object.end() && found->is_boolean() && !found->get<bool>();
}

std::string inSmall(std::string text) {
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

/// Turns the asset's upward and forward axes to Habitat's: y up, looking along -z.
Eigen::Matrix3d frameOf(const json& attributes) {
    const Eigen::Vector3d usual_up = Eigen::Vector3d::UnitY();
    const Eigen::Vector3d usual_front = -Eigen::Vector3d::UnitZ();
    const Eigen::Vector3d up = vectorIn(attributes, "up", usual_up).value_or(usual_up);
    const Eigen::Vector3d front = vectorIn(attributes, "front", usual_front).value_or(usual_front);
    const Eigen::Vector3d right = front.cross(up);
    if (!(right.norm() > 1e-6 * front.norm() * up.norm())) return Eigen::Matrix3d::Identity();
    // Columns: right, up and front, made square.
    Eigen::Matrix3d asset;
    asset << right.normalized(), up.normalized(), up.normalized().cross(right.normalized());
    Eigen::Matrix3d world;
    world << Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), -Eigen::Vector3d::UnitZ();
    return world * asset.transpose();
}

Eigen::Affine3d scaling(const Eigen::Vector3d& scale) {
    Eigen::Affine3d transform = Eigen::Affine3d::Identity();
    transform.linear() = scale.asDiagonal();
    return transform;
}

/// What a description says of the size and axes of its model.
Eigen::Affine3d modelFromAsset(const json& attributes) {
    const Eigen::Vector3d scale =
        vectorIn(attributes, "scale", Eigen::Vector3d::Ones()).value_or(Eigen::Vector3d::Ones());
    double unit = numberAt(attributes, "units_to_meters").value_or(1.0);
    if (!(unit > 0.0)) unit = 1.0;
    Eigen::Affine3d transform = scaling(unit * scale);
    transform.linear() = transform.linear() * frameOf(attributes);
    return transform;
}

/// The file that a description names as its model; its name may stand for the description's.
std::optional<fs::path> assetOf(const Template& found, const char* key,
                                const io::ReachableFiles& files) {
    constexpr std::string_view kOwnName = "%%CONFIG_NAME_AS_ASSET_FILENAME%%";
    std::string name;
    if (const auto at = found.attributes.find(key);
        at != found.attributes.end() && at->is_string()) {
        name = at->get<std::string>();
    }
    if (const auto at = name.find(kOwnName); at != std::string::npos) {
        const std::string own = found.file.filename().string();
        name.replace(at, kOwnName.size(), own.substr(0, own.find('.')));
    }
    return files.find(found.folder, name);
}

/// Names that say nothing: HSSD's models are called by 40 hexadecimal digits.
bool isNumberName(const std::string& name) {
    constexpr std::size_t kShortest = 16;
    return name.size() >= kShortest && std::all_of(name.begin(), name.end(), [](char c) {
        return std::isxdigit(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-';
    });
}

std::string shortName(const std::string& template_name) {
    std::string name = template_name.substr(template_name.rfind('/') + 1);
    return cleanText(name.substr(0, name.find('.')));
}

/// {"classes": [{"id": 5, "name": "chair"}]}.
std::map<std::int64_t, std::string> readLexicon(const json& document) {
    std::map<std::int64_t, std::string> names;
    for (const json& entry : io::listIn(document, "classes")) {
        if (!entry.is_object()) continue;
        const std::optional<double> id = numberAt(entry, "id");
        if (id && std::abs(*id) < 1e9) {
            names[static_cast<std::int64_t>(*id)] = io::textIn(entry, "name");
        }
    }
    return names;
}

Eigen::AlignedBox3d boxOf(const RawScene& model, const Eigen::Affine3d& moved) {
    Eigen::AlignedBox3d box;
    for (const MeshPart& part : model.parts) {
        for (const Eigen::Vector3f& p : part.positions) box.extend(moved * p.cast<double>());
    }
    return box;
}

class SceneReader {
  public:
    SceneReader(const fs::path& path, const Dataset& dataset, const LabelTable& labels,
                const JobContext& job)
        : path_(path), dataset_(dataset), labels_(labels), job_(job) {
        scene_.file_unit_m = 1.0;
        scene_.file_up_axis = 'y';
        scene_.nodes.push_back({"", -1, 0});
    }

    Result<RawScene> readInstance(const json& instance) {
        com_by_default_ = !isLocal(io::textIn(instance, "translation_origin"));
        if (Status read = readLexiconOf(instance); !read) return tl::unexpected(read.error());
        const auto stage = instance.find("stage_instance");
        if (stage != instance.end() && stage->is_object()) {
            const std::string name = io::textIn(*stage, "template_name");
            auto found = dataset_.find(Kind::Stage, name);
            if (!found) return tl::unexpected(found.error());
            if (!*found) {
                missing_.push_back("stage " + name);
            } else if (Status added = addStage(**found, *stage); !added) {
                return tl::unexpected(added.error());
            }
        }
        const json::array_t& objects = io::listIn(instance, "object_instances");
        const json::array_t& articulated = io::listIn(instance, "articulated_object_instances");
        if (objects.size() + articulated.size() > kMostInstances) {
            return fail(ErrorCode::BadInput, "the scene has more than 100,000 objects",
                        path_.string());
        }
        if (Status added = addObjects(objects); !added) return tl::unexpected(added.error());
        for (const json& one : articulated) {
            if (Status added = addArticulated(one); !added) return tl::unexpected(added.error());
        }
        return finish(!objects.empty() || !articulated.empty());
    }

    /// A stage or an object alone.
    Result<RawScene> readPart(const json& attributes) {
        const Template alone{attributes, path_.parent_path(), path_};
        if (Status added = addStage(alone, json::object()); !added) {
            return tl::unexpected(added.error());
        }
        return finish(false);
    }

  private:
    static bool isLocal(const std::string& origin) {
        const std::string small = inSmall(origin);
        return small == "asset_local" || small == "as_local";
    }

    Status readLexiconOf(const json& instance) {
        const std::string name = io::textIn(instance, "semantic_scene_instance");
        if (name.empty()) return {};
        const auto file = dataset_.findLexicon(name);
        if (!file) {
            scene_.notes.push_back("the semantic lexicon " + name +
                                   " is not there; classes are found by name");
            return {};
        }
        const Result<json> document = io::readBoundedJson(*file);
        if (!document) return tl::unexpected(document.error());
        lexicon_ = readLexicon(*document);
        return {};
    }

    Status addStage(const Template& found, const json& instance) {
        const auto asset = assetOf(found, "render_asset", dataset_.files());
        if (!asset) {
            missing_.push_back("the model of stage " + shortName(found.file.string()));
            return {};
        }
        std::optional<semantics::LabelledFiles> labelled = semantics::findLabelledFiles(*asset);
        if (const auto semantic = assetOf(found, "semantic_asset", dataset_.files());
            semantic && !labelled) {
            labelled = semantics::findLabelledFiles(*semantic);
        }
        Result<RawScene> read =
            labelled ? semantics::readLabelled(*labelled, job_) : readModel(*asset, job_);
        if (!read) return tl::unexpected(read.error());
        for (TextureRequest& texture : read->textures) texture.folder = asset->parent_path();
        const auto placement = instanceTransform(instance);
        if (!placement) {
            bad_.push_back("the stage");
            return {};
        }
        const Eigen::Vector3d origin =
            vectorIn(found.attributes, "origin", Eigen::Vector3d::Zero())
                .value_or(Eigen::Vector3d::Zero());
        const RawScene& model = *read;
        const Eigen::Affine3d scene_from_stage =
            Eigen::Translation3d(placement->translation) * placement->rotation *
            scaling(placement->scale) * modelFromAsset(found.attributes) *
            Eigen::Translation3d(-origin);
        placeWithNodes(model, scene_from_stage);
        scene_.notes.insert(scene_.notes.end(), model.notes.begin(), model.notes.end());
        return {};
    }

    /// The stage's own nodes and objects are kept: they tell its walls, doors and furniture apart.
    void placeWithNodes(const RawScene& model, const Eigen::Affine3d& moved) {
        ModelPlacement placement(model, scene_);
        const auto first_part = scene_.parts.size();
        placement.place("stage", moved);
        const int stage = static_cast<int>(scene_.nodes.size()) - 1;
        const int first_node = static_cast<int>(scene_.nodes.size());
        for (const SourceNode& node : model.nodes) {
            SourceNode copy = node;
            copy.parent = node.parent < 0 ? stage : node.parent + first_node;
            if (node.parent < 0) ++scene_.nodes[static_cast<std::size_t>(stage)].children;
            scene_.nodes.push_back(std::move(copy));
        }
        for (std::size_t i = 0; i < model.parts.size(); ++i) {
            scene_.parts[first_part + i].node = first_node + model.parts[i].node;
        }
        for (SourceObject object : model.objects) {
            for (std::size_t& part : object.parts) part += first_part;
            scene_.objects.push_back(std::move(object));
        }
        stage_labelled_ = !model.objects.empty();
    }

    struct Placement {
        Eigen::Vector3d translation;
        Eigen::Quaterniond rotation;
        Eigen::Vector3d scale;
    };

    static std::optional<Placement> instanceTransform(const json& instance) {
        const auto translation = vectorIn(instance, "translation", Eigen::Vector3d::Zero());
        const auto rotation = rotationIn(instance, "rotation");
        const auto scale = vectorIn(instance, "non_uniform_scale", Eigen::Vector3d::Ones());
        const double uniform = numberAt(instance, "uniform_scale").value_or(1.0);
        if (!translation || !rotation || !scale || !(std::abs(scale->prod() * uniform) > 1e-12)) {
            return std::nullopt;
        }
        return Placement{*translation, *rotation, uniform * *scale};
    }

    struct Wanted {
        const json* instance;
        Template found;
        std::size_t model;
        std::string name;
    };

    Status addObjects(const json::array_t& instances) {
        io::ModelLibrary library;
        std::vector<Wanted> wanted;
        std::map<std::string, std::optional<std::pair<Template, fs::path>>> known;
        for (const json& instance : instances) {
            if (!instance.is_object()) continue;
            if (isOff(instance, "is_instance_visible")) {
                ++hidden_;
                continue;
            }
            const std::string name = io::textIn(instance, "template_name");
            auto at = known.find(name);
            if (at == known.end()) {
                auto found = dataset_.find(Kind::Object, name);
                if (!found) return tl::unexpected(found.error());
                std::optional<std::pair<Template, fs::path>> model;
                if (*found) {
                    const auto asset = assetOf(**found, "render_asset", dataset_.files());
                    if (asset) model = std::pair(std::move(**found), *asset);
                }
                at = known.emplace(name, std::move(model)).first;
            }
            if (!at->second) {
                missing_.push_back(name);
                continue;
            }
            wanted.push_back({&instance, at->second->first, library.add(at->second->second), name});
        }
        if (Status read = library.read(job_); !read) return read;
        std::map<std::size_t, ModelPlacement> placements;
        for (const Wanted& one : wanted) {
            const RawScene* model = library.model(one.model);
            const auto placement = instanceTransform(*one.instance);
            if (model == nullptr || !placement) {
                (model == nullptr ? unreadable_ : bad_).push_back(one.name);
                continue;
            }
            if (Status fits = budget_.take(*model, path_.string()); !fits) return fits;
            auto at = placements.try_emplace(one.model, *model, scene_).first;
            SourceObject object = describe(one.name, one.found, *one.instance);
            object.parts = at->second.place(object.name, sceneFromObject(one, *model, *placement));
            scene_.objects.push_back(std::move(object));
        }
        return {};
    }

    /// Habitat places an object's centre of mass, unless the file says that it is the origin of
    /// the model. The centre is the one given, else the middle of the model's box.
    [[nodiscard]] Eigen::Affine3d sceneFromObject(const Wanted& one, const RawScene& model,
                                                  const Placement& placement) const {
        const Eigen::Affine3d scaled = scaling(placement.scale) *
                                       modelFromAsset(one.found.attributes);
        const std::string said = io::textIn(*one.instance, "translation_origin");
        const bool com = said.empty() ? com_by_default_ : !isLocal(said);
        Eigen::Vector3d center = Eigen::Vector3d::Zero();
        if (com) {
            const auto given = one.found.attributes.contains("COM")
                                   ? vectorIn(one.found.attributes, "COM", center)
                                   : std::nullopt;
            const Eigen::AlignedBox3d box = boxOf(model, scaled);
            if (given) {
                center = scaled * *given;
            } else if (!box.isEmpty()) {
                center = box.center();
            }
        }
        return Eigen::Translation3d(placement.translation) * placement.rotation *
               Eigen::Translation3d(-center) * scaled;
    }

    SourceObject describe(const std::string& template_name, const Template& found,
                          const json& instance) {
        SourceObject object;
        std::string name = shortName(template_name);
        std::optional<double> id = numberAt(instance, "semantic_id");
        if (!id) id = numberAt(found.attributes, "semantic_id");
        if (id && std::abs(*id) < 1e9) {
            const auto known = lexicon_.find(static_cast<std::int64_t>(*id));
            if (known != lexicon_.end()) object.category = known->second;
        }
        if (isNumberName(name)) name = object.category.empty() ? "object" : object.category;
        object.name = names_.next(name);
        return object;
    }

    Status addArticulated(const json& instance) {
        if (!instance.is_object()) return {};
        const std::string name = io::textIn(instance, "template_name");
        auto found = dataset_.find(Kind::ArticulatedObject, name);
        if (!found) return tl::unexpected(found.error());
        const auto placement = instanceTransform(instance);
        if (!*found || !placement) {
            (placement ? missing_ : bad_).push_back(name);
            return {};
        }
        auto at = articulated_.find((*found)->file);
        if (at == articulated_.end()) {
            Result<RawScene> read =
                gazebo::readUrdfModel((*found)->file, dataset_.files(), job_);
            if (!read && read.error().code == ErrorCode::Cancelled) {
                return tl::unexpected(read.error());
            }
            std::unique_ptr<RawScene> model;
            if (read) model = std::make_unique<RawScene>(std::move(*read));
            at = articulated_.emplace((*found)->file, std::move(model)).first;
        }
        if (!at->second) {
            unreadable_.push_back(name);
            return {};
        }
        if (Status fits = budget_.take(*at->second, path_.string()); !fits) return fits;
        SourceObject object = describe(name, **found, instance);
        ModelPlacement place(*at->second, scene_);
        object.parts = place.place(object.name, Eigen::Translation3d(placement->translation) *
                                                    placement->rotation *
                                                    scaling(placement->scale));
        scene_.objects.push_back(std::move(object));
        return {};
    }

    /// Nodes of the stage that are named after things are things; the rest is the building. Where
    /// there is nothing but a stage, its objects are found as in any other file.
    void addStageObjects() {
        if (stage_labelled_ || scene_.parts.empty()) return;
        std::vector<bool> taken(scene_.parts.size(), false);
        for (const SourceObject& object : scene_.objects) {
            for (const std::size_t part : object.parts) taken[part] = true;
        }
        for (const ObjectDraft& draft : groupByNodes(scene_, labels_, taken)) {
            SourceObject object;
            object.name = draft.name;
            object.structure = draft.label.kind != LabelKind::Target;
            object.nyu40 = draft.label.nyu40;
            if (object.structure && object.nyu40 == 0) object.nyu40 = kNyuOtherStructure;
            object.parts = draft.parts;
            scene_.objects.push_back(std::move(object));
        }
    }

    Result<RawScene> finish(bool has_instances) {
        if (has_instances) addStageObjects();
        const auto say = [&](const std::vector<std::string>& names, const char* one,
                             const char* many) {
            if (names.empty()) return;
            std::map<std::string, int> counts;
            std::vector<std::string> order;
            for (const std::string& name : names) {
                if (++counts[name] == 1) order.push_back(cleanText(name));
            }
            scene_.warnings.push_back(io::counted(names.size(), one, many) + ": " +
                                      io::listOf(order));
        };
        say(missing_, "model is not in the dataset's folder and was left out",
            "models are not in the dataset's folder and were left out");
        say(unreadable_, "model cannot be read and was left out",
            "models cannot be read and were left out");
        say(bad_, "object has a placement that is none and was left out",
            "objects have placements that are none and were left out");
        if (hidden_ > 0) {
            scene_.notes.push_back(io::counted(hidden_, "object is marked as invisible",
                                               "objects are marked as invisible"));
        }
        bool anything = false;
        for (const MeshPart& part : scene_.parts) anything = anything || !part.triangles.empty();
        if (!anything) {
            std::string message = "the scene holds nothing that can be drawn";
            for (const std::string& warning : scene_.warnings) message += "; " + warning;
            return fail(ErrorCode::BadInput, message, path_.string());
        }
        if (scene_.materials.empty()) scene_.materials.emplace_back();
        return std::move(scene_);
    }

    const fs::path& path_;
    const Dataset& dataset_;
    const LabelTable& labels_;
    JobContext job_;
    RawScene scene_;
    std::map<fs::path, std::unique_ptr<RawScene>> articulated_;
    std::map<std::int64_t, std::string> lexicon_;
    io::TriangleBudget budget_;
    io::ObjectNames names_;
    bool com_by_default_ = true;
    bool stage_labelled_ = false;
    std::size_t hidden_ = 0;
    std::vector<std::string> missing_;
    std::vector<std::string> unreadable_;
    std::vector<std::string> bad_;
};

/// The folder that all of a dataset lies in: its config's, else the one above the scene's.
fs::path datasetFolder(const fs::path& path, const std::optional<fs::path>& config) {
    if (config) return config->parent_path();
    fs::path folder = io::absoluteNormal(path).parent_path();
    for (const char* name : {"scenes", "scene_instances", "stages", "objects", "configs"}) {
        if (folder.filename() == name) folder = folder.parent_path();
    }
    return folder;
}

std::optional<fs::path> configOf(const fs::path& path) {
    if (path.filename().string().ends_with(kDatasetEnding)) return io::absoluteNormal(path);
    return findDatasetConfig(path);
}

Result<Dataset> datasetOf(const fs::path& path, const ImportOptions& options) {
    const std::optional<fs::path> config = configOf(path);
    std::vector<fs::path> folders = {datasetFolder(path, config),
                                     io::absoluteNormal(path).parent_path()};
    for (const fs::path& folder : options.model_folders) {
        folders.push_back(io::absoluteNormal(folder));
    }
    const fs::path dataset_folder = folders.front();
    return Dataset::open(config.value_or(fs::path()), dataset_folder,
                         io::ReachableFiles(std::move(folders)));
}

tl::unexpected<Error> severalScenes(const std::vector<DatasetScene>& scenes,
                                    const fs::path& path) {
    if (scenes.empty()) {
        return fail(ErrorCode::BadInput,
                    "the dataset config names no scene instance and no stage whose file is there",
                    path.string());
    }
    std::vector<std::string> names;
    for (const DatasetScene& scene : scenes) names.push_back(cleanText(scene.name));
    return fail(ErrorCode::BadInput,
                fmt::format("the dataset has {} scenes ({}); name the file of one, such as {}, or "
                            "plan all of them with 'dollytrack batch'",
                            scenes.size(), io::listOf(names, 5), scenes.front().file.string()),
                path.string());
}

bool holdsAny(std::string_view head, std::initializer_list<std::string_view> keys) {
    return std::any_of(keys.begin(), keys.end(), [&](std::string_view key) {
        return head.find(key) != std::string_view::npos;
    });
}

}  // namespace

bool likeHabitat(std::string_view head) {
    const auto first = head.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
    if (first == std::string_view::npos || head[first] != '{') return false;
    if (holdsAny(head, {"\"stage_instance\"", "\"object_instances\"", "\"render_asset\"",
                        "\"articulated_object_instances\""})) {
        return true;
    }
    return holdsAny(head, {"\"stages\"", "\"scene_instances\"", "\"objects\""}) &&
           holdsAny(head, {"\"paths\"", "\"default_attributes\"", "\"configs\""});
}

bool isHabitatPart(const fs::path& path) {
    const std::string name = path.filename().string();
    return name.ends_with(".stage_config.json") || name.ends_with(".object_config.json");
}

Result<RawScene> readHabitat(const fs::path& path, const ImportOptions& options,
                             const JobContext& job) {
    const Result<LabelTable> labels = labelsOf(options);
    if (!labels) return tl::unexpected(labels.error());
    const Result<Dataset> dataset = datasetOf(path, options);
    if (!dataset) return tl::unexpected(dataset.error());
    fs::path scene = io::absoluteNormal(path);
    if (path.filename().string().ends_with(kDatasetEnding)) {
        const std::vector<DatasetScene> scenes = dataset->scenes();
        if (scenes.size() != 1) return severalScenes(scenes, path);
        scene = scenes.front().file;
        if (!dataset->files().find(scene.parent_path(), scene.filename().string())) {
            return severalScenes({}, path);
        }
        if (scene.extension() != ".json") {
            const auto labelled = semantics::findLabelledFiles(scene);
            Result<RawScene> stage =
                labelled ? semantics::readLabelled(*labelled, job) : readModel(scene, job);
            if (!stage) return stage;
            for (TextureRequest& texture : stage->textures) texture.folder = scene.parent_path();
            return stage;
        }
    }
    const Result<json> document = io::readBoundedJson(scene);
    if (!document) return tl::unexpected(document.error());
    if (!document->is_object()) {
        return fail(ErrorCode::BadInput, "a scene of Habitat is a JSON object", path.string());
    }
    SceneReader reader(scene, *dataset, *labels, job);
    return document->contains("render_asset") ? reader.readPart(*document)
                                              : reader.readInstance(*document);
}

std::vector<fs::path> habitatInputs(const fs::path& path, const ImportOptions& options) {
    std::vector<fs::path> inputs = {datasetFolder(path, configOf(path)),
                                    io::absoluteNormal(path).parent_path()};
    for (const fs::path& folder : options.model_folders) {
        inputs.push_back(io::absoluteNormal(folder));
    }
    return inputs;
}

Result<std::vector<fs::path>> scenesOfDataset(const fs::path& config) {
    const Result<Dataset> dataset = datasetOf(config, {});
    if (!dataset) return tl::unexpected(dataset.error());
    std::vector<fs::path> files;
    for (const DatasetScene& scene : dataset->scenes()) files.push_back(scene.file);
    if (files.empty()) return severalScenes({}, config);
    return files;
}

}  // namespace dollytrack::habitat
