#include "engine/io/gazebo/visuals.h"

#include "engine/core/clean_text.h"
#include "engine/core/name_pattern.h"
#include "engine/core/object_names.h"
#include "engine/core/text_lists.h"
#include "engine/io/datasets/model_library.h"
#include "engine/io/files/confined_folder.h"
#include "engine/io/files/file_type.h"
#include "engine/io/files/input_file.h"
#include "engine/io/files/percent_text.h"
#include "engine/io/gazebo/fuel_uri.h"
#include "engine/io/gazebo/link_xml.h"
#include "engine/io/gazebo/shape_scene.h"
#include "engine/io/raw_scene/model_placement.h"

#include <pugixml.hpp>

#include <algorithm>
#include <iterator>
#include <memory>
#include <string_view>
#include <tuple>
#include <utility>

namespace dollytrack::gazebo {
namespace {

namespace fs = std::filesystem;

constexpr int kMostFoldersUp = 4;
constexpr std::uint64_t kMostConfigBytes = std::uint64_t{1} << 20U;

/// A folder and at most four folders above it, innermost first, without the file system's root.
std::vector<fs::path> foldersAround(const fs::path& folder) {
    std::vector<fs::path> around;
    fs::path at = folder;
    for (int up = 0; up <= kMostFoldersUp && at.has_relative_path(); ++up) {
        around.push_back(at);
        at = at.parent_path();
    }
    return around;
}

/// The package's name in a package.xml, or the description's file name in a model.config.
std::string nameIn(const fs::path& config) {
    const Result<std::string> text = readNamedFile(config, kMostConfigBytes);
    pugi::xml_document document;
    if (!text || !document.load_buffer(text->data(), text->size())) return {};
    if (const pugi::xml_node package = document.child("package")) {
        return textOf(package.child("name"));
    }
    // Of several versions the last one listed is the newest.
    std::string file;
    for (const pugi::xml_node& sdf : document.child("model").children("sdf")) file = textOf(sdf);
    return file;
}

/// Removes a scheme: "model://chair/chair.dae" becomes "chair/chair.dae". Returns whether `uri` had
/// it.
bool takeScheme(std::string& uri, std::string_view scheme) {
    if (!uri.starts_with(scheme)) return false;
    uri.erase(0, scheme.size());
    return true;
}

/// Whether the visual's colour makes a material fully transparent. Textured materials keep their
/// own colour.
bool isHidden(const Visual& visual, const Material& material) {
    return visual.color && material.texture < 0 && !((*visual.color)[3] > 0.0F);
}

using Submeshes = std::map<std::string, std::vector<std::size_t>>;

/// The parts of a model by mesh and node name; all parts by the empty name.
Submeshes submeshesOf(const RawScene& model) {
    Submeshes parts;
    for (std::size_t i = 0; i < model.parts.size(); ++i) {
        const std::string& mesh = model.parts[i].name;
        const std::string& node = model.nodes[model.parts[i].node].name;
        parts[""].push_back(i);
        if (!mesh.empty()) parts[mesh].push_back(i);
        if (!node.empty() && node != mesh) parts[node].push_back(i);
    }
    return parts;
}

/// Lets the textures of meshes in a folder "meshes" be searched for beside that folder, because
/// they are mostly in "materials/textures".
void lookUpTexturesAroundMeshes(const ModelPath& files, RawScene& model) {
    for (TextureRequest& texture : model.textures) {
        const fs::path folder = texture.folder;
        std::string name = texture.name;
        std::replace(name.begin(), name.end(), '\\', '/');
        if (folder.filename() != "meshes" || fs::path(name).is_absolute() ||
            !files.reaches(folder.parent_path())) {
            continue;
        }
        texture.folder = folder.parent_path();
        texture.name = (folder.filename() / name).lexically_normal().string();
    }
}

class SceneOfLinks {
  public:
    SceneOfLinks(const ModelPath& files, std::string where, const JobContext& job)
        : files_(files), where_(std::move(where)), job_(job) {
        scene_.file_unit_m = 1.0;
        scene_.file_up_axis = 'z';
        scene_.nodes.push_back({"", -1, 0});
    }

