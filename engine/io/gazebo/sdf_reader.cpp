#include "engine/io/gazebo/sdf_reader.h"

#include "engine/core/clean_text.h"
#include "engine/io/gazebo/link_xml.h"
#include "engine/io/gazebo/material_script.h"
#include "engine/io/gazebo/sdf_frames.h"
#include "engine/io/gazebo/sdf_material.h"
#include "engine/io/gazebo/sdf_population.h"
#include "engine/io/gazebo/sdf_shape.h"
#include "engine/io/gazebo/standard_models.h"
#include "engine/io/gazebo/visuals.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dollytrack::gazebo {
namespace {

namespace fs = std::filesystem;

constexpr int kDeepestModel = 16;
constexpr std::size_t kMostIncludes = 20'000;
constexpr std::size_t kMostFrames = 1'000'000;
constexpr std::uint64_t kMostExpandedBytes = std::uint64_t{1} << 30U;

/// Elements to which poses can be relative. A name refers to the first kind that has it.
constexpr std::array<std::string_view, 5> kKinds = {"link", "frame", "model", "include", "joint"};

class SdfReader {
  public:
    SdfReader(const ModelPath& files, const JobContext& job) : files_(files), job_(job) {}

    /// Reads a file. `xml` is the file at `path` and must outlive this object.
    Status read(const pugi::xml_node& sdf, const fs::path& path, const XmlFile& xml) {
        xml_bytes_ = expanded_bytes_ = xml.bytes;
        scene_.path = path;
        scene_.xml = &xml;
        const pugi::xml_node world = sdf.child("world");
        const pugi::xml_node model = sdf.child("model");
        if (!world && !model) {
            return wrongAt("the file has neither a <world> nor a <model>; name a world or model",
                           scene_, sdf);
        }
        scene_.node = world ? world : sdf;
        if (Status opened = openChildren(scene_, !world); !opened) return opened;
        if (Status placed = placeLinks(scene_, Eigen::Affine3d::Identity()); !placed) return placed;
        saved_from_loaded_.assign(links_.size(), Eigen::Affine3d::Identity());
        const Eigen::Affine3d origin = Eigen::Affine3d::Identity();
        if (Status saved = applySavedState(scene_, world.child("state"), origin); !saved) {
            return saved;
        }
        for (std::size_t i = 0; i < links_.size(); ++i) {
            for (Visual& visual : links_[i].visuals) {
                visual.scene_from_visual = saved_from_loaded_[i] * visual.scene_from_visual;
            }
        }
        return joinLinks(scene_);
    }

    /// The objects: one per link, or per group of links connected by joints.
    [[nodiscard]] std::vector<LinkObject> objects() const {
        std::map<std::size_t, std::size_t> number;  // index in `objects` by first link
        std::vector<std::size_t> first = first_;
        std::map<const Scope*, std::size_t> objects_in;
        std::vector<LinkObject> objects;
        std::vector<const Scope*> scopes;
        for (std::size_t i = 0; i < links_.size(); ++i) {
            const std::size_t root = first[i] = first[first[i]];  // final, since it precedes i
            if (links_[i].visuals.empty()) continue;
            const auto [at, is_new] = number.try_emplace(root, objects.size());
            if (is_new) {
                objects.push_back({links_[root].name, {}});
                scopes.push_back(scope_of_link_[root]);
                ++objects_in[scopes.back()];
            }
            std::vector<Visual>& into = objects[at->second].visuals;
            into.insert(into.end(), links_[i].visuals.begin(), links_[i].visuals.end());
        }
        std::map<std::string, std::set<std::string>> models_with;  // by the link's name
        std::map<const Scope*, int> model_numbers;
        for (std::size_t i = 0; i < objects.size(); ++i) {
            models_with[objects[i].name].insert(scopes[i]->name);
        }
        for (std::size_t i = 0; i < objects.size(); ++i) {
            std::string& name = objects[i].name;
            const std::string& model = scopes[i]->name;
            objects[i].model = model;
            objects[i].model_number = model_numbers.try_emplace(scopes[i], i).first->second;
            const bool says_little = isPlainLinkName(name) || models_with[name].size() > 1;
            if (objects_in[scopes[i]] == 1) {
                name = model;
            } else if (!model.empty() && says_little) {
                name = fmt::format("{}::{}", model, name);
            }
        }
        return objects;
    }

