#include "engine/io/gazebo/sdf_reader.h"

#include "engine/core/clean_text.h"
#include "engine/io/gazebo/link_xml.h"
#include "engine/io/gazebo/visuals.h"
#include "engine/scene/srgb.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <string>

namespace dollytrack::gazebo {
namespace {

namespace fs = std::filesystem;

constexpr int kDeepestModel = 16;
constexpr std::size_t kMostSdfVisuals = 100'000;
constexpr std::size_t kMostModels = 20'000;

/// Gazebo's own materials, as sRGB.
std::optional<Eigen::Vector4f> namedColor(std::string_view name) {
    struct Row {
        std::string_view name;
        std::array<float, 3> color;
    };
    static constexpr std::array<Row, 17> kRows = {{{"Gazebo/Grey", {0.7F, 0.7F, 0.7F}},
                                                   {"Gazebo/Gray", {0.7F, 0.7F, 0.7F}},
                                                   {"Gazebo/DarkGrey", {0.175F, 0.175F, 0.175F}},
                                                   {"Gazebo/DarkGray", {0.175F, 0.175F, 0.175F}},
                                                   {"Gazebo/White", {1, 1, 1}},
                                                   {"Gazebo/FlatBlack", {0.1F, 0.1F, 0.1F}},
                                                   {"Gazebo/Black", {0, 0, 0}},
                                                   {"Gazebo/Red", {1, 0, 0}},
                                                   {"Gazebo/Green", {0, 1, 0}},
                                                   {"Gazebo/Blue", {0, 0, 1}},
                                                   {"Gazebo/Yellow", {1, 1, 0}},
                                                   {"Gazebo/Orange", {1, 0.5088F, 0.0468F}},
                                                   {"Gazebo/Purple", {1, 0, 1}},
                                                   {"Gazebo/Turquoise", {0, 1, 1}},
                                                   {"Gazebo/Wood", {0.6F, 0.45F, 0.3F}},
                                                   {"Gazebo/Bricks", {0.55F, 0.3F, 0.25F}},
                                                   {"Gazebo/Residential", {0.8F, 0.8F, 0.78F}}}};
    for (const Row& row : kRows) {
        if (name != row.name) continue;
        return Eigen::Vector4f(linearFromSrgb(row.color[0]), linearFromSrgb(row.color[1]),
                               linearFromSrgb(row.color[2]), 1.0F);
    }
    return std::nullopt;
}

class SdfReader {
  public:
    explicit SdfReader(const ModelPath& files) : files_(files) {}

    Status read(const pugi::xml_node& sdf, const fs::path& path) {
        const pugi::xml_node world = sdf.child("world");
        const Scope scope{path, Eigen::Affine3d::Identity(), {}, 0};
        if (world) return readChildren(world, scope);
        if (const pugi::xml_node model = sdf.child("model")) {
            return readModelNode(model, scope, {});
        }
        return wrong("the file holds neither a <world> nor a <model>", path);
    }

    [[nodiscard]] const std::vector<LinkObject>& links() const { return links_; }
    [[nodiscard]] const std::vector<std::string>& missing() const { return missing_; }

  private:
    /// Where one is: the file, the pose of the world or model, and the models around.
    struct Scope {
        fs::path path;
        Eigen::Affine3d scene_from_scope;
        std::string name;  // of the outermost model; empty in the world
        int depth = 0;
    };

    static tl::unexpected<Error> wrong(std::string message, const fs::path& path) {
        return fail(ErrorCode::BadInput, std::move(message), path.string());
    }

    static std::string nameOf(const pugi::xml_node& node) {
        return cleanText(node.attribute("name").value());
    }