    Result<RawScene> build(const std::vector<LinkObject>& links, const OmittedParts& left_out) {
        missing_ = left_out.models;
        unknown_shapes_ = left_out.shapes;
        addDoubts(left_out.doubts);
        std::map<std::pair<fs::path, std::string>, std::optional<std::size_t>> found;
        std::map<const Visual*, std::size_t> wanted;
        for (const LinkObject& link : links) {
            if (job_.cancelled()) return cancelled();
            for (const Visual& visual : link.visuals) {
                if (visual.shape != Visual::Shape::Mesh) continue;
                const auto [at, is_new] = found.try_emplace({visual.folder, visual.uri});
                if (is_new) {
                    const auto file = files_.find(visual.folder, visual.uri);
                    if (file) at->second = library_.add(*file);
                }
                if (at->second) {
                    wanted[&visual] = *at->second;
                } else {
                    leaveOut(visual, link.name);
                }
            }
        }
        if (Status read = library_.read(job_); !read) return tl::unexpected(read.error());
        for (const auto& [name, number] : found) {
            RawScene* model = number ? library_.model(*number) : nullptr;
            if (model != nullptr) lookUpTexturesAroundMeshes(files_, *model);
        }
        ObjectNames names;
        for (const LinkObject& link : links) {
            if (job_.cancelled()) return cancelled();
            SourceObject object;
            object.name = names.next(link.name.empty() ? "link" : link.name);
            for (const Visual& visual : link.visuals) {
                const auto model = wanted.find(&visual);
                if (visual.shape == Visual::Shape::Mesh && model == wanted.end()) continue;
                Status placed = visual.shape == Visual::Shape::Mesh
                                    ? placeMesh(visual, model->second, object)
                                    : placeShape(visual, object);
                if (!placed) return tl::unexpected(placed.error());
            }
            if (!object.parts.empty()) scene_.objects.push_back(std::move(object));
        }
        return finish();
    }

  private:
    void leaveOut(const Visual& visual, const std::string& link) {
        incomplete_.push_back(link.empty() ? "link" : link);
        switch (files_.absenceOf(visual.folder, visual.uri)) {
            case ModelPath::Absence::NoFolder:
                missing_.push_back(visual.uri);
                break;
            case ModelPath::Absence::NoFile:
                absent_.push_back(visual.uri);
                break;
            case ModelPath::Absence::OtherCase:
                other_case_.push_back(visual.uri);
                break;
        }
    }

    void addDoubts(const std::vector<std::string>& doubts) {
        constexpr std::size_t kMostDoubts = 20;
        const std::size_t shown = std::min(doubts.size(), kMostDoubts);
        for (std::size_t i = 0; i < shown; ++i) scene_.warnings.push_back(doubts[i]);
        if (shown == doubts.size()) return;
        scene_.warnings.push_back(counted(doubts.size() - shown, "more problem of this kind",
                                          "more problems of this kind"));
    }

    Status placeMesh(const Visual& visual, std::size_t number, SourceObject& object) {
        const RawScene* model = library_.model(number);
        if (model == nullptr) {
            unreadable_.push_back(visual.uri + " (" + library_.reason(number) + ")");
            return {};
        }
        const auto [known, is_new] = submeshes_.try_emplace(number);
        if (is_new) {
            known->second = submeshesOf(*model);
            remarks_.add(*model, library_.path(number).filename().string());
        }
        const auto picked = known->second.find(visual.submesh);
        if (picked == known->second.end()) {
            unmatched_.push_back(visual.uri + ": " + visual.submesh);
            return {};
        }
        if (Status fits = budget_.take(*model, picked->second, where_); !fits) return fits;
        std::vector<std::size_t> parts;
        std::ranges::copy_if(picked->second, std::back_inserter(parts), [&](std::size_t part) {
            return !isHidden(visual, model->materials[model->parts[part].material]);
        });
        if (parts.empty()) return {};
        // Like Gazebo and RViz, apply the mesh's unit and ignore its up axis.
        const double unit = model->file_unit_m.value_or(1.0);
        Eigen::Affine3d scaled = Eigen::Affine3d::Identity();
        scaled.linear() = (unit * visual.scale).asDiagonal();
        if (visual.center_submesh) {
            Eigen::AlignedBox3d box;
            for (const std::size_t part : picked->second)
                box.extend(model->parts[part].bounds.cast<double>());
            scaled = scaled * Eigen::Translation3d(-box.center());
        }
        ModelPlacement& placement = placements_.try_emplace(number, *model, scene_).first->second;
        const std::vector<std::size_t> placed =
            placement.place(object.name, visual.scene_from_visual * scaled, parts);
        for (std::size_t i = 0; i < parts.size(); ++i) {
            name_in_mesh_[placed[i]] = model->nodes[model->parts[parts[i]].node].name;
        }
        append(placed, visual, object);
        return {};
    }