    [[nodiscard]] const OmittedParts& leftOut() const { return left_out_; }

  private:
    static std::string nameOf(const pugi::xml_node& node) {
        return cleanText(node.attribute("name").value());
    }

    /// The name by which others refer to a frame; empty for an include that was not found.
    static std::string nameInScope(const Frame& frame) {
        if (frame.copy) return frame.copy->name;
        if (!frame.is("include")) return frame.node.attribute("name").value();
        std::string name = textOf(frame.node.child("name"));
        if (name.empty() && frame.model) name = frame.model->node.attribute("name").value();
        return name;
    }

    Status addFrame(Scope& scope, const pugi::xml_node& element) {
        if (++frames_ > kMostFrames) {
            return wrongAt(
                "the world has more than 1,000,000 links, joints, frames and models; "
                "leave some out",
                scope, element);
        }
        scope.frames.emplace_back(element);
        return {};
    }

    /// Adds the models of a <population>, or a warning if they have no fixed positions.
    Status addPopulation(Scope& world, const pugi::xml_node& element) {
        const tl::expected<Population, std::string> read = readPopulation(element, kMostIncludes);
        if (!read) {
            left_out_.doubts.push_back(fmt::format(
                "{}: the population '{}' is left out, since {}",
                world.xml->placeOf(world.path.filename(), element), nameOf(element), read.error()));
            return {};
        }
        for (const Frame::Copy& copy : read->copies) {
            if (Status added = addFrame(world, read->model); !added) return added;
            world.frames.back().copy = copy;
        }
        return {};
    }

    /// Finds the frames of a world or model and opens its models. `first_only`: only the first
    /// model, for a file without a world.
    Status openChildren(Scope& scope, bool first_only = false) {
        if (scope.depth > kDeepestModel) {
            return wrongAt("models are nested more than 16 levels deep; leave some out", scope,
                           scope.node);
        }
        for (const pugi::xml_node& child : scope.node.children()) {
            const std::string_view kind = child.name();
            if (kind == "population" && scope.parent == nullptr && !first_only) {
                if (Status added = addPopulation(scope, child); !added) return added;
                continue;
            }
            if (first_only ? kind != "model"
                           : std::find(kKinds.begin(), kKinds.end(), kind) == kKinds.end()) {
                continue;
            }
            if (Status added = addFrame(scope, child); !added) return added;
            if (first_only) break;
        }
        const auto isModel = [](const Frame& frame) {
            return frame.is("model") || frame.is("include");
        };
        const auto models = std::count_if(scope.frames.begin(), scope.frames.end(), isModel);
        // A model that only wraps another model passes its name on to it.
        const bool wraps = models == 1 && !scope.node.child("link");
        for (Frame& frame : scope.frames) {
            if (!isModel(frame)) continue;
            if (job_.cancelled()) return fail(ErrorCode::Cancelled, "import was cancelled");
            Status opened = frame.is("model")
                                ? openModel(frame.node, scope.path, *scope.xml, scope, frame)
                                : openInclude(scope, frame);
            if (!opened) return opened;
            if (!frame.model) continue;
            const std::string given = cleanText(textOf(frame.node.child("name")));
            if (frame.is("include") && !given.empty()) frame.model->name = given;
            if (frame.copy) frame.model->name = cleanText(frame.copy->name);
            const bool inherits = wraps || frame.model->name.empty();
            if (inherits && !scope.name.empty()) frame.model->name = scope.name;
            if (Status inner = openChildren(*frame.model); !inner) return inner;
        }
        // Before SDF 1.7 frames of different kinds could share a name; links have precedence.
        for (const std::string_view kind : kKinds) {
            for (std::size_t i = 0; i < scope.frames.size(); ++i) {
                const Frame& frame = scope.frames[i];
                if (!frame.is(kind)) continue;
                std::string name = nameInScope(frame);
                if (!name.empty()) scope.by_name.try_emplace(std::move(name), i);
            }
        }
        return {};
    }

