#include "engine/io/gazebo/visuals.h"

#include "engine/core/clean_text.h"
#include "engine/core/disjoint_sets.h"
#include "engine/core/object_names.h"
#include "engine/core/text_lists.h"
#include "engine/io/datasets/model_library.h"
#include "engine/io/gazebo/fuel_uri.h"
#include "engine/io/gazebo/shape_scene.h"
#include "engine/io/raw_scene/model_placement.h"
#include "engine/scene/labels.h"

#include <algorithm>
#include <iterator>
#include <memory>
#include <tuple>
#include <utility>

namespace dollytrack::gazebo {
namespace {

namespace fs = std::filesystem;

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
        left_out_ = left_out;
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
                    leaveOut(visual);
                }
            }
        }
        if (Status read = library_.read(job_); !read) return tl::unexpected(read.error());
        for (const auto& [name, number] : found) {
            RawScene* model = number ? library_.model(*number) : nullptr;
            if (model != nullptr) lookUpTexturesAroundMeshes(files_, *model);
        }
        for (const LinkObject& link : links) {
            if (job_.cancelled()) return cancelled();
            SourceObject object;
            std::size_t missing = 0;
            object.name = names_.next(link.name.empty() ? "link" : link.name);
            for (const Visual& visual : link.visuals) {
                const auto model = wanted.find(&visual);
                if (visual.shape == Visual::Shape::Mesh && model == wanted.end()) {
                    ++missing;
                    continue;
                }
                Status placed = visual.shape == Visual::Shape::Mesh
                                    ? placeMesh(visual, model->second, object)
                                    : placeShape(visual, object);
                if (!placed) return tl::unexpected(placed.error());
            }
            separateGround(link, object);
            noteMissing(link, missing, object);
            if (object.parts.empty()) continue;
            if (link.model_number >= 0) {
                model_of_[scene_.objects.size()] = Model{link.model_number, link.model};
            }
            scene_.objects.push_back(std::move(object));
        }
        return finish();
    }

  private:
    void leaveOut(const Visual& visual) {
        switch (files_.absenceOf(visual.folder, visual.uri)) {
            case ModelPath::Absence::NoFolder:
                left_out_.models.push_back(visual.uri);
                break;
            case ModelPath::Absence::NoFile:
                absent_.push_back(visual.uri);
                break;
            case ModelPath::Absence::OtherCase:
                other_case_.push_back(visual.uri);
                break;
        }
    }

    void noteMissing(const LinkObject& link, std::size_t missing, const SourceObject& object) {
        if (missing == 0) return;
        const std::string name = link.name.empty() ? "link" : link.name;
        if (object.parts.empty()) {
            meshless_.push_back(name);
        } else {
            incomplete_.push_back(name + " (" + std::to_string(missing) + " of " +
                                  std::to_string(link.visuals.size()) + ")");
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

    /// Adds parts to an object, with the visual's colour, texture and opacity if it has them.
    void append(const std::vector<std::size_t>& parts, const Visual& visual, SourceObject& object) {
        object.parts.insert(object.parts.end(), parts.begin(), parts.end());
        if (!visual.color && visual.texture.empty() && visual.opacity >= 1.0F) return;
        for (const std::size_t part : parts) {
            scene_.parts[part].material = painted(scene_.parts[part].material, visual);
            if (visual.texture.empty() || visual.texture_scale.isOnes()) continue;
            for (Eigen::Vector2f& uv : scene_.parts[part].uvs) {
                uv = 0.5F + (uv.array() - 0.5F) / visual.texture_scale.array();
            }
        }
    }

    /// The index of the texture in this file.
    int textureOf(const fs::path& file) {
        const auto [at, is_new] =
            textures_.try_emplace(file, static_cast<int>(scene_.textures.size()));
        if (is_new) {
            TextureRequest request;
            request.name = file.filename().string();
            request.folder = file.parent_path();
            request.only_there = true;
            scene_.textures.push_back(std::move(request));
        }
        return at->second;
    }

    /// The index of a copy of a material with the visual's colour, texture and opacity; other
    /// visuals of the same mesh keep the original. Materials that the mesh has textured keep their
    /// colour, and their texture unless the visual has one.
    std::uint32_t painted(std::uint32_t number, const Visual& visual) {
        Material material = scene_.materials[number];
        const bool textured = material.texture >= 0 && visual.texture.empty();
        if (textured && visual.opacity >= 1.0F) return number;
        if (!visual.texture.empty()) {
            material = Material{};
            material.name = cleanText(visual.texture.stem().string());
            material.base_color.setOnes();
            material.texture = textureOf(visual.texture);
        }
        if (visual.color && !textured) {
            material.base_color = visual.color->head<3>().cwiseMax(0.0F).cwiseMin(1.0F);
            material.opacity = (*visual.color)[3];
        }
        material.opacity = std::clamp(material.opacity * visual.opacity, 0.0F, 1.0F);
        const Eigen::Vector3f& color = material.base_color;
        const auto next = static_cast<std::uint32_t>(scene_.materials.size());
        const auto [at, is_new] = painted_.try_emplace(
            {number, color[0], color[1], color[2], material.opacity, material.texture}, next);
        if (is_new) scene_.materials.push_back(std::move(material));
        return at->second;
    }

    /// If the only object with meshes is as large as a room, it is a building with its furniture:
    /// its objects are then found by the names of its meshes, as in the mesh file alone.
    void splitBuilding() {
        constexpr float kRoom_m = 4.0F;
        constexpr float kRoomHeight_m = 1.0F;
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
        if (box.sizes().head<2>().minCoeff() < kRoom_m || box.sizes().z() < kRoomHeight_m) return;
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

    /// Makes a ground plane an object of its own: a link that contains it besides walls would be
    /// as wide as the plane, and no building.
    void separateGround(const LinkObject& link, SourceObject& object) {
        constexpr float kWide_m = 40.0F;
        constexpr float kThin_m = 0.01F;
        const bool has_plane = std::ranges::any_of(link.visuals, [](const Visual& visual) {
            return visual.shape == Visual::Shape::Plane;
        });
        if (!has_plane || link.visuals.size() < 2) return;
        SourceObject ground;
        const auto is_ground = [&](std::size_t part) {
            const Eigen::Vector3f size = scene_.parts[part].bounds.sizes();
            return size.z() < kThin_m && size.head<2>().minCoeff() > kWide_m;
        };
        std::ranges::copy_if(object.parts, std::back_inserter(ground.parts), is_ground);
        if (ground.parts.empty() || ground.parts.size() == object.parts.size()) return;
        std::erase_if(object.parts, is_ground);
        ground.name = names_.next(object.name + " ground");
        const int node = static_cast<int>(scene_.nodes.size());
        scene_.nodes.push_back({ground.name, 0, 0});
        ++scene_.nodes.front().children;
        for (const std::size_t part : ground.parts) scene_.parts[part].node = node;
        ground.nyu40 = kNyuFloor;
        ground.structure = true;
        scene_.objects.push_back(std::move(ground));
    }

    /// Joins the links of a model into one object if they touch each other and the model is no
    /// larger than furniture, such as the top and the pedestal of a table.
    void joinModels() {
        constexpr std::size_t kMostParts = 12;
        constexpr float kLargest_m = 3.5F;  // diagonal
        constexpr float kGap_m = 0.02F;
        if (scene_.objects.empty()) return;
        std::map<int, std::vector<std::size_t>> objects_of;
        for (const auto& [object, model] : model_of_) objects_of[model.number].push_back(object);
        std::vector<bool> joined(scene_.objects.size(), false);
        for (const auto& [model, objects] : objects_of) {
            const std::string& name = model_of_.at(objects.front()).name;
            if (objects.size() < 2 || objects.size() > kMostParts || name.empty()) continue;
            std::vector<Eigen::AlignedBox3f> boxes;
            Eigen::AlignedBox3f whole;
            for (const std::size_t object : objects) {
                Eigen::AlignedBox3f& box = boxes.emplace_back();
                for (const std::size_t part : scene_.objects[object].parts) {
                    box.extend(scene_.parts[part].bounds);
                }
                whole.extend(box);
            }
            if (whole.diagonal().norm() > kLargest_m) continue;
            DisjointSets<> sets(boxes.size());
            for (std::size_t i = 0; i < boxes.size(); ++i) {
                for (std::size_t j = 0; j < i; ++j) {
                    if (boxes[i].exteriorDistance(boxes[j]) <= kGap_m) sets.join(i, j);
                }
            }
            bool connected = true;
            for (std::size_t i = 0; i < boxes.size(); ++i) {
                connected = connected && sets.find(i) == 0;
            }
            if (!connected) continue;
            SourceObject& first = scene_.objects[objects.front()];
            first.name = names_.next(name);
            for (std::size_t i = 1; i < objects.size(); ++i) {
                const std::vector<std::size_t>& parts = scene_.objects[objects[i]].parts;
                first.parts.insert(first.parts.end(), parts.begin(), parts.end());
                joined[objects[i]] = true;
            }
        }
        std::vector<SourceObject> rest;
        for (std::size_t i = 0; i < joined.size(); ++i) {
            if (!joined[i]) rest.push_back(std::move(scene_.objects[i]));
        }
        scene_.objects = std::move(rest);
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
        std::erase_if(left_out_.models, [&](const std::string& uri) {
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
        say(left_out_.models,
            "model or mesh was not found and is left out; give the folder around it with --models",
            "models or meshes were not found and are left out; give the folder around them with "
            "--models");
        say(left_out_.includes, "name of <include>s that are left out",
            "names of <include>s that are left out");
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
        say(meshless_, "object lacks all of its meshes and is left out",
            "objects lack all of their meshes and are left out");
        say(incomplete_, "object lacks some of its meshes", "objects lack some of their meshes");
        say(left_out_.scripts,
            "material is in no script that was found, so its colour and texture are missing; give "
            "the folder around the models or scripts with --models",
            "materials are in no script that was found, so their colours and textures are missing; "
            "give the folder around the models or scripts with --models");
        say(unreadable_, "mesh cannot be read and is left out; export it again",
            "meshes cannot be read and are left out; export them again");
        say(unmatched_, "submesh is not in its mesh and is left out; correct its name",
            "submeshes are not in their meshes and are left out; correct their names");
        remarks_.addTo(scene_);
        for (const auto& [shape, count] : left_out_.shapes) {
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
        joinModels();
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
    /// Indices of materials by the original material's index, colour, opacity and texture.
    std::map<std::tuple<std::uint32_t, float, float, float, float, int>, std::uint32_t> painted_;
    struct Model {
        int number = 0;
        std::string name;
    };
    std::map<std::size_t, Model> model_of_;  // by index of the object
    ObjectNames names_;
    std::map<fs::path, int> textures_;                 // of visuals: their indices by file
    std::map<std::size_t, std::string> name_in_mesh_;  // the node's name in the file, by part
    OmittedParts left_out_;                            // models include meshes that were not found
    std::vector<std::string> absent_;                  // meshes that a model's folder lacks
    std::vector<std::string> other_case_;  // meshes found only by ignoring upper and lower case
    std::vector<std::string> meshless_;    // objects with only such meshes
    std::vector<std::string> incomplete_;  // objects with such and other meshes
    std::vector<std::string> unreadable_;
    std::vector<std::string> unmatched_;
};

}  // namespace

Result<RawScene> sceneOfLinks(const std::vector<LinkObject>& links, const ModelPath& files,
                              const OmittedParts& left_out, const std::string& where,
                              const JobContext& job) {
    return SceneOfLinks(files, where, job).build(links, left_out);
}

}  // namespace dollytrack::gazebo