    Status placeShape(const Visual& visual, SourceObject& object) {
        if (isHidden(visual, Material{})) return {};
        auto at = shapes_.find(visual.shape);
        if (at == shapes_.end()) {
            auto shape = std::make_unique<RawScene>(shapeScene(visual.shape));
            ModelPlacement placement(*shape, scene_);
            at = shapes_.emplace(visual.shape, Shape{std::move(shape), placement}).first;
        }
        if (Status fits = budget_.take(*at->second.model, where_); !fits) return fits;
        Eigen::Affine3d scaled = Eigen::Affine3d::Identity();
        scaled.linear() = visual.size.asDiagonal();
        append(at->second.placement.place(object.name, visual.scene_from_visual * scaled), visual,
               object);
        return {};
    }

    /// Adds parts to an object, with the visual's colour and opacity if it has them.
    void append(const std::vector<std::size_t>& parts, const Visual& visual, SourceObject& object) {
        object.parts.insert(object.parts.end(), parts.begin(), parts.end());
        if (!visual.color && visual.opacity >= 1.0F) return;
        for (const std::size_t part : parts) {
            scene_.parts[part].material = painted(scene_.parts[part].material, visual);
        }
    }

    /// The index of a copy of a material with the visual's colour and opacity; other visuals of the
    /// same mesh keep the original. Textured materials keep their texture and colour.
    std::uint32_t painted(std::uint32_t number, const Visual& visual) {
        Material material = scene_.materials[number];
        const bool textured = material.texture >= 0;
        if (textured && visual.opacity >= 1.0F) return number;
        if (visual.color && !textured) {
            material.base_color = visual.color->head<3>().cwiseMax(0.0F).cwiseMin(1.0F);
            material.opacity = (*visual.color)[3];
        }
        material.opacity = std::clamp(material.opacity * visual.opacity, 0.0F, 1.0F);
        const Eigen::Vector3f& color = material.base_color;
        const auto next = static_cast<std::uint32_t>(scene_.materials.size());
        const auto [at, is_new] =
            painted_.try_emplace({number, color[0], color[1], color[2], material.opacity}, next);
        if (is_new) scene_.materials.push_back(std::move(material));
        return at->second;
    }

    /// If the only object with meshes is as large as a room and has meshes of several names, it is
    /// a building with its furniture: its objects are then found by these names, as in the mesh
    /// file alone.
    void splitBuilding() {
        constexpr float kRoom_m = 4.0F;
        constexpr std::size_t kFewestNames = 4;
        const auto hasMeshes = [&](const SourceObject& object) {
            return std::ranges::any_of(
                object.parts, [&](std::size_t part) { return name_in_mesh_.contains(part); });
        };
        if (std::ranges::count_if(scene_.objects, hasMeshes) != 1) return;
        const SourceObject& building = *std::ranges::find_if(scene_.objects, hasMeshes);
        Eigen::AlignedBox3f box;
        std::map<std::string, int> nodes;
        for (const std::size_t part : building.parts) {
            box.extend(scene_.parts[part].bounds);
            const auto name = name_in_mesh_.find(part);
            if (name != name_in_mesh_.end()) nodes[name->second] = 0;
        }
        if (box.sizes().head<2>().minCoeff() < kRoom_m || nodes.size() < kFewestNames) return;
        for (auto& [name, node] : nodes) {
            node = static_cast<int>(scene_.nodes.size());
            scene_.nodes.push_back({name, 0, 0});
            ++scene_.nodes.front().children;
        }
        for (const std::size_t part : building.parts) {
            const auto name = name_in_mesh_.find(part);
            if (name != name_in_mesh_.end()) scene_.parts[part].node = nodes[name->second];
        }
        // The parts of every other object stay together, at its first node.
        for (const SourceObject& other : scene_.objects) {
            if (&other == &building) continue;
            const int node = scene_.parts[other.parts.front()].node;
            for (const std::size_t part : other.parts) scene_.parts[part].node = node;
        }
        scene_.objects.clear();
    }

    static tl::unexpected<Error> cancelled() {
        return fail(ErrorCode::Cancelled, "import was cancelled");
    }

