#include "engine/io/habitat/scene_builder.h"

#include "engine/core/clean_text.h"
#include "engine/core/name_pattern.h"
#include "engine/core/object_names.h"
#include "engine/core/text_lists.h"
#include "engine/io/datasets/model_library.h"
#include "engine/io/files/bounded_json.h"
#include "engine/io/gazebo/urdf_reader.h"
#include "engine/io/habitat/attributes.h"
#include "engine/io/habitat/key_check.h"
#include "engine/io/habitat/semantic_classes.h"
#include "engine/io/models/model_reader.h"
#include "engine/io/object_parts/object_grouping.h"
#include "engine/io/raw_scene/model_placement.h"
#include "engine/io/semantics/labelled_reader.h"
#include "engine/scene/label_table.h"
#include "engine/scene/labels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <memory>
#include <optional>

namespace dollytrack::habitat {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::size_t kMostInstances = 100'000;

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
        com_by_default_ = !isLocal(textIn(instance, "translation_origin"));
        classes_ = SemanticClasses::read(dataset_, instance, path_);
        const auto stage = instance.find("stage_instance");
        if (stage != instance.end() && stage->is_object()) {
            keys_.check(*stage, KeyCheck::Place::Instance, path_.filename().string());
            const std::string name = textIn(*stage, "template_name");
            auto found = dataset_.find(Kind::Stage, name);
            if (!found) return tl::unexpected(found.error());
            if (!*found) {
                missing_.push_back("stage " + withoutDescription(Kind::Stage, name));
            } else if (Status added = addStage(**found, *stage); !added) {
                return tl::unexpected(added.error());
            }
        }
        const json::array_t& objects = listIn(instance, "object_instances");
        const json::array_t& articulated = listIn(instance, "articulated_object_instances");
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

    /// Reads a single stage or object. A model without described axes keeps those of its file.
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

