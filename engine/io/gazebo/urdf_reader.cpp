#include "engine/io/gazebo/urdf_reader.h"

#include "engine/core/clean_text.h"
#include "engine/core/field_list.h"
#include "engine/core/text_lists.h"
#include "engine/io/gazebo/link_xml.h"
#include "engine/io/gazebo/visuals.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>

namespace dollytrack::gazebo {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostLinks = 100'000;

class UrdfReader {
  public:
    UrdfReader(const fs::path& path, const XmlFile& xml, const ModelPath& files,
               const JobContext& job)
        : path_(path), xml_(xml), files_(files), job_(job) {}

    Result<std::vector<LinkObject>> read(const pugi::xml_node& robot) {
        for (const pugi::xml_node& material : robot.children("material")) {
            static_cast<void>(surfaceOf(material));
        }
        for (const pugi::xml_node& link : robot.children("link")) {
            if (links_.size() >= kMostLinks) return tooMany("links", link);
            const std::string name = link.attribute("name").value();
            if (!links_.try_emplace(name, link).second) {
                doubt(link, fmt::format("there are two links '{}'; joints refer to the first",
                                        cleanText(name)));
            }
        }
        if (Status read = readJoints(robot); !read) return tl::unexpected(read.error());
        std::vector<Placed> placed;
        std::size_t visuals = 0;
        for (const pugi::xml_node& link : robot.children("link")) {
            if (job_.cancelled()) return fail(ErrorCode::Cancelled, "import was cancelled");
            const std::string name = link.attribute("name").value();
            const auto pose = poseOf(name);
            if (!pose) return tl::unexpected(pose.error());
            if (cut_off_.contains(name)) continue;
            Placed one{name, {}};
            for (const pugi::xml_node& visual : link.children("visual")) {
                if (++visuals > kMostVisuals) return tooMany("visuals", visual);
                auto read = visualOf(visual, *pose);
                if (!read) return tl::unexpected(read.error());
                if (*read) one.visuals.push_back(std::move(**read));
            }
            placed.push_back(std::move(one));
        }
        doubtCutOff();
        return objectsOf(std::move(placed), cleanText(robot.attribute("name").value()));
    }

    [[nodiscard]] const UnknownShapes& unknownShapes() const { return unknown_shapes_; }
    [[nodiscard]] const std::vector<std::string>& doubts() const { return doubts_; }

  private:
    /// A link with its visuals in the scene's frame.
    struct Placed {
        std::string name;
        std::vector<Visual> visuals;
    };

    /// The colour and texture of a <material>.
    struct Surface {
        std::optional<Eigen::Vector4f> color;
        fs::path texture;  // empty: none
    };

    [[nodiscard]] tl::unexpected<Error> wrong(std::string message,
                                              const pugi::xml_node& element) const {
        return fail(ErrorCode::BadInput, std::move(message), xml_.placeOf(path_, element));
    }

    [[nodiscard]] tl::unexpected<Error> tooMany(const std::string& what,
                                                const pugi::xml_node& element) const {
        return wrong("the robot has more than 100,000 " + what + "; split it into several files",
                     element);
    }

    /// Adds a warning about an element, with its line.
    void doubt(const pugi::xml_node& element, const std::string& sentence) {
        doubts_.push_back(fmt::format("{}: {}", xml_.placeOf(path_.filename(), element), sentence));
    }

    /// Finds the joint above each link. Joints whose child is missing are left out; if the parent
    /// is missing, the child and all links below it are left out.
    Status readJoints(const pugi::xml_node& robot) {
        std::size_t count = 0;
        for (const pugi::xml_node& joint : robot.children("joint")) {
            if (++count > kMostLinks) return tooMany("joints", joint);
            const std::string child = joint.child("child").attribute("link").value();
            const std::string parent = joint.child("parent").attribute("link").value();
            const std::string name = cleanText(joint.attribute("name").value());
            if (!links_.contains(child)) {
                doubt(joint, fmt::format("the joint '{}' names the child link '{}', which does not "
                                         "exist{}; the joint is left out",
                                         name, cleanText(child), hintFor(child)));
                continue;
            }
            if (!joints_.try_emplace(child, joint).second) {
                doubt(joint,
                      fmt::format(
                          "the link '{}' is the child of two joints; the joint '{}' is left out",
                          cleanText(child), name));
                continue;
            }
            if (links_.contains(parent)) continue;
            cut_off_.insert(child);
            doubt(joint, fmt::format("the joint '{}' names the parent link '{}', which does not "
                                     "exist{}; the link '{}' and all links below it are left out",
                                     name, cleanText(parent), hintFor(parent), cleanText(child)));
        }
        return {};
    }

    /// A hint such as " (perhaps 'door' is meant)"; empty if no name is similar and after 20 calls.
    std::string hintFor(const std::string& wrong_name) {
        constexpr int kMostHints = 20;
        if (++hints_ > kMostHints) return {};
        std::vector<std::string> names;
        for (const auto& [name, link] : links_) names.push_back(name);
        const std::string close = closestName(wrong_name, names);
        return close.empty() ? close : fmt::format(" (perhaps '{}' is meant)", cleanText(close));
    }