    Result<RawScene> finish() {
        const auto say = [&](std::vector<std::string> names, const char* one, const char* many) {
            if (names.empty()) return;
            for (std::string& name : names) name = cleanText(name);
            std::sort(names.begin(), names.end());
            names.erase(std::unique(names.begin(), names.end()), names.end());
            scene_.warnings.push_back(counted(names.size(), one, many) + ": " + listOf(names));
        };
        std::vector<std::string> fuel;
        std::vector<std::string> web;
        std::erase_if(missing_, [&](const std::string& uri) {
            if (!isWebAddress(uri)) return false;
            const auto address = fuelUriOf(uri);
            // The program downloads whole models.
            if (address && !address->file.empty()) {
                fuel.push_back(uri.substr(0, uri.rfind("/files/")));
            } else {
                (address ? fuel : web).push_back(uri);
            }
            return true;
        });
        say(fuel,
            "model is on Gazebo Fuel and is left out; download it with \"gz fuel download -u "
            "URI\" and pass --models ~/.gz/fuel",
            "models are on Gazebo Fuel and are left out; download each with \"gz fuel download -u "
            "URI\" and pass --models ~/.gz/fuel");
        say(web,
            "model or mesh is on the web and is left out; download it and write its path in "
            "place of the address",
            "models or meshes are on the web and are left out; download them and write their "
            "paths in place of the addresses");
        say(missing_,
            "model or mesh was not found and is left out; give the folder around it with --models",
            "models or meshes were not found and are left out; give the folder around them with "
            "--models");
        say(absent_,
            "mesh is not in the folder of its model and is left out; copy or download the whole "
            "model",
            "meshes are not in the folders of their models and are left out; copy or download the "
            "whole models");
        say(other_case_,
            "mesh is left out, since its file's name differs in upper and lower case; rename the "
            "file",
            "meshes are left out, since their files' names differ in upper and lower case; rename "
            "the files");
        say(incomplete_, "object lacks a mesh", "objects lack a mesh");
        say(unreadable_, "mesh cannot be read and is left out; export it again",
            "meshes cannot be read and are left out; export them again");
        say(unmatched_, "submesh is not in its mesh and is left out; correct its name",
            "submeshes are not in their meshes and are left out; correct their names");
        remarks_.addTo(scene_);
        for (const auto& [shape, count] : unknown_shapes_) {
            scene_.warnings.push_back(counted(count, "visual is", "visuals are") +
                                      " left out, since <" + shape +
                                      "> is not supported; replace it by a mesh");
        }
        if (scene_.objects.empty()) {
            std::string message = "no link has a visual that can be drawn, so there is no scene";
            for (const std::string& warning : scene_.warnings) message += "; " + warning;
            return fail(ErrorCode::BadInput, message, where_);
        }
        splitBuilding();
        return std::move(scene_);
    }

    struct Shape {
        std::unique_ptr<RawScene> model;  // its address must not change: `placement` refers to it
        ModelPlacement placement;
    };

