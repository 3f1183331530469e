#include "engine/io/datasets/scenenet_reader.h"

#include "engine/core/clean_text.h"
#include "engine/core/object_names.h"
#include "engine/core/text_lists.h"
#include "engine/io/datasets/model_library.h"
#include "engine/io/datasets/scenenet_description.h"
#include "engine/io/files/file_type.h"
#include "engine/io/files/input_file.h"
#include "engine/io/models/model_reader.h"
#include "engine/io/object_parts/object_grouping.h"
#include "engine/io/raw_scene/model_placement.h"
#include "engine/io/settings/import_labels.h"
#include "engine/scene/labels.h"

#include <fmt/format.h>

#include <map>
#include <optional>
#include <set>

namespace dollytrack {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> sceneNetModelFolders(const fs::path& scene, const ImportOptions& options) {
    return foldersFor(scene, options.model_folders,
                      {"ShapeNetCore.v2", "ShapeNetCore.v1", "ShapeNetCore", "ShapeNet"});
}

std::vector<fs::path> layoutFolders(const fs::path& scene, const ImportOptions& options) {
    std::error_code error;
    std::vector<fs::path> given = options.model_folders;
    given.push_back(fs::absolute(scene, error).parent_path());
    return foldersFor(scene, given, {"layouts"});
}

/// Finds a layout such as "./bathroom/bathroom1_layout.obj" below the scene's folder or the model
/// folders: by the written path, otherwise by its last folder and name, otherwise by its name.
std::optional<fs::path> findLayout(const std::vector<fs::path>& folders, const std::string& name) {
    const fs::path written = fs::path(name).lexically_normal();
    const fs::path file = written.filename();
    for (const fs::path& way : {written, written.parent_path().filename() / file, file}) {
        if (auto found = findBelow(folders, way)) return found;
    }
    return std::nullopt;
}

/// Path of a model in ShapeNetCore.v2 or v1.
std::optional<fs::path> findModel(const std::vector<fs::path>& folders,
                                  const SceneNetObject& object) {
    const fs::path folder = fs::path(object.wnid) / object.hash;
    for (const char* name : {"models/model_normalized.obj", "model_normalized.obj", "model.obj"}) {
        if (auto found = findBelow(folders, folder / name)) return found;
    }
    return std::nullopt;
}

/// The scene generator's placement of a model: scaled to its height and centred horizontally over
/// the origin, with its base a tenth of the height above the origin. (The generator's documentation
/// puts the base at the origin; its code does this.)
std::optional<Eigen::Affine3d> placementOf(const SceneNetObject& object, const RawScene& model) {
    Eigen::AlignedBox3d box;
    for (const MeshPart& part : model.parts) {
        if (!part.triangles.empty()) box.extend(part.bounds.cast<double>());
    }
    const double height = box.isEmpty() ? 0.0 : box.sizes().y();
    const bool turns = std::abs(object.scene_from_object.linear().determinant()) > 1e-6;
    if (!(height > 0.0) || !turns) return std::nullopt;
    Eigen::Vector3d origin = box.center();
    origin.y() -= 0.6 * height;
    return object.scene_from_object * Eigen::Scaling(object.height_m / height) *
           Eigen::Translation3d(-origin);
}

/// Adds the layout: parts with the name of a target are objects, the rest is the building.
void addLayoutObjects(const LabelTable& labels, RawScene& scene) {
    for (const ObjectDraft& draft : groupByNodes(scene, labels)) {
        SourceObject object;
        object.name = draft.name;
        object.structure = draft.label.kind != LabelKind::Target;
        object.nyu40 = draft.label.nyu40;
        if (object.structure && object.nyu40 == 0) object.nyu40 = kNyuOtherStructure;
        object.parts = draft.parts;
        scene.objects.push_back(std::move(object));
    }
}

class SceneNetImport {
  public:
    SceneNetImport(const fs::path& path, const ImportOptions& options,
                   const SceneNetDescription& source, const LabelTable& labels)
        : where_(path.string()),
          source_(source),
          labels_(labels),
          folders_(sceneNetModelFolders(path, options)),
          layout_(findLayout(layoutFolders(path, options), source.layout_file)) {
        for (const SceneNetObject& object : source.objects) {
            const std::optional<fs::path> file = findModel(folders_, object);
            models_.push_back(file ? std::optional(library_.add(*file)) : std::nullopt);
            if (file) continue;
            ++missing_;
            missing_categories_.insert(object.wnid);
        }
    }

