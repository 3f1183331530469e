#include "engine/io/gazebo/urdf_reader.h"

#include "engine/core/clean_text.h"
#include "engine/io/gazebo/link_xml.h"
#include "engine/io/gazebo/visuals.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>

namespace dollytrack::gazebo {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostLinks = 100'000;

class UrdfReader {
  public:
    UrdfReader(const fs::path& path, const JobContext& job) : path_(path), job_(job) {}

    Result<std::vector<LinkObject>> read(const pugi::xml_node& robot) {
        for (const pugi::xml_node& material : robot.children("material")) {
            static_cast<void>(colorOfMaterial(material));
        }
        for (const pugi::xml_node& joint : robot.children("joint")) {
            const std::string child = joint.child("child").attribute("link").value();
            joints_.try_emplace(child, joint);
            if (joints_.size() > kMostLinks) return tooMany("joints");
        }
        std::vector<LinkObject> links;
        std::size_t visuals = 0;
        for (const pugi::xml_node& link : robot.children("link")) {
            if (job_.cancelled()) return fail(ErrorCode::Cancelled, "import was cancelled");
            if (links.size() >= kMostLinks) return tooMany("links");
            const std::string name = link.attribute("name").value();
            const auto pose = poseOf(name);
            if (!pose) return tl::unexpected(pose.error());
            LinkObject object{cleanText(name), {}};
            for (const pugi::xml_node& visual : link.children("visual")) {
                if (++visuals > kMostVisuals) return tooMany("visuals");
                auto read = visualOf(visual, *pose);
                if (!read) return tl::unexpected(read.error());
                if (*read) object.visuals.push_back(std::move(**read));
            }
            links.push_back(std::move(object));
        }
        return links;
    }

    [[nodiscard]] const UnknownShapes& unknownShapes() const { return unknown_shapes_; }

  private:
    [[nodiscard]] tl::unexpected<Error> wrong(std::string message) const {
        return fail(ErrorCode::BadInput, std::move(message), path_.string());
    }

    [[nodiscard]] tl::unexpected<Error> tooMany(const std::string& what) const {
        return wrong("the robot has more than 100,000 " + what + "; split it into several files");
    }

    /// The colour of a <material>, its own or that of the first of its name.
    std::optional<Eigen::Vector4f> colorOfMaterial(const pugi::xml_node& material) {
        const std::string name = material.attribute("name").value();
        const auto own = colorOf(material.child("color").attribute("rgba").value());
        if (name.empty()) return own;
        if (own) colors_.try_emplace(name, *own);
        const auto known = colors_.find(name);
        return own || known == colors_.end() ? own : std::optional(known->second);
    }

    Result<Eigen::Affine3d> originOf(const pugi::xml_node& node) const {
        const pugi::xml_node origin = node.child("origin");
        const auto place = vectorOf(origin.attribute("xyz").as_string("0 0 0"));
        const auto rotation = vectorOf(origin.attribute("rpy").as_string("0 0 0"));
        if (!place || !rotation) {
            return wrong("the xyz or rpy of an <origin> is not three numbers; correct it");
        }
        return Eigen::Affine3d(Eigen::Translation3d(*place) * rotationFromRollPitchYaw(*rotation));
    }

    /// The link's pose: the origins of the joints from the root on, each link's computed once.
    Result<Eigen::Affine3d> poseOf(const std::string& link) {
        std::vector<std::pair<std::string, pugi::xml_node>> chain;  // from the link up
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
                return wrong("the joints form a circle at link '" + cleanText(at) +
                             "'; each link needs a path to the root");
            }
            chain.emplace_back(at, joint->second);
            at = joint->second.child("parent").attribute("link").value();
        }
        Eigen::Affine3d pose = known->second;
        std::reverse(chain.begin(), chain.end());
        for (const auto& [name, joint] : chain) {
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
        visual.color = colorOfMaterial(node.child("material"));

        const pugi::xml_node geometry = node.child("geometry");
        const auto number = [](const pugi::xml_node& shape, const char* name) {
            const auto numbers = numbersOf(shape.attribute(name).value());
            return numbers && numbers->size() == 1 ? numbers->front() : 0.0;
        };
        if (const pugi::xml_node mesh = geometry.child("mesh")) {
            const auto scale = vectorOf(mesh.attribute("scale").as_string("1 1 1"));
            if (!scale || !(std::abs(scale->prod()) > 0.0)) {
                return wrong("the scale of a mesh is not three numbers other than 0; correct it");
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
        if (visual.shape != Visual::Shape::Mesh && !(visual.size.minCoeff() > 0.0)) {
            return wrong("the size of a box, cylinder or sphere is not above 0; correct it");
        }
        return std::optional<Visual>(std::move(visual));
    }

    const fs::path& path_;
    const JobContext& job_;
    std::map<std::string, pugi::xml_node> joints_;  // by the link that hangs on it
    std::map<std::string, Eigen::Affine3d> poses_;  // of links, in the root's frame
    std::map<std::string, Eigen::Vector4f> colors_;
    UnknownShapes unknown_shapes_;
};

}  // namespace

Result<RawScene> readUrdfModel(const fs::path& path, const io::ReachableFiles& files,
                               const JobContext& job) {
    const Result<XmlFile> xml = readXml(path, kMostXmlBytes);
    if (!xml) return tl::unexpected(xml.error());
    const pugi::xml_node robot = xml->document.child("robot");
    if (!robot) {
        return fail(ErrorCode::BadInput,
                    "the XML has no <robot>, so it is not a URDF file; give a robot's file",
                    path.string());
    }
    UrdfReader reader(path, job);
    const Result<std::vector<LinkObject>> links = reader.read(robot);
    if (!links) return tl::unexpected(links.error());
    return sceneOfLinks(*links, ModelPath(files), {{}, reader.unknownShapes()}, path.string(), job);
}

Result<RawScene> readUrdf(const fs::path& path, const ImportOptions& options,
                          const JobContext& job) {
    return readUrdfModel(io::absoluteNormal(path),
                         io::ReachableFiles(foldersOfWorld(path, options)), job);
}

}  // namespace dollytrack::gazebo