    const ModelPath& files_;
    std::string where_;
    JobContext job_;
    RawScene scene_;
    ModelLibrary library_;
    ModelRemarks remarks_;
    TriangleBudget budget_;
    std::map<std::size_t, ModelPlacement> placements_;  // by index in the library
    std::map<Visual::Shape, Shape> shapes_;
    std::map<std::size_t, Submeshes> submeshes_;
    /// Indices of materials by the original material's index, colour and opacity.
    std::map<std::tuple<std::uint32_t, float, float, float, float>, std::uint32_t> painted_;
    std::map<std::size_t, std::string> name_in_mesh_;  // the node's name in the file, by part
    std::vector<std::string> missing_;                 // models and meshes, by address
    std::vector<std::string> absent_;                  // meshes that a model's folder lacks
    std::vector<std::string> other_case_;  // meshes found only by ignoring upper and lower case
    std::vector<std::string> incomplete_;  // objects with such meshes
    UnknownShapes unknown_shapes_;
    std::vector<std::string> unreadable_;
    std::vector<std::string> unmatched_;
};

}  // namespace

std::optional<fs::path> ModelPath::find(const fs::path& folder, const std::string& uri) const {
    if (const auto fuel = fuelUriOf(uri)) {
        const auto downloaded = findFuelModel(files_, *fuel);
        return downloaded ? files_.find(*downloaded, fuel->file) : std::nullopt;
    }
    std::string name = percentDecoded(uri);
    const bool package = takeScheme(name, "package://");
    const bool model = !package && takeScheme(name, "model://");
    if (!package && !model) takeScheme(name, "file://");
    if (name.find("://") != std::string::npos) return std::nullopt;
    if (!package && !model) {
        if (auto found = files_.find(folder, name)) return found;
    }
    for (const fs::path& root : files_.folders()) {
        if (auto found = files_.find(root, name)) return found;
    }
    if (!package && !model) return std::nullopt;
    // The scene may be inside the model or package that it names: search the folders above it.
    const std::size_t slash = std::min(name.find('/'), name.size());
    const std::string within = name.substr(std::min(slash + 1, name.size()));
    const std::string owner = name.substr(0, slash);
    for (const fs::path& around : foldersAround(folder)) {
        if (auto found = files_.find(around, name)) return found;
        // A package's folder may have another name; package.xml contains the package's name.
        if (!package || within.empty()) continue;
        const auto xml = files_.find(around, "package.xml");
        const std::string called = xml ? nameOf(*xml) : std::string();
        if (!called.empty() && called != owner) return std::nullopt;
        if (auto found = files_.find(around, within)) return found;
        if (xml) return std::nullopt;
    }
    return std::nullopt;
}

std::vector<fs::path> ModelPath::rootsFor(const fs::path& folder) const {
    std::vector<fs::path> roots = files_.folders();
    for (const fs::path& around : foldersAround(folder)) {
        if (files_.reaches(around)) roots.push_back(around);
    }
    return roots;
}

ModelPath::Absence ModelPath::absenceOf(const fs::path& folder, const std::string& uri) const {
    if (isWebAddress(uri)) return Absence::NoFolder;
    std::string name = percentDecoded(uri);
    for (const char* scheme : {"package://", "model://", "file://"}) takeScheme(name, scheme);
    Absence absence = Absence::NoFolder;
    const fs::path relative = fs::path(name).relative_path();
    for (const fs::path& root : rootsFor(folder)) {
        const fs::path around = absoluteNormal(root / relative.parent_path());
        if (!relative.has_parent_path() || !files_.reaches(around)) continue;
        absence = Absence::NoFile;
        const Result<std::vector<std::string>> names = files_.namesIn(around);
        if (!names) continue;
        const std::string wanted = inSmallLetters(relative.filename().string());
        if (std::ranges::any_of(*names,
                                [&](const auto& one) { return inSmallLetters(one) == wanted; })) {
            return Absence::OtherCase;
        }
    }
    return absence;
}

const std::string& ModelPath::nameOf(const fs::path& config) const {
    const auto [at, is_new] = names_.try_emplace(config);
    if (is_new) at->second = nameIn(config);
    return at->second;
}

std::optional<fs::path> ModelPath::findModel(const fs::path& folder, const std::string& uri) const {
    std::string name = uri;
    while (name.ends_with('/')) name.pop_back();
    if (const auto fuel = fuelUriOf(name); fuel && fuel->file.empty()) {
        const auto model = findFuelModel(files_, *fuel);
        if (!model) return std::nullopt;
        if (const auto config = files_.find(*model, "model.config")) {
            if (auto found = files_.find(*model, nameOf(*config))) return found;
        }
        return files_.find(*model, "model.sdf");
    }
    const std::string ending = lowerExtension(name);
    if (ending == ".sdf" || ending == ".urdf" || ending == ".world") return find(folder, name);
    if (const auto config = find(folder, name + "/model.config")) {
        if (auto found = files_.find(config->parent_path(), nameOf(*config))) return found;
    }
    return find(folder, name + "/model.sdf");
}

std::vector<fs::path> foldersOfWorld(const fs::path& scene, const ImportOptions& options) {
    const fs::path own = absoluteNormal(scene).parent_path();
    std::vector<fs::path> absolute;
    for (const fs::path& folder : options.model_folders) {
        absolute.push_back(absoluteNormal(folder));
    }
    std::vector<fs::path> folders =
        foldersFor(own / scene.filename(), absolute, {"models", "meshes", "media", "materials"});
    folders.insert(folders.begin(), own);
    if (hasFile(own / "model.config")) folders.push_back(own.parent_path());
    for (const fs::path& around : foldersAround(own)) {
        if (!hasFile(around / "package.xml")) continue;
        folders.push_back(around);
        break;
    }
    return folders;
}

Result<RawScene> sceneOfLinks(const std::vector<LinkObject>& links, const ModelPath& files,
                              const OmittedParts& left_out, const std::string& where,
                              const JobContext& job) {
    return SceneOfLinks(files, where, job).build(links, left_out);
}

}  // namespace dollytrack::gazebo