    static Status openModel(const pugi::xml_node& model, const fs::path& path, const XmlFile& xml,
                            const Scope& around, Frame& frame) {
        frame.model = std::make_unique<Scope>();
        frame.model->node = model;
        frame.model->path = path;
        frame.model->xml = &xml;
        frame.model->name = nameOf(model);
        frame.model->parent = &around;
        frame.model->depth = around.depth + 1;
        return {};
    }

    Status openInclude(const Scope& scope, Frame& frame) {
        const std::string uri = textOf(frame.node.child("uri"));
        if (++includes_ > kMostIncludes) {
            return wrongAt("the world includes more than 20,000 models; leave some out", scope,
                           frame.node);
        }
        const fs::path folder = scope.path.parent_path();
        const auto [found, is_new] = found_models_.try_emplace({folder, uri});
        if (is_new) found->second = files_.findModel(folder, uri);
        const std::optional<fs::path>& file = found->second;
        const std::string_view standard = file ? std::string_view() : standardModel(uri);
        if (!file && standard.empty()) {
            left_out_.models.push_back(cleanText(uri));
            left_out_.includes.push_back(nameOfInclude(frame.node));
            return {};
        }
        const fs::path path = file.value_or(fs::path(uri));
        for (const Scope* around = &scope; around != nullptr; around = around->parent) {
            if (around->path != path) continue;
            return wrongAt(
                "the model '" + cleanText(uri) +
                    "' includes itself, directly or through other models; remove that <include>",
                scope, frame.node);
        }
        auto at = documents_.find(path);
        if (at == documents_.end()) {
            const std::uint64_t most = kMostXmlBytes - xml_bytes_;
            Result<XmlFile> read = file ? readXml(path, most) : parseXml(standard, path);
            if (!read) return tl::unexpected(read.error());
            xml_bytes_ += read->bytes;
            at = documents_.emplace(path, std::make_unique<XmlFile>(std::move(*read))).first;
        }
        expanded_bytes_ += at->second->bytes;
        if (expanded_bytes_ > kMostExpandedBytes) {
            return wrongAt(
                "the included models are more than 1 GiB of XML in total, repeated includes "
                "counted each time; leave some out",
                scope, frame.node);
        }
        const pugi::xml_node sdf = at->second->document.child("sdf");
        const pugi::xml_node model = sdf.child("model");
        if (model) return openModel(model, path, *at->second, scope, frame);
        if (sdf.child("light") || sdf.child("actor")) return {};  // such as model://sun
        return fail(ErrorCode::BadInput,
                    "the included file has no <model> element; include a file that has one",
                    path.string());
    }

    /// Calls `use` for each link of a model and of the models in it.
    static void forEachLink(const Frame& frame, const std::function<void(std::size_t)>& use) {
        if (frame.link) use(*frame.link);
        if (!frame.model) return;
        for (const Frame& inner : frame.model->frames) forEachLink(inner, use);
    }

    /// Reads the saved world poses of models and links, which Gazebo Classic applies after it has
    /// loaded a world; what has none stays where it is in its model. `scene_from_scope`: as loaded.
    Status applySavedState(Scope& scope, const pugi::xml_node& saved,
                           const Eigen::Affine3d& scene_from_scope) {
        for (const pugi::xml_node& entry : saved.children()) {
            const bool is_model = entry.name() == std::string_view("model");
            if (!is_model && entry.name() != std::string_view("link")) continue;
            const std::string name = entry.attribute("name").value();
            const auto frame =
                std::find_if(scope.frames.begin(), scope.frames.end(), [&](const Frame& candidate) {
                    return (is_model ? candidate.model != nullptr : candidate.link.has_value()) &&
                           nameInScope(candidate) == name;
                });
            if (frame == scope.frames.end()) continue;
            const Eigen::Affine3d loaded = scene_from_scope * frame->scope_from_frame;
            if (entry.child("pose")) {
                const auto pose = poseIn(entry, "the state of '" + cleanText(name) + "'", scene_);
                if (!pose) return tl::unexpected(pose.error());
                forEachLink(*frame, [&](std::size_t link) {
                    saved_from_loaded_[link] = *pose * loaded.inverse();
                });
            }
            if (!is_model) continue;
            const auto scale = vectorOf(entry.child_value("scale"));
            if (scale && *scale != Eigen::Vector3d::Ones()) {
                left_out_.doubts.push_back(fmt::format(
                    "{}: the saved scale of the model '{}' is ignored; scale its visuals instead",
                    scene_.xml->placeOf(scene_.path.filename(), entry), cleanText(name)));
            }
            if (Status inner = applySavedState(*frame->model, entry, loaded); !inner) return inner;
        }
        return {};
    }