    /// What a <pose> says, aside from what it counts from.
    static std::optional<Eigen::Affine3d> poseIn(const pugi::xml_node& node) {
        const pugi::xml_node pose = node.child("pose");
        const auto numbers = numbersOf(pose.child_value());
        if (!numbers) return std::nullopt;
        if (numbers->empty()) return Eigen::Affine3d::Identity();
        const std::vector<double>& n = *numbers;
        Eigen::Affine3d result = Eigen::Affine3d::Identity();
        if (std::string_view(pose.attribute("rotation_format").value()) == "quat_xyzw") {
            if (n.size() != 7) return std::nullopt;
            const Eigen::Quaterniond turn(n[6], n[3], n[4], n[5]);
            if (!(turn.norm() > 1e-9)) return std::nullopt;
            result = Eigen::Translation3d(n[0], n[1], n[2]) * turn.normalized();
            return result;
        }
        if (n.size() != 6) return std::nullopt;
        Eigen::Vector3d turn(n[3], n[4], n[5]);
        if (pose.attribute("degrees").as_bool()) turn *= M_PI / 180.0;
        result = Eigen::Translation3d(n[0], n[1], n[2]) * turnOf(turn);
        return result;
    }

    /// The pose of a link, frame or model within its scope, along relative_to and attached_to.
    static Result<Eigen::Affine3d> poseWithin(const pugi::xml_node& scope,
                                              const pugi::xml_node& node, const fs::path& path) {
        Eigen::Affine3d pose = Eigen::Affine3d::Identity();
        pugi::xml_node at = node;
        for (int step = 0; step < 64; ++step) {
            const auto own = poseIn(at);
            if (!own) return wrong("a <pose> of '" + nameOf(at) + "' is none", path);
            pose = *own * pose;
            std::string from = at.child("pose").attribute("relative_to").value();
            const std::string_view kind = at.name();
            if (from.empty() && kind == "frame") from = at.attribute("attached_to").value();
            if (from.empty() && kind == "joint") from = at.child_value("child");
            if (from.empty() || from == "__model__" || from == "world") return pose;
            pugi::xml_node next;
            for (const char* list : {"link", "frame", "model", "joint", "include"}) {
                if (!next) next = scope.find_child_by_attribute(list, "name", from.c_str());
            }
            for (const pugi::xml_node& include : scope.children("include")) {
                if (!next && from == include.child_value("name")) next = include;
            }
            if (!next) {
                return wrong("the frame '" + cleanText(from) + "' that a pose counts from is not "
                                                               "there",
                             path);
            }
            at = next;
        }
        return wrong("poses count from one another in a circle", path);
    }

    Status readChildren(const pugi::xml_node& parent, const Scope& scope) {
        for (const pugi::xml_node& child : parent.children()) {
            const std::string_view kind = child.name();
            if (kind != "model" && kind != "include") continue;
            const auto pose = poseWithin(parent, child, scope.path);
            if (!pose) return tl::unexpected(pose.error());
            const Scope inner{scope.path, scope.scene_from_scope * *pose, scope.name,
                              scope.depth + 1};
            Status read =
                kind == "model" ? readModel(child, inner) : readInclude(child, inner);
            if (!read) return read;
        }
        return {};
    }

    /// A model at the top of a file, whose own pose counts unless an <include> gives another.
    Status readModelNode(const pugi::xml_node& model, Scope scope, const std::string& name) {
        const auto pose = poseIn(model);
        if (!pose) return wrong("the <pose> of '" + nameOf(model) + "' is none", scope.path);
        if (scope.depth == 0 || !own_pose_overridden_) {
            scope.scene_from_scope = scope.scene_from_scope * *pose;
        }
        own_pose_overridden_ = false;
        if (!name.empty()) scope.name = name;
        return readModel(model, scope);
    }

    Status readInclude(const pugi::xml_node& include, const Scope& scope) {
        const std::string uri = include.child_value("uri");
        const auto file = files_.findModel(scope.path.parent_path(), uri);
        if (!file || ++models_ > kMostModels) {
            if (file) return wrong("the world has more than 20,000 models", scope.path);
            missing_.push_back(cleanText(uri));
            return {};
        }
        auto at = documents_.find(*file);
        if (at == documents_.end()) {
            Result<pugi::xml_document> read = readXml(*file);
            if (!read) return tl::unexpected(read.error());
            at = documents_
                     .emplace(*file, std::make_unique<pugi::xml_document>(std::move(*read)))
                     .first;
        }
        const pugi::xml_node model = at->second->child("sdf").child("model");
        if (!model) return wrong("the file that is included holds no <model>", *file);
        // An <include> in a model of its own stands for that model.
        std::string name = scope.name;
        if (name.empty()) name = cleanText(include.child_value("name"));
        if (name.empty()) name = nameOf(model);
        own_pose_overridden_ = static_cast<bool>(include.child("pose"));
        return readModelNode(model, {*file, scope.scene_from_scope, name, scope.depth}, name);
    }

