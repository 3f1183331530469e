#include "engine/io/habitat/habitat_reader.h"

#include "engine/core/clean_text.h"
#include "engine/core/name_pattern.h"
#include "engine/io/datasets/model_library.h"
#include "engine/io/datasets/object_names.h"
#include "engine/io/files/bounded_json.h"
#include "engine/io/gazebo/urdf_reader.h"
#include "engine/io/habitat/dataset_config.h"
#include "engine/io/import/import_labels.h"
#include "engine/io/import/model_placement.h"
#include "engine/io/import/model_reader.h"
#include "engine/io/import/scene_format.h"
#include "engine/io/object_parts/object_grouping.h"
#include "engine/io/sandbox/input_record.h"
#include "engine/io/semantics/labelled_reader.h"
#include "engine/scene/labels.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <map>
#include <memory>
#include <optional>

namespace dollytrack::habitat {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::size_t kMostInstances = 100'000;

/// Three numbers, or `usual` without a value; nothing for a value of another kind.
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

/// A rotation of four numbers, w first. Nothing where the value is no rotation.
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

bool isOn(const json& object, const char* key) {
    const auto found = object.find(key);
    return found != object.end() && found->is_boolean() && found->get<bool>();
}

/// The names of the attributes that say which way a mesh is stored.
struct AxisKeys {
    const char* up = "up";
    const char* front = "front";
};

/// Semantic meshes may have axes of their own; else they have those of the model.
AxisKeys semanticAxisKeys(const json& attributes) {
    const bool own = attributes.contains("semantic_up") || attributes.contains("semantic_front");
    return own ? AxisKeys{"semantic_up", "semantic_front"} : AxisKeys{};
}

/// Turns the mesh's upward and forward axes to Habitat's: y up, looking along -z.
Eigen::Matrix3d rotationFromUpAndFront(const json& attributes, const AxisKeys& keys) {
    const Eigen::Vector3d usual_up = Eigen::Vector3d::UnitY();
    const Eigen::Vector3d usual_front = -Eigen::Vector3d::UnitZ();
    const Eigen::Vector3d up = vectorIn(attributes, keys.up, usual_up).value_or(usual_up);
    const Eigen::Vector3d front =
        vectorIn(attributes, keys.front, usual_front).value_or(usual_front);
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

Eigen::Vector3d scaleOf(const json& attributes) {
    return vectorIn(attributes, "scale", Eigen::Vector3d::Ones()).value_or(Eigen::Vector3d::Ones());
}

/// The size and axes that a description gives its model.
Eigen::Affine3d modelFromAsset(const json& attributes, const AxisKeys& keys = {}) {
    double unit = numberAt(attributes, "units_to_meters").value_or(1.0);
    if (!(unit > 0.0)) unit = 1.0;
    Eigen::Affine3d transform = scaling(unit * scaleOf(attributes));
    transform.linear() = transform.linear() * rotationFromUpAndFront(attributes, keys);
    return transform;
}

/// The name with the description's own in place of the words that stand for it.
std::string withConfigName(std::string name, const fs::path& description) {
    constexpr std::string_view kConfigName = "%%CONFIG_NAME_AS_ASSET_FILENAME%%";
    if (const auto at = name.find(kConfigName); at != std::string::npos) {
        const std::string own = description.filename().string();
        name.replace(at, kConfigName.size(), own.substr(0, own.find('.')));
    }
    return name;
}

/// The file that a description names, if it is there.
std::optional<fs::path> assetOf(const Template& found, const char* key,
                                const io::ReachableFiles& files) {
    const auto at = found.attributes.find(key);
    if (at == found.attributes.end() || !at->is_string()) return std::nullopt;
    return files.find(found.folder, withConfigName(at->get<std::string>(), found.file));
}

/// Whether its attributes turn, move or scale a mesh.
bool changesGeometry(const Template& found) {
    return std::ranges::any_of(std::array{"up", "front", "scale", "origin", "units_to_meters"},
                               [&](const char* key) { return found.attributes.contains(key); });
}

/// Names without a word: HSSD's models are called by 40 hexadecimal digits.
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

    /// A stage or an object alone. A model without axes in its description keeps those of its file.
    Result<RawScene> readPart(const Template& part) {
        if (Status added = addStage(part, json::object()); !added) {
            return tl::unexpected(added.error());
        }
        const bool described = part.attributes.contains("up") || part.attributes.contains("front");
        if (part.file.extension() != ".json" && !described) scene_.file_up_axis = stage_up_axis_;
        return finish(false);
    }

  private:
    static tl::unexpected<Error> cancelled() {
        return fail(ErrorCode::Cancelled, "import was cancelled");
    }

    static bool isLocal(const std::string& origin) {
        const std::string small = inSmallLetters(origin);
        return small == "asset_local" || small == "as_local";
    }

    Status readLexiconOf(const json& instance) {
        const std::string name =
            withConfigName(io::textIn(instance, "semantic_scene_instance"), path_);
        if (name.empty()) return {};
        const auto file = dataset_.findLexicon(name);
        if (!file) {
            scene_.notes.push_back("the semantic lexicon " + name +
                                   " is missing; classes are found by name");
            return {};
        }
        const Result<json> document = io::readBoundedJson(*file);
        if (!document) return tl::unexpected(document.error());
        lexicon_ = readLexicon(*document);
        return {};
    }

    Status addStage(const Template& found, const json& instance) {
        const std::string name = shortName(
            found.file.empty() ? io::textIn(instance, "template_name") : found.file.string());
        const auto asset = assetOf(found, "render_asset", dataset_.files());
        if (!asset) {
            missing_.push_back("the model of stage " + name);
            return {};
        }
        const auto placement = instanceTransform(instance);
        if (!placement) {
            bad_.push_back("the stage " + name);
            return {};
        }
        const auto labelled = labelledFilesOf(found, *asset);
        Result<RawScene> read =
            labelled ? semantics::readLabelled(*labelled, job_) : readModel(*asset, job_);
        if (!read) return tl::unexpected(read.error());
        // The mesh that is shown: the labelled one where there is no other.
        fs::path shown = *asset;
        if (labelled) shown = labelled->textured.empty() ? labelled->labelled : labelled->textured;
        for (TextureRequest& texture : read->textures) texture.folder = shown.parent_path();
        const bool semantic_shown = shown != *asset && labelled->textured.empty();
        const AxisKeys axis_keys = semantic_shown ? semanticAxisKeys(found.attributes) : AxisKeys{};
        const Eigen::Vector3d origin = vectorIn(found.attributes, "origin", Eigen::Vector3d::Zero())
                                           .value_or(Eigen::Vector3d::Zero());
        const Eigen::Affine3d scene_from_stage = Eigen::Translation3d(placement->translation) *
                                                 placement->rotation * scaling(placement->scale) *
                                                 modelFromAsset(found.attributes, axis_keys) *
                                                 Eigen::Translation3d(-origin);
        if (Status fits = budget_.take(*read, path_.string()); !fits) return fits;
        placeWithNodes(*read, scene_from_stage);
        stage_up_axis_ = read->file_up_axis;
        remarks_.add(*read, name);
        return {};
    }

    /// The files that label a stage: found by the name of its model, else of its semantic mesh.
    std::optional<semantics::LabelledFiles> labelledFilesOf(const Template& stage,
                                                            const fs::path& asset) {
        std::optional<semantics::LabelledFiles> labelled = semantics::findLabelledFiles(asset);
        const auto semantic = assetOf(stage, "semantic_asset", dataset_.files());
        if (labelled || !semantic || *semantic == asset) return labelled;
        labelled = semantics::findLabelledFiles(*semantic);
        if (!labelled) {
            scene_.notes.push_back("the semantic mesh " + cleanText(semantic->filename().string()) +
                                   " has no file of names beside it; it was not used");
        } else if (labelled->textured.empty() && labelsCanBeMoved(stage.attributes)) {
            labelled->textured = asset;
        }
        return labelled;
    }

    /// Whether labels can be moved to the model of a stage: the reader of labelled meshes tries
    /// equal axes and quarter turns about x. Otherwise the semantic mesh itself is shown.
    static bool labelsCanBeMoved(const json& attributes) {
        const Eigen::Matrix3d asset_from_semantic =
            rotationFromUpAndFront(attributes, {}).transpose() *
            rotationFromUpAndFront(attributes, semanticAxisKeys(attributes));
        return (asset_from_semantic.col(0) - Eigen::Vector3d::UnitX()).norm() < 1e-6 &&
               asset_from_semantic(1, 1) > -1e-6;
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

    /// A template of objects with its model's file.
    struct ObjectTemplate {
        std::shared_ptr<const Template> found;
        fs::path model;
    };

    struct Wanted {
        const json* instance;
        std::shared_ptr<const Template> found;
        std::size_t model;
        std::string name;
    };

    Result<std::optional<ObjectTemplate>> findObject(const std::string& name) const {
        auto found = dataset_.find(Kind::Object, name);
        if (!found) return tl::unexpected(found.error());
        if (!*found) return std::optional<ObjectTemplate>();
        const auto asset = assetOf(**found, "render_asset", dataset_.files());
        if (!asset) return std::optional<ObjectTemplate>();
        return ObjectTemplate{std::move(*found), *asset};
    }

    Status addObjects(const json::array_t& instances) {
        io::ModelLibrary library;
        std::vector<Wanted> wanted;
        std::map<std::string, std::optional<ObjectTemplate>> known;
        for (const json& instance : instances) {
            if (job_.cancelled()) return cancelled();
            if (!instance.is_object()) continue;
            if (isOff(instance, "is_instance_visible")) {
                ++hidden_;
                continue;
            }
            const std::string name = io::textIn(instance, "template_name");
            auto at = known.find(name);
            if (at == known.end()) {
                auto found = findObject(name);
                if (!found) return tl::unexpected(found.error());
                at = known.emplace(name, std::move(*found)).first;
            }
            if (!at->second) {
                missing_.push_back(name);
                continue;
            }
            wanted.push_back({&instance, at->second->found, library.add(at->second->model), name});
        }
        if (Status read = library.read(job_); !read) return read;
        std::map<std::size_t, ModelPlacement> placements;
        for (const Wanted& one : wanted) {
            if (job_.cancelled()) return cancelled();
            const RawScene* model = library.model(one.model);
            if (model == nullptr) {
                unreadable_.push_back(one.name + " (" + library.reason(one.model) + ")");
                continue;
            }
            const auto placement = instanceTransform(*one.instance);
            if (!placement) {
                bad_.push_back(one.name);
                continue;
            }
            if (Status fits = budget_.take(*model, path_.string()); !fits) return fits;
            const auto [at, is_new] = placements.try_emplace(one.model, *model, scene_);
            if (is_new) remarks_.add(*model, shortName(one.name));
            SourceObject object = describe(one.name, *one.found, *one.instance);
            object.parts = at->second.place(object.name, sceneFromObject(one, *model, *placement));
            scene_.objects.push_back(std::move(object));
        }
        return {};
    }

    /// Habitat places an object's centre of mass, unless the file says that it is the origin of
    /// the model. The centre is the one given, in the axes of the placed object before its scale,
    /// else the middle of the model's box.
    [[nodiscard]] Eigen::Affine3d sceneFromObject(const Wanted& one, const RawScene& model,
                                                  const Placement& placement) const {
        const json& attributes = one.found->attributes;
        const Eigen::Affine3d scaled = scaling(placement.scale) * modelFromAsset(attributes);
        const std::string said = io::textIn(*one.instance, "translation_origin");
        const bool by_center = said.empty() ? com_by_default_ : !isLocal(said);
        Eigen::Vector3d center = Eigen::Vector3d::Zero();
        if (by_center) {
            const bool from_box =
                isOn(attributes, "compute_COM_from_shape") ||
                (!attributes.contains("COM") && !isOff(attributes, "compute_COM_from_shape"));
            if (from_box) {
                const Eigen::AlignedBox3d box = boxOf(model, scaled);
                if (!box.isEmpty()) center = box.center();
            } else {
                center = placement.scale.cwiseProduct(scaleOf(attributes))
                             .cwiseProduct(vectorIn(attributes, "COM", center).value_or(center));
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

    /// A model of articulated objects, which several templates and instances share.
    struct ArticulatedModel {
        std::unique_ptr<RawScene> model;  // null: it cannot be read
        std::string reason;
        std::unique_ptr<ModelPlacement> placement;
    };

    Result<ArticulatedModel> readArticulated(const fs::path& file, const std::string& name) {
        ArticulatedModel read;
        Result<RawScene> model = gazebo::readUrdfModel(file, dataset_.files(), job_);
        if (!model) {
            if (model.error().code == ErrorCode::Cancelled) return tl::unexpected(model.error());
            read.reason = model.error().message;
            return read;
        }
        read.model = std::make_unique<RawScene>(std::move(*model));
        read.placement = std::make_unique<ModelPlacement>(*read.model, scene_);
        remarks_.add(*read.model, shortName(name));
        return read;
    }

    Status addArticulated(const json& instance) {
        if (!instance.is_object()) return {};
        const std::string name = io::textIn(instance, "template_name");
        if (job_.cancelled()) return cancelled();
        const auto found = dataset_.find(Kind::ArticulatedObject, name);
        if (!found) return tl::unexpected(found.error());
        if (!*found) {
            missing_.push_back(name);
            return {};
        }
        auto at = articulated_.find((*found)->file);
        if (at == articulated_.end()) {
            Result<ArticulatedModel> read = readArticulated((*found)->file, name);
            if (!read) return tl::unexpected(read.error());
            at = articulated_.emplace((*found)->file, std::move(*read)).first;
        }
        const ArticulatedModel& known = at->second;
        const auto placement = instanceTransform(instance);
        if (!known.model) {
            unreadable_.push_back(name + " (" + known.reason + ")");
        } else if (!placement) {
            bad_.push_back(name);
        } else {
            if (Status fits = budget_.take(*known.model, path_.string()); !fits) return fits;
            SourceObject object = describe(name, **found, instance);
            object.parts = known.placement->place(
                object.name, Eigen::Translation3d(placement->translation) * placement->rotation *
                                 scaling(placement->scale));
            scene_.objects.push_back(std::move(object));
        }
        return {};
    }

    /// Nodes of the stage that are named after objects are objects; the rest is the building. The
    /// objects of a stage alone are found as in any other file.
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
        say(bad_, "object has no valid translation, rotation or scale and was left out",
            "objects have no valid translation, rotation or scale and were left out");
        if (dataset_.searchesWereCut()) {
            scene_.warnings.emplace_back(
                "more than 2,000 names of templates are no file's name; the rest were not looked "
                "up by parts of names, so name their files");
        }
        remarks_.addTo(scene_);
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
    std::map<fs::path, ArticulatedModel> articulated_;  // by file
    std::map<std::int64_t, std::string> lexicon_;
    io::ModelRemarks remarks_;
    io::TriangleBudget budget_;
    io::ObjectNames names_;
    bool com_by_default_ = true;
    bool stage_labelled_ = false;
    UpAxis stage_up_axis_;  // of the stage's file
    std::size_t hidden_ = 0;
    std::vector<std::string> missing_;
    std::vector<std::string> unreadable_;
    std::vector<std::string> bad_;
};

/// The configs of the dataset that a scene belongs to, or the config itself.
std::vector<fs::path> configsOf(const fs::path& path) {
    if (isDatasetConfig(path)) return {io::absoluteNormal(path)};
    return findDatasetConfigs(path);
}

/// The folder of the whole dataset: its configs', else the one above the scene's. It is never the
/// root of the file system, unless that is the scene's own folder.
fs::path datasetFolder(const fs::path& path, const std::vector<fs::path>& configs) {
    if (!configs.empty()) return configs.front().parent_path();
    fs::path folder = io::absoluteNormal(path).parent_path();
    for (const char* name : {"scenes", "scene_instances", "stages", "objects", "configs"}) {
        const bool above = folder.parent_path().has_relative_path();
        if (folder.filename() == name && above) folder = folder.parent_path();
    }
    return folder;
}

/// The folders that a scene may read: its dataset's, its own, and those that a person gives.
std::vector<fs::path> foldersOf(const fs::path& path, const std::vector<fs::path>& configs,
                                const ImportOptions& options) {
    std::vector<fs::path> folders = {datasetFolder(path, configs),
                                     io::absoluteNormal(path).parent_path()};
    for (const fs::path& folder : options.model_folders) {
        folders.push_back(io::absoluteNormal(folder));
    }
    return folders;
}

Result<Dataset> datasetOf(const fs::path& path, const ImportOptions& options,
                          const JobContext& job) {
    const std::vector<fs::path> configs = configsOf(path);
    const std::vector<fs::path> folders = foldersOf(path, configs, options);
    if (!isDatasetConfig(path)) {
        // Another config in one of these folders would be another dataset.
        fs::path folder = io::absoluteNormal(path).parent_path();
        io::InputRecord::note(io::InputUse::Listing, folder);
        while (folder != folders.front() && folder.has_relative_path()) {
            folder = folder.parent_path();
            io::InputRecord::note(io::InputUse::Listing, folder);
        }
    }
    return Dataset::open(ConfigChoice({}, job).choose(configs, path), folders.front(),
                         io::ReachableFiles(folders), job);
}

tl::unexpected<Error> severalScenes(const std::vector<DatasetScene>& scenes, const fs::path& path) {
    if (scenes.empty()) {
        return fail(
            ErrorCode::BadInput,
            "no scene instance and no stage that the dataset config lists exists; check its "
            "paths",
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

/// The error of a batch whose scene would be read with another config than the one it names.
tl::unexpected<Error> readWithAnother(const fs::path& other, const DatasetScene& scene,
                                      const fs::path& config) {
    const std::string name = cleanText(scene.name);
    if (other.empty()) {
        return fail(ErrorCode::BadInput,
                    "the scene " + name +
                        " does not find this config, which is a link or too far above it; put "
                        "the config itself at most four folders above",
                    config.string());
    }
    return fail(ErrorCode::BadInput,
                "the scene " + name + " is read with " + cleanText(other.string()) +
                    ", not with this config; name that one, or move it elsewhere",
                config.string());
}

bool holdsAny(std::string_view head, std::initializer_list<std::string_view> keys) {
    return std::any_of(keys.begin(), keys.end(), [&](std::string_view key) {
        return head.find(key) != std::string_view::npos;
    });
}

}  // namespace

bool likeHabitat(std::string_view head) {
    if (firstLetter(head) != '{') return false;
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
    const Result<Dataset> dataset = datasetOf(path, options, job);
    if (!dataset) return tl::unexpected(dataset.error());
    fs::path scene = io::absoluteNormal(path);
    if (isDatasetConfig(path)) {
        const std::vector<DatasetScene> scenes = dataset->scenes();
        if (scenes.size() != 1) return severalScenes(scenes, path);
        scene = scenes.front().file;
    }
    const std::string name = scene.filename().string();
    Kind kind = Kind::SceneInstance;
    if (name.ends_with(".stage_config.json") || scene.extension() != ".json") kind = Kind::Stage;
    if (name.ends_with(".object_config.json")) kind = Kind::Object;
    const auto loaded = dataset->load(kind, scene);
    if (!loaded) return tl::unexpected(loaded.error());
    const Template& document = **loaded;
    SceneReader reader(scene, *dataset, *labels, job);
    return document.attributes.contains("render_asset") ? reader.readPart(document)
                                                        : reader.readInstance(document.attributes);
}

std::vector<fs::path> habitatInputs(const fs::path& path, const ImportOptions& options) {
    return foldersOf(path, configsOf(path), options);
}

Result<std::vector<fs::path>> scenesOfDataset(const fs::path& given,
                                              const std::vector<fs::path>& also_named) {
    constexpr DatasetScope kScope = {true, std::uint64_t{1} << 20U, 100'000};
    const fs::path config = io::absoluteNormal(given);
    const fs::path folder = config.parent_path();
    const JobContext job;
    const auto dataset = Dataset::open(config, folder, io::ReachableFiles({folder}), job, kScope);
    if (!dataset) return tl::unexpected(dataset.error());
    ConfigChoice choice(kScope, job);
    std::map<fs::path, fs::path> chosen;  // by folder of scenes
    std::vector<fs::path> files;
    for (const DatasetScene& scene : dataset->scenes()) {
        if (scene.file.extension() != ".json") {
            const auto stage = dataset->load(Kind::Stage, scene.file);
            if (!stage) return tl::unexpected(stage.error());
            // A batch names the model alone. Labelled models find their axes without the config.
            if (changesGeometry(**stage) && !semantics::findLabelledFiles(scene.file)) {
                return fail(ErrorCode::BadInput,
                            "the config gives axes or a size to stages without a stage config; "
                            "write NAME.stage_config.json beside each, or list the models with "
                            "their upward axis and unit",
                            config.string());
            }
        } else {
            const auto [at, is_new] = chosen.try_emplace(scene.file.parent_path());
            if (is_new) at->second = choice.choose(findDatasetConfigs(scene.file), scene.file);
            const bool named = std::ranges::find(also_named, at->second) != also_named.end();
            if (at->second != config && !(named && choice.lists(at->second, scene.file))) {
                return readWithAnother(at->second, scene, config);
            }
        }
        files.push_back(scene.file);
    }
    if (files.empty()) return severalScenes({}, config);
    return files;
}

}  // namespace dollytrack::habitat