    Status placeLinks(Scope& scope, const Eigen::Affine3d& scene_from_scope) {
        for (Frame& frame : scope.frames) {
            if (!frame.is("link")) continue;
            if (job_.cancelled()) return fail(ErrorCode::Cancelled, "import was cancelled");
            const auto pose = poseOf(scope, frame);
            if (!pose) return tl::unexpected(pose.error());
            LinkObject object{nameOf(frame.node), {}};
            for (const pugi::xml_node& visual : frame.node.children("visual")) {
                if (++visuals_ > kMostVisuals) {
                    return wrongAt("the world has more than 100,000 visuals; leave some out", scope,
                                   visual);
                }
                Status read = addVisual(visual, scope, scene_from_scope, *pose, object);
                if (!read) return read;
            }
            frame.link = links_.size();
            links_.push_back(std::move(object));
            scope_of_link_.push_back(&scope);
            first_.push_back(*frame.link);
        }
        for (Frame& frame : scope.frames) {
            if (!frame.model) continue;
            const auto pose = poseOf(scope, frame);
            if (!pose) return tl::unexpected(pose.error());
            if (Status read = placeLinks(*frame.model, scene_from_scope * *pose); !read) {
                return read;
            }
        }
        return {};
    }

    /// The link that a joint refers to, directly or by a frame that is attached to it.
    static std::optional<std::size_t> linkOf(Scope& scope, std::string name) {
        constexpr int kMostSteps = 16;
        Scope* around = &scope;
        for (int step = 0; step < kMostSteps; ++step) {
            const auto steps = locate(*around, name);
            if (steps.empty()) return std::nullopt;
            const auto [inner, frame] = steps.back();
            if (frame == nullptr) return std::nullopt;
            if (frame->link) return frame->link;
            if (!frame->is("frame")) return std::nullopt;
            name = frame->node.attribute("attached_to").value();
            around = inner;
        }
        return std::nullopt;
    }

    std::size_t firstOf(std::size_t link) {
        while (first_[link] != link) link = first_[link] = first_[first_[link]];
        return link;
    }

    /// Adds a warning for each end of a joint that names a missing link.
    void doubtJoint(Scope& scope, const Frame& joint) {
        for (const char* end : {"parent", "child"}) {
            const std::string name = textOf(joint.node.child(end));
            if (name == "world" || !locate(scope, name).empty()) continue;
            left_out_.doubts.push_back(fmt::format(
                "{}: the joint '{}' names the {} link '{}', which does not exist; the joint is "
                "left out",
                scope.xml->placeOf(scope.path.filename(), joint.node), nameOf(joint.node), end,
                cleanText(name)));
        }
    }

    void join(std::size_t one, std::size_t other) {
        const std::size_t a = firstOf(one);
        const std::size_t b = firstOf(other);
        first_[std::max(a, b)] = std::min(a, b);
    }

    /// Joins the links of a model that Gazebo's model editor has named link_0, link_1 and so on:
    /// they are parts of one thing. A model of many such links may be a whole room.
    void joinNamelessLinks(const Scope& scope) {
        constexpr std::size_t kMostParts = 12;
        std::vector<std::size_t> links;
        for (const Frame& frame : scope.frames) {
            if (!frame.link) continue;
            if (!isPlainLinkName(links_[*frame.link].name)) return;
            links.push_back(*frame.link);
        }
        if (scope.name.empty() || links.size() > kMostParts) return;
        for (const std::size_t link : links) join(links.front(), link);
    }