    void doubtCutOff() {
        if (cut_off_.empty()) return;
        std::vector<std::string> names;
        for (const std::string& name : cut_off_) names.push_back(cleanText(name));
        doubts_.push_back(
            fmt::format("{} left out because a joint above names a parent that does not exist: {}",
                        counted(names.size(), "link is", "links are"), listOf(names)));
    }

    static bool isMovable(const pugi::xml_node& joint) {
        const std::string_view type = joint.attribute("type").value();
        return type == "revolute" || type == "continuous" || type == "prismatic";
    }

    /// The link whose object a link belongs to: the nearest one above it (or itself) that no joint
    /// moves, so that drawers, doors and their handles belong to their cabinet. A link fixed to an
    /// unmoved link, such as furniture to a room, is an object of its own.
    const std::string& ownerOf(const std::string& link, const std::set<std::string>& shown) {
        std::vector<std::string> chain;
        std::string at = link;
        while (!owners_.contains(at)) {
            const auto joint = joints_.find(at);
            const bool hangs = joint != joints_.end();
            chain.push_back(at);
            if (!hangs) break;
            at = joint->second.child("parent").attribute("link").value();
        }
        std::reverse(chain.begin(), chain.end());
        for (const std::string& name : chain) {
            Owner owner{name, false};
            const auto joint = joints_.find(name);
            if (joint != joints_.end()) {
                const std::string parent = joint->second.child("parent").attribute("link").value();
                const auto above = owners_.find(parent);
                const std::string_view type = joint->second.attribute("type").value();
                const bool moved_above = above != owners_.end() && above->second.moves;
                owner.moves = isMovable(joint->second) || (type == "fixed" && moved_above);
                // Links below a link without visuals, such as doors at the origin, stay separate.
                const bool joins =
                    owner.moves && above != owners_.end() && shown.contains(above->second.link);
                if (joins) owner.link = above->second.link;
            }
            owners_.emplace(name, std::move(owner));
        }
        return owners_.at(link).link;
    }

    std::vector<LinkObject> objectsOf(std::vector<Placed> placed, const std::string& robot) {
        std::set<std::string> shown;
        for (const Placed& one : placed) {
            if (!one.visuals.empty()) shown.insert(one.name);
        }
        std::map<std::string, std::size_t> number;  // index in `objects` by owner
        std::vector<LinkObject> objects;
        for (Placed& one : placed) {
            if (one.visuals.empty()) continue;
            const std::string owner = ownerOf(one.name, shown);
            const auto [at, is_new] = number.try_emplace(owner, objects.size());
            if (is_new) objects.push_back({cleanText(owner), {}});
            std::ranges::move(one.visuals, std::back_inserter(objects[at->second].visuals));
        }
        if (robot.empty()) return objects;
        const bool whole = objects.size() == 1 && shown.size() > 1;
        for (LinkObject& object : objects) {
            if (!whole && !isPlainLinkName(object.name)) continue;
            object.name = objects.size() == 1 ? robot : fmt::format("{}::{}", robot, object.name);
        }
        return objects;
    }

    /// A <material>: its own colour and texture, otherwise those of the first of its name.
    Surface surfaceOf(const pugi::xml_node& material) {
        const std::string name = material.attribute("name").value();
        Surface own;
        own.color = colorOf(material.child("color").attribute("rgba").value());
        const std::string texture = material.child("texture").attribute("filename").value();
        if (!texture.empty()) {
            // A missing picture is searched for beside the file again, and counted as missing.
            const fs::path folder = absoluteNormal(path_).parent_path();
            own.texture =
                files_.find(folder, texture).value_or(folder / fs::path(texture).filename());
        }
        if (name.empty()) return own;
        if (!own.color && own.texture.empty()) {
            const auto known = surfaces_.find(name);
            return known == surfaces_.end() ? own : known->second;
        }
        surfaces_.try_emplace(name, own);
        return own;
    }

    Result<Eigen::Affine3d> originOf(const pugi::xml_node& node) const {
        const pugi::xml_node origin = node.child("origin");
        const auto place = vectorOf(origin.attribute("xyz").as_string("0 0 0"));
        const auto rotation = vectorOf(origin.attribute("rpy").as_string("0 0 0"));
        if (!place || !rotation) {
            return wrong("the xyz or rpy of an <origin> is not three numbers; correct it", origin);
        }
        return Eigen::Affine3d(Eigen::Translation3d(*place) * rotationFromRollPitchYaw(*rotation));
    }