    Result<RawScene> read(const JobContext& job) {
        if (!layout_ && missing_ == models_.size()) {
            return fail(ErrorCode::BadInput, whatIsMissing() + "; " + whereToGet() + ".", where_);
        }
        RawScene scene;
        if (layout_) {
            Result<RawScene> layout = readModel(*layout_, job);
            if (!layout) return layout;
            scene = std::move(*layout);
            for (TextureRequest& texture : scene.textures) texture.folder = layout_->parent_path();
            addLayoutObjects(labels_, scene);
        }
        scene.file_unit_m = 1.0;
        scene.file_up_axis = 'y';
        if (Status placed = placeModels(job, scene); !placed) {
            return tl::unexpected(placed.error());
        }
        if (!layout_ || missing_ > 0) {
            scene.warnings.push_back(whatIsMissing() + "; " + whereToGet());
        }
        if (scene.materials.empty()) scene.materials.emplace_back();
        return scene;
    }

  private:
    [[nodiscard]] std::string whatIsMissing() const {
        std::string text;
        if (!layout_) text = "the layout " + cleanText(source_.layout_file);
        if (missing_ > 0) {
            text += fmt::format("{}the {} of {} ({} of ShapeNet)", text.empty() ? "" : " and ",
                                missing_ == 1 ? "model" : "models",
                                counted(missing_, "object", "objects"),
                                counted(missing_categories_.size(), "category", "categories"));
        }
        return text + (missing_ + (layout_ ? 0 : 1) > 1 ? " are" : " is") + " not there";
    }

    static std::string whereToGet() {
        return "get SceneNet RGB-D's layouts and ShapeNetCore.v2 (<number>/<model>/models/"
               "model_normalized.obj), and name their folders with --models";
    }

    Status placeModels(const JobContext& job, RawScene& scene) {
        if (Status read = library_.read(job); !read) return read;
        std::map<std::size_t, ModelPlacement> placements;
        TriangleBudget budget;
        ObjectNames names;
        std::vector<std::string> unusable;
        for (std::size_t i = 0; i < models_.size(); ++i) {
            if (!models_[i]) continue;
            const SceneNetObject& source = source_.objects[i];
            const RawScene* model = library_.model(*models_[i]);
            const auto placement = model ? placementOf(source, *model) : std::nullopt;
            if (!placement) {
                unusable.push_back(source.wnid + "/" + source.hash);
                continue;
            }
            if (Status fits = budget.take(*model, where_); !fits) return fits;
            auto at = placements.try_emplace(*models_[i], *model, scene).first;
            const Label label = labels_.find(source.wnid);
            SourceObject object;
            object.name = names.next(label.nyu40 > 0 ? std::string(nyu40Name(label.nyu40))
                                                     : "object " + source.wnid);
            object.category = source.wnid;
            object.parts = at->second.place(object.name, *placement);
            scene.objects.push_back(std::move(object));
        }
        if (!unusable.empty()) {
            scene.warnings.push_back(counted(unusable.size(),
                                             "model that cannot be read or placed was left out",
                                             "models that cannot be read or placed were left out") +
                                     ": " + listOf(unusable));
        }
        return {};
    }

    std::string where_;
    const SceneNetDescription& source_;
    const LabelTable& labels_;
    std::vector<fs::path> folders_;
    std::optional<fs::path> layout_;
    ModelLibrary library_{TexturePlace::AroundModelsFolder};
    std::vector<std::optional<std::size_t>> models_;
    std::size_t missing_ = 0;
    std::set<std::string> missing_categories_;
};

}  // namespace

bool likeSceneNet(std::string_view head) {
    return fromFirstLetter(head).starts_with("layout_file:");
}

Result<RawScene> readSceneNetScene(const fs::path& path, const ImportOptions& options,
                                   const JobContext& job) {
    const Result<LabelTable> labels = labelsOf(options);
    if (!labels) return tl::unexpected(labels.error());
    const Result<std::string> text = readNamedFile(path, std::uint64_t{512} << 20U);
    if (!text) return tl::unexpected(text.error());
    const Result<SceneNetDescription> source = parseSceneNet(*text, path.string());
    if (!source) return tl::unexpected(source.error());
    return SceneNetImport(path, options, *source, *labels).read(job);
}

std::vector<fs::path> sceneNetInputs(const fs::path& path, const ImportOptions& options) {
    std::vector<fs::path> inputs = layoutFolders(path, options);
    const std::vector<fs::path> models = sceneNetModelFolders(path, options);
    inputs.insert(inputs.end(), models.begin(), models.end());
    return inputs;
}

}  // namespace dollytrack