    /// Joins links that are connected by joints, or have generic names, into one object, named
    /// after the first.
    Status joinLinks(Scope& scope) {
        joinNamelessLinks(scope);
        for (Frame& frame : scope.frames) {
            if (frame.model) {
                if (Status joined = joinLinks(*frame.model); !joined) return joined;
            }
            if (!frame.is("joint")) continue;
            if (job_.cancelled()) return fail(ErrorCode::Cancelled, "import was cancelled");
            doubtJoint(scope, frame);
            const auto parent = linkOf(scope, textOf(frame.node.child("parent")));
            const auto child = linkOf(scope, textOf(frame.node.child("child")));
            if (!parent || !child) continue;
            join(*parent, *child);
        }
        return {};
    }

    Status addVisual(const pugi::xml_node& node, Scope& scope,
                     const Eigen::Affine3d& scene_from_scope, const Eigen::Affine3d& link,
                     LinkObject& object) {
        const auto pose = poseIn(node, "a visual of '" + object.name + "'", scope);
        if (!pose) return tl::unexpected(pose.error());
        Eigen::Affine3d base = link;
        const std::string from = node.child("pose").attribute("relative_to").value();
        if (!from.empty()) {
            const auto named = poseOfName(scope, from, node);
            if (!named) return tl::unexpected(named.error());
            base = *named;
        }
        Visual visual;
        visual.folder = scope.path.parent_path();
        visual.scene_from_visual = scene_from_scope * base * *pose;
        visual.color = visualColor(node);
        visual.opacity = visualOpacity(node);
        if (!(visual.opacity > 0.0F)) return {};
        if (const std::string name = scriptName(node); !name.empty()) {
            const pugi::xml_node script = node.child("material").child("script");
            if (!scripts_.apply(script, visual.folder, visual)) {
                left_out_.scripts.push_back(cleanText(name));
            }
        }
        const pugi::xml_node geometry = node.child("geometry");
        const Result<bool> drawn = readShape(geometry, object.name, scope, visual);
        if (!drawn) return tl::unexpected(drawn.error());
        if (!*drawn) {
            noteUnknownShape(geometry, left_out_.shapes);
            return {};
        }
        object.visuals.push_back(std::move(visual));
        return {};
    }

    const ModelPath& files_;
    const JobContext& job_;
    MaterialScripts scripts_{files_};
    Scope scene_;
    std::vector<LinkObject> links_;
    std::vector<const Scope*> scope_of_link_;
    std::vector<Eigen::Affine3d> saved_from_loaded_;  // of each link, in the scene
    std::vector<std::size_t> first_;  // disjoint sets of joined links: parent of each link
    OmittedParts left_out_;
    std::map<fs::path, std::unique_ptr<XmlFile>> documents_;
    /// Files of included models by the including file's folder and the <uri>.
    std::map<std::pair<fs::path, std::string>, std::optional<fs::path>> found_models_;
    std::uint64_t xml_bytes_ = 0;       // of all files, each counted once
    std::uint64_t expanded_bytes_ = 0;  // of all files, counted once per include
    std::size_t frames_ = 0;
    std::size_t visuals_ = 0;
    std::size_t includes_ = 0;
};

}  // namespace

Result<RawScene> readSdf(const fs::path& path, const ImportOptions& options,
                         const JobContext& job) {
    const Result<XmlFile> xml = readXml(path, kMostXmlBytes);
    if (!xml) return tl::unexpected(xml.error());
    pugi::xml_node sdf = xml->document.child("sdf");
    if (!sdf) sdf = xml->document.child("gazebo");
    if (!sdf) {
        return fail(ErrorCode::BadInput,
                    "the XML has no <sdf>, so it is not a Gazebo world; give a world or model",
                    path.string());
    }
    const ModelPath files(ReachableFiles(foldersOfWorld(path, options)));
    SdfReader reader(files, job);
    if (Status read = reader.read(sdf, absoluteNormal(path), *xml); !read) {
        return tl::unexpected(read.error());
    }
    return sceneOfLinks(reader.objects(), files, reader.leftOut(), path.string(), job);
}

}  // namespace dollytrack::gazebo