    /// The pose of a link in the root's frame: the product of the joint origins. Computed once per
    /// link.
    Result<Eigen::Affine3d> poseOf(const std::string& link) {
        std::vector<std::pair<std::string, pugi::xml_node>> chain;  // from the link to the root
        std::set<std::string> seen;
        std::string at = link;
        auto known = poses_.find(at);
        for (; known == poses_.end(); known = poses_.find(at)) {
            const auto joint = joints_.find(at);
            if (joint == joints_.end()) {
                known = poses_.try_emplace(at, Eigen::Affine3d::Identity()).first;
                break;
            }
            if (!seen.insert(at).second) {
                return wrong("the joints form a cycle at link '" + cleanText(at) +
                                 "'; each link needs a path to the root",
                             joint->second);
            }
            chain.emplace_back(at, joint->second);
            at = joint->second.child("parent").attribute("link").value();
        }
        Eigen::Affine3d pose = known->second;
        std::reverse(chain.begin(), chain.end());
        for (const auto& [name, joint] : chain) {
            if (cut_off_.contains(joint.child("parent").attribute("link").value())) {
                cut_off_.insert(name);
            }
            const auto origin = originOf(joint);
            if (!origin) return origin;
            pose = pose * *origin;
            poses_.try_emplace(name, pose);
        }
        return pose;
    }

    Result<std::optional<Visual>> visualOf(const pugi::xml_node& node,
                                           const Eigen::Affine3d& link) {
        const auto origin = originOf(node);
        if (!origin) return tl::unexpected(origin.error());
        Visual visual;
        visual.folder = path_.parent_path();
        visual.scene_from_visual = link * *origin;
        Surface surface = surfaceOf(node.child("material"));
        visual.color = surface.color;
        visual.texture = std::move(surface.texture);

        const pugi::xml_node geometry = node.child("geometry");
        const auto number = [](const pugi::xml_node& shape, const char* name) {
            const auto numbers = numbersOf(shape.attribute(name).value());
            return numbers && numbers->size() == 1 ? numbers->front() : 0.0;
        };
        if (const pugi::xml_node mesh = geometry.child("mesh")) {
            const auto scale = vectorOf(mesh.attribute("scale").as_string("1 1 1"));
            if (!scale || !(std::abs(scale->prod()) > 0.0)) {
                return wrong("the scale of a mesh is not three numbers other than 0; correct it",
                             mesh);
            }
            visual.scale = *scale;
            visual.uri = mesh.attribute("filename").value();
        } else if (const pugi::xml_node box = geometry.child("box")) {
            visual.shape = Visual::Shape::Box;
            visual.size = vectorOf(box.attribute("size").value()).value_or(Eigen::Vector3d::Zero());
        } else if (const pugi::xml_node sphere = geometry.child("sphere")) {
            visual.shape = Visual::Shape::Sphere;
            visual.size.setConstant(2.0 * number(sphere, "radius"));
        } else if (const pugi::xml_node cylinder = geometry.child("cylinder")) {
            visual.shape = Visual::Shape::Cylinder;
            const double width = 2.0 * number(cylinder, "radius");
            visual.size = {width, width, number(cylinder, "length")};
        } else {
            noteUnknownShape(geometry, unknown_shapes_);
            return std::optional<Visual>();
        }
        // Other programs draw negative sizes as positive ones.
        visual.size = visual.size.cwiseAbs();
        if (visual.shape != Visual::Shape::Mesh && !(visual.size.minCoeff() > 0.0)) {
            return wrong("the size of a box, cylinder or sphere is 0; correct it", geometry);
        }
        return std::optional<Visual>(std::move(visual));
    }

    /// The link after which a link's object is named, and whether a joint above moves the link.
    struct Owner {
        std::string link;
        bool moves = false;
    };

    const fs::path& path_;
    const XmlFile& xml_;
    const ModelPath& files_;
    const JobContext& job_;
    std::map<std::string, pugi::xml_node> links_;
    std::map<std::string, pugi::xml_node> joints_;  // by child link
    std::set<std::string> cut_off_;                 // links below a missing parent
    std::map<std::string, Owner> owners_;           // by link
    std::map<std::string, Eigen::Affine3d> poses_;  // by link, in the root's frame
    std::map<std::string, Surface> surfaces_;       // by the material's name
    UnknownShapes unknown_shapes_;
    std::vector<std::string> doubts_;
    int hints_ = 0;  // number of searches for similar names
};

}  // namespace

Result<RawScene> readUrdfModel(const fs::path& path, const ReachableFiles& files,
                               const JobContext& job) {
    const Result<XmlFile> xml = readXml(path, kMostXmlBytes);
    if (!xml) return tl::unexpected(xml.error());
    const pugi::xml_node robot = xml->document.child("robot");
    if (!robot) {
        return fail(ErrorCode::BadInput,
                    "the XML has no <robot>, so it is not a URDF file; give a robot's file",
                    path.string());
    }
    const ModelPath model_path(files);
    UrdfReader reader(path, *xml, model_path, job);
    const Result<std::vector<LinkObject>> links = reader.read(robot);
    if (!links) return tl::unexpected(links.error());
    OmittedParts left_out;
    left_out.shapes = reader.unknownShapes();
    left_out.doubts = reader.doubts();
    return sceneOfLinks(*links, model_path, left_out, path.string(), job);
}

Result<RawScene> readUrdf(const fs::path& path, const ImportOptions& options,
                          const JobContext& job) {
    return readUrdfModel(absoluteNormal(path), ReachableFiles(foldersOfWorld(path, options)), job);
}

}  // namespace dollytrack::gazebo