    Status readModel(const pugi::xml_node& model, const Scope& scope) {
        if (scope.depth > kDeepestModel) {
            return wrong("models lie within models more than 16 deep; does one include itself?",
                         scope.path);
        }
        Scope inner = scope;
        if (inner.name.empty()) inner.name = nameOf(model);
        if (Status read = readLinks(model, inner); !read) return read;
        return readChildren(model, inner);
    }

    Status readLinks(const pugi::xml_node& model, const Scope& scope) {
        std::vector<LinkObject> links;
        std::map<std::string, std::size_t> numbers;
        for (const pugi::xml_node& link : model.children("link")) {
            const auto pose = poseWithin(model, link, scope.path);
            if (!pose) return tl::unexpected(pose.error());
            LinkObject object{nameOf(link), {}};
            for (const pugi::xml_node& visual : link.children("visual")) {
                if (++visuals_ > kMostSdfVisuals) {
                    return wrong("the world has more than 100,000 visuals", scope.path);
                }
                Status read = addVisual(visual, scope, scope.scene_from_scope * *pose, object);
                if (!read) return read;
            }
            numbers.try_emplace(object.name, links.size());
            links.push_back(std::move(object));
        }
        joinLinks(model, numbers, links);
        std::erase_if(links, [](const LinkObject& link) { return link.visuals.empty(); });
        if (links.size() == 1) links.front().name = scope.name;
        for (LinkObject& link : links) links_.push_back(std::move(link));
        return {};
    }

    /// Links that joints hold together become one: the first takes the others' visuals.
    static void joinLinks(const pugi::xml_node& model,
                          const std::map<std::string, std::size_t>& numbers,
                          std::vector<LinkObject>& links) {
        std::vector<std::size_t> first(links.size());
        for (std::size_t i = 0; i < first.size(); ++i) first[i] = i;
        const auto root = [&](std::size_t i) {
            while (first[i] != i) i = first[i] = first[first[i]];
            return i;
        };
        for (const pugi::xml_node& joint : model.children("joint")) {
            const auto parent = numbers.find(cleanText(joint.child_value("parent")));
            const auto child = numbers.find(cleanText(joint.child_value("child")));
            if (parent == numbers.end() || child == numbers.end()) continue;
            const std::size_t a = root(parent->second);
            const std::size_t b = root(child->second);
            first[std::max(a, b)] = std::min(a, b);
        }
        for (std::size_t i = 0; i < links.size(); ++i) {
            if (root(i) == i) continue;
            std::vector<Visual>& into = links[root(i)].visuals;
            into.insert(into.end(), std::make_move_iterator(links[i].visuals.begin()),
                        std::make_move_iterator(links[i].visuals.end()));
            links[i].visuals.clear();
        }
    }

    static double lengthIn(const pugi::xml_node& shape, const char* name) {
        const auto numbers = numbersOf(shape.child_value(name));
        return numbers && numbers->size() == 1 ? numbers->front() : 0.0;
    }