    Status addStage(const Template& found, const json& instance) {
        const std::string name =
            shortName(found.file.empty() ? textIn(instance, "template_name") : found.file.string());
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
        // The rendered mesh: the labelled one if there is no textured one.
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

    /// The label files of a stage, found by the name of its model, otherwise of its semantic mesh.
    std::optional<semantics::LabelledFiles> labelledFilesOf(const Template& stage,
                                                            const fs::path& asset) {
        std::optional<semantics::LabelledFiles> labelled = semantics::findLabelledFiles(asset);
        const auto semantic = assetOf(stage, "semantic_asset", dataset_.files());
        if (labelled || !semantic || *semantic == asset) return labelled;
        labelled = semantics::findLabelledFiles(*semantic);
        if (!labelled) {
            scene_.notes.push_back(
                "the semantic mesh " + cleanText(semantic->filename().string()) +
                " was not used because no file with its object names is beside it");
        } else if (labelled->textured.empty() && labelsCanBeMoved(stage.attributes)) {
            labelled->textured = asset;
        }
        return labelled;
    }

    /// Whether labels can be transferred to the stage's model: transferLabels() supports equal axes
    /// and rotations by 90 degrees about x. Otherwise the semantic mesh itself is rendered.
    static bool labelsCanBeMoved(const json& attributes) {
        const Eigen::Matrix3d asset_from_semantic =
            rotationFromUpAndFront(attributes, {}).transpose() *
            rotationFromUpAndFront(attributes, semanticAxisKeys(attributes));
        return (asset_from_semantic.col(0) - Eigen::Vector3d::UnitX()).norm() < 1e-6 &&
               asset_from_semantic(1, 1) > -1e-6;
    }

    /// Adds the stage with its nodes and objects, which separate walls, doors and furniture.
    void placeWithNodes(const RawScene& model, const Eigen::Affine3d& moved) {
        ModelPlacement placement(model, scene_);
        const auto first_part = scene_.parts.size();
        placement.place("stage", moved);
        const int stage = static_cast<int>(scene_.nodes.size()) - 1;
        const int first_node = static_cast<int>(scene_.nodes.size());
        for (const SourceNode& node : model.nodes) {
            SourceNode copy = node;
            copy.parent = node.parent < 0 ? stage : node.parent + first_node;
            if (node.parent < 0) ++scene_.nodes[stage].children;
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

    /// An object's template and model file; if one was not found, `missing` names it.
    struct ObjectTemplate {
        std::shared_ptr<const Template> found;
        fs::path model;
        std::string missing;
    };

    struct Wanted {
        const json* instance;
        std::shared_ptr<const Template> found;
        std::size_t model;
        std::string name;
    };

    /// Describes a name that no file has, with a similar name if there is one.
    std::string withoutDescription(Kind kind, const std::string& name) {
        constexpr int kMostHints = 20;
        const std::string close =
            ++hints_ <= kMostHints ? dataset_.closestTemplate(kind, name) : std::string();
        if (close.empty()) return name + " (no file has this name)";
        return fmt::format("{} (no file has this name; did you mean \"{}\"?)", name, close);
    }

    Result<ObjectTemplate> findObject(const std::string& name) {
        auto found = dataset_.find(Kind::Object, name);
        if (!found) return tl::unexpected(found.error());
        if (!*found) return ObjectTemplate{nullptr, {}, withoutDescription(Kind::Object, name)};
        const auto asset = assetOf(**found, "render_asset", dataset_.files());
        if (asset) return ObjectTemplate{std::move(*found), *asset, {}};
        const std::string named = textIn((*found)->attributes, "render_asset");
        return ObjectTemplate{
            nullptr, {}, fmt::format("{} ({})", name, named.empty() ? "no render_asset" : named)};
    }

    Status addObjects(const json::array_t& instances) {
        ModelLibrary library;
        std::vector<Wanted> wanted;
        std::map<std::string, ObjectTemplate> known;
        for (const json& instance : instances) {
            if (job_.cancelled()) return cancelled();
            if (!instance.is_object()) continue;
            keys_.check(instance, KeyCheck::Place::Instance, path_.filename().string());
            if (isOff(instance, "is_instance_visible")) {
                ++hidden_;
                continue;
            }
            const std::string name = textIn(instance, "template_name");
            auto at = known.find(name);
            if (at == known.end()) {
                auto found = findObject(name);
                if (!found) return tl::unexpected(found.error());
                at = known.emplace(name, std::move(*found)).first;
            }
            const ObjectTemplate& known_as = at->second;
            if (!known_as.found) {
                missing_.push_back(known_as.missing);
                continue;
            }
            wanted.push_back({&instance, known_as.found, library.add(known_as.model), name});
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
            SourceObject object = describe(one.name, one.found->attributes, *one.instance);
            object.parts = at->second.place(object.name, sceneFromObject(one, *model, *placement));
            scene_.objects.push_back(std::move(object));
        }
        return {};
    }

    /// `translation` is the position of the centre of mass, or with asset_local that of the model's
    /// origin. The centre of mass is `COM`, scaled, in the axes of the rotated model; without it,
    /// or with compute_COM_from_shape, the centre of the model's box.
    [[nodiscard]] Eigen::Affine3d sceneFromObject(const Wanted& one, const RawScene& model,
                                                  const Placement& placement) const {
        const json& attributes = one.found->attributes;
        const Eigen::Affine3d scaled = scaling(placement.scale) * modelFromAsset(attributes);
        const std::string said = textIn(*one.instance, "translation_origin");
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

    SourceObject describe(const std::string& template_name, const json& attributes,
                          const json& instance) {
        SourceObject object;
        std::string name = shortName(template_name);
        object.category = classes_.classOf(instance, attributes, name);
        if (isNumberName(name)) name = object.category.empty() ? "object" : object.category;
        object.name = names_.next(name);
        return object;
    }

    /// The model of a URDF file, shared by several templates and instances.
    struct ArticulatedModel {
        std::unique_ptr<RawScene> model;  // null if it cannot be read
        std::string reason;
        std::unique_ptr<ModelPlacement> placement;
    };

    Result<ArticulatedModel> readArticulated(const fs::path& file, const std::string& name) {
        ArticulatedModel read;
        Result<RawScene> model = gazebo::readUrdfModel(file, dataset_.files(), job_);
        if (!model) {
            if (model.error().code == ErrorCode::Cancelled) return tl::unexpected(model.error());
            read.reason =
                fs::path(model.error().where).filename().string() + ": " + model.error().message;
            return read;
        }
        read.model = std::make_unique<RawScene>(std::move(*model));
        read.placement = std::make_unique<ModelPlacement>(*read.model, scene_);
        remarks_.add(*read.model, shortName(name));
        return read;
    }

    /// The description NAME.ao_config.json beside a URDF, with class and scale; null without one.
    [[nodiscard]] Result<std::shared_ptr<const Template>> articulatedConfig(
        const fs::path& urdf) const {
        const auto file =
            dataset_.files().find(urdf.parent_path(), urdf.stem().string() + ".ao_config.json");
        if (!file) return std::shared_ptr<const Template>();
        return dataset_.load(Kind::ArticulatedObject, *file);
    }

    Status addArticulated(const json& instance) {
        if (!instance.is_object()) return {};
        keys_.check(instance, KeyCheck::Place::Instance, path_.filename().string());
        if (isOff(instance, "is_instance_visible")) {
            ++hidden_;
            return {};
        }
        const std::string name = textIn(instance, "template_name");
        if (job_.cancelled()) return cancelled();
        const auto found = dataset_.find(Kind::ArticulatedObject, name);
        if (!found) return tl::unexpected(found.error());
        if (!*found) {
            missing_.push_back(withoutDescription(Kind::ArticulatedObject, name));
            return {};
        }
        auto at = articulated_.find((*found)->file);
        if (at == articulated_.end()) {
            Result<ArticulatedModel> read = readArticulated((*found)->file, name);
            if (!read) return tl::unexpected(read.error());
            at = articulated_.emplace((*found)->file, std::move(*read)).first;
        }
        const ArticulatedModel& known = at->second;
        const auto described = articulatedConfig((*found)->file);
        if (!described) return tl::unexpected(described.error());
        const json& attributes = *described ? (*described)->attributes : (*found)->attributes;
        const auto placement = instanceTransform(instance);
        const double size = numberAt(attributes, "uniform_scale").value_or(1.0);
        if (!known.model) {
            unreadable_.push_back(name + " (" + known.reason + ")");
        } else if (!placement) {
            bad_.push_back(name);
        } else {
            if (Status fits = budget_.take(*known.model, path_.string()); !fits) return fits;
            SourceObject object = describe(name, attributes, instance);
            object.parts = known.placement->place(
                object.name, Eigen::Translation3d(placement->translation) * placement->rotation *
                                 scaling((size > 0.0 ? size : 1.0) * placement->scale));
            scene_.objects.push_back(std::move(object));
        }
        return {};
    }

    /// Groups the stage's nodes into objects by their names; those without a target's class are
    /// structure. Not used for a single stage, whose objects are found as in any other file.
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
            if (object.structure && !isStructureClass(object.nyu40)) {
                object.nyu40 = kNyuOtherStructure;
            }
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
            scene_.warnings.push_back(counted(names.size(), one, many) + ": " + listOf(order));
        };
        say(missing_, "model is not in the dataset's folder and was left out",
            "models are not in the dataset's folder and were left out");
        say(unreadable_, "model cannot be read and was left out",
            "models cannot be read and were left out");
        say(bad_, "object has no valid translation, rotation or scale and was left out",
            "objects have no valid translation, rotation or scale and were left out");
        if (dataset_.searchesWereCut()) {
            scene_.warnings.emplace_back(
                "more than 2,000 template names match no file name; partial matches were not "
                "searched for the rest, so write their full file names");
        }
        for (std::string& line : classes_.warnings()) scene_.warnings.push_back(std::move(line));
        scene_.notes.insert(scene_.notes.end(), classes_.notes().begin(), classes_.notes().end());
        for (std::vector<std::string> lines :
             {keys_.warnings(), dataset_.warnings(!missing_.empty())}) {
            std::ranges::move(lines, std::back_inserter(scene_.warnings));
        }
        remarks_.addTo(scene_);
        if (hidden_ > 0) {
            scene_.notes.push_back(counted(hidden_, "object is marked as invisible",
                                           "objects are marked as invisible"));
        }
        bool anything = false;
        for (const MeshPart& part : scene_.parts) anything = anything || !part.triangles.empty();
        if (!anything) {
            std::string message = "the scene contains nothing that can be rendered";
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
    std::map<fs::path, ArticulatedModel> articulated_;  // by URDF file
    SemanticClasses classes_;
    KeyCheck keys_;  // for instances
    ModelRemarks remarks_;
    TriangleBudget budget_;
    ObjectNames names_;
    bool com_by_default_ = true;
    bool stage_labelled_ = false;
    UpAxis stage_up_axis_;  // of the stage's file
    std::size_t hidden_ = 0;
    int hints_ = 0;  // number of searches for similar names
    std::vector<std::string> missing_;
    std::vector<std::string> unreadable_;
    std::vector<std::string> bad_;
};

}  // namespace

Result<RawScene> readSceneInstance(const fs::path& path, const json& instance,
                                   const Dataset& dataset, const LabelTable& labels,
                                   const JobContext& job) {
    return SceneReader(path, dataset, labels, job).readInstance(instance);
}

Result<RawScene> readPart(const fs::path& path, const Template& part, const Dataset& dataset,
                          const LabelTable& labels, const JobContext& job) {
    return SceneReader(path, dataset, labels, job).readPart(part);
}

}  // namespace dollytrack::habitat