    Status addVisual(const pugi::xml_node& node, const Scope& scope, const Eigen::Affine3d& link,
                     LinkObject& object) {
        const auto pose = poseIn(node);
        if (!pose) return wrong("the <pose> of a visual is none", scope.path);
        Visual visual;
        visual.folder = scope.path.parent_path();
        visual.scene_from_visual = link * *pose;
        visual.color = colorIn(node);
        const pugi::xml_node geometry = node.child("geometry");
        if (const pugi::xml_node mesh = geometry.child("mesh")) {
            const pugi::xml_node scale = mesh.child("scale");
            const auto factors = scale ? vectorOf(scale.child_value())
                                       : std::optional<Eigen::Vector3d>(Eigen::Vector3d::Ones());
            if (!factors || !(std::abs(factors->prod()) > 0.0)) {
                return wrong("the scale of a mesh is none", scope.path);
            }
            visual.scale = *factors;
            visual.uri = mesh.child_value("uri");
            visual.submesh = cleanText(mesh.child("submesh").child_value("name"));
        } else if (const pugi::xml_node box = geometry.child("box")) {
            visual.shape = Visual::Shape::Box;
            visual.size = vectorOf(box.child_value("size")).value_or(Eigen::Vector3d::Zero());
        } else if (const pugi::xml_node cylinder = geometry.child("cylinder")) {
            visual.shape = Visual::Shape::Cylinder;
            const double width = 2.0 * lengthIn(cylinder, "radius");
            visual.size = {width, width, lengthIn(cylinder, "length")};
        } else if (const pugi::xml_node sphere = geometry.child("sphere")) {
            visual.shape = Visual::Shape::Sphere;
            visual.size.setConstant(2.0 * lengthIn(sphere, "radius"));
        } else if (const pugi::xml_node ellipsoid = geometry.child("ellipsoid")) {
            visual.shape = Visual::Shape::Sphere;
            visual.size =
                2.0 * vectorOf(ellipsoid.child_value("radii")).value_or(Eigen::Vector3d::Zero());
        } else if (const pugi::xml_node plane = geometry.child("plane")) {
            visual.shape = Visual::Shape::Plane;
            const auto size = numbersOf(plane.child_value("size"));
            if (size && size->size() == 2) visual.size = {(*size)[0], (*size)[1], 1.0};
            const auto normal = vectorOf(plane.child_value("normal"));
            if (normal && normal->norm() > 1e-9) {
                visual.scene_from_visual = visual.scene_from_visual *
                                           Eigen::Quaterniond::FromTwoVectors(
                                               Eigen::Vector3d::UnitZ(), normal->normalized());
            }
        } else {
            return {};
        }
        if (visual.shape != Visual::Shape::Mesh && !(visual.size.minCoeff() > 0.0)) {
            return wrong("a visual of '" + object.name + "' has no size above 0", scope.path);
        }
        object.visuals.push_back(std::move(visual));
        return {};
    }

    static std::optional<Eigen::Vector4f> colorIn(const pugi::xml_node& visual) {
        const pugi::xml_node material = visual.child("material");
        std::optional<Eigen::Vector4f> color = colorOf(material.child_value("diffuse"));
        if (!color) color = namedColor(material.child("script").child_value("name"));
        if (!color) color = colorOf(material.child_value("ambient"));
        const auto hidden = numbersOf(visual.child_value("transparency"));
        if (hidden && hidden->size() == 1 && hidden->front() > 0.0 && hidden->front() < 1.0) {
            if (!color) color = Eigen::Vector4f(0.8F, 0.8F, 0.8F, 1.0F);
            (*color)[3] *= static_cast<float>(1.0 - hidden->front());
        }
        return color;
    }

    const ModelPath& files_;
    std::vector<LinkObject> links_;
    std::vector<std::string> missing_;
    std::map<fs::path, std::unique_ptr<pugi::xml_document>> documents_;
    std::size_t visuals_ = 0;
    std::size_t models_ = 0;
    bool own_pose_overridden_ = false;
};

}  // namespace

bool likeSdf(std::string_view head) {
    const auto first = head.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
    return first != std::string_view::npos && head[first] == '<';
}

Result<RawScene> readSdf(const fs::path& path, const ImportOptions& options,
                         const JobContext& job) {
    const Result<pugi::xml_document> document = readXml(path);
    if (!document) return tl::unexpected(document.error());
    pugi::xml_node sdf = document->child("sdf");
    if (!sdf) sdf = document->child("gazebo");
    if (!sdf) {
        return fail(ErrorCode::BadInput, "the XML holds no <sdf>, so it is no world of Gazebo",
                    path.string());
    }
    const ModelPath files(io::ReachableFiles(foldersOfWorld(path, options.model_folders)));
    SdfReader reader(files);
    if (Status read = reader.read(sdf, io::absoluteNormal(path)); !read) {
        return tl::unexpected(read.error());
    }
    return sceneOfLinks(reader.links(), files, reader.missing(), path.string(), job);
}

}  // namespace dollytrack::gazebo
