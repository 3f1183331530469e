#include "engine/io/gazebo/urdf_reader.h"

#include "engine/core/clean_text.h"
#include "engine/io/gazebo/link_xml.h"
#include "engine/io/gazebo/visuals.h"

#include <map>
#include <set>
#include <string>

namespace dollytrack::gazebo {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostVisuals = 100'000;

class UrdfReader {
  public:
    explicit UrdfReader(const fs::path& path) : path_(path) {}

    Result<std::vector<LinkObject>> read(const pugi::xml_node& robot) {
        for (const pugi::xml_node& material : robot.children("material")) keepColor(material);
        for (const pugi::xml_node& joint : robot.children("joint")) {
            const std::string child = joint.child("child").attribute("link").value();
            joints_.try_emplace(child, joint);
        }
        std::vector<LinkObject> links;
        std::size_t visuals = 0;
        for (const pugi::xml_node& link : robot.children("link")) {
            const std::string name = link.attribute("name").value();
            const auto pose = poseOf(name);
            if (!pose) return tl::unexpected(pose.error());
            LinkObject object{cleanText(name), {}};
            for (const pugi::xml_node& visual : link.children("visual")) {
                if (++visuals > kMostVisuals) return wrong("it has more than 100,000 visuals");
                auto read = visualOf(visual, *pose);
                if (!read) return tl::unexpected(read.error());
                if (*read) object.visuals.push_back(std::move(**read));
            }
            links.push_back(std::move(object));
        }
        return links;
    }

  private:
    [[nodiscard]] tl::unexpected<Error> wrong(std::string message) const {
        return fail(ErrorCode::BadInput, std::move(message), path_.string());
    }

    void keepColor(const pugi::xml_node& material) {
        if (const auto color = colorOf(material.child("color").attribute("rgba").value())) {
            colors_[material.attribute("name").value()] = *color;
        }
    }

    Result<Eigen::Affine3d> originOf(const pugi::xml_node& node) const {
        const pugi::xml_node origin = node.child("origin");
        const auto place = vectorOf(origin.attribute("xyz").as_string("0 0 0"));
        const auto turn = vectorOf(origin.attribute("rpy").as_string("0 0 0"));
        if (!place || !turn) return wrong("an <origin> does not hold three numbers");
        return Eigen::Affine3d(Eigen::Translation3d(*place) * turnOf(*turn));
    }

    /// The link's pose: the origins of the joints up to the root.
    Result<Eigen::Affine3d> poseOf(const std::string& link) {
        Eigen::Affine3d pose = Eigen::Affine3d::Identity();
        std::set<std::string> seen;
        std::string at = link;
        for (auto joint = joints_.find(at); joint != joints_.end(); joint = joints_.find(at)) {
            if (!seen.insert(at).second) {
                return wrong("link '" + cleanText(at) + "' hangs on itself");
            }
            const auto origin = originOf(joint->second);
            if (!origin) return origin;
            pose = *origin * pose;
            at = joint->second.child("parent").attribute("link").value();
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
        const pugi::xml_node material = node.child("material");
        keepColor(material);
        const auto color = colors_.find(material.attribute("name").value());
        if (material && color != colors_.end()) visual.color = color->second;

        const pugi::xml_node geometry = node.child("geometry");
        const auto number = [](const pugi::xml_node& shape, const char* name) {
            const auto numbers = numbersOf(shape.attribute(name).value());
            return numbers && numbers->size() == 1 ? numbers->front() : 0.0;
        };
        if (const pugi::xml_node mesh = geometry.child("mesh")) {
            const auto scale = vectorOf(mesh.attribute("scale").as_string("1 1 1"));
            if (!scale || !(std::abs(scale->prod()) > 0.0)) return wrong("a mesh's scale is none");
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
            return std::optional<Visual>();
        }
        if (visual.shape != Visual::Shape::Mesh && !(visual.size.minCoeff() > 0.0)) {
            return wrong("a box, cylinder or sphere has no size above 0");
        }
        return std::optional<Visual>(std::move(visual));
    }

    const fs::path& path_;
    std::map<std::string, pugi::xml_node> joints_;  // by the link that hangs on it
    std::map<std::string, Eigen::Vector4f> colors_;
};

}  // namespace

bool likeUrdf(std::string_view head) {
    const auto first = head.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
    return first != std::string_view::npos && head[first] == '<';
}

Result<RawScene> readUrdfModel(const fs::path& path, const io::ReachableFiles& files,
                               const JobContext& job) {
    const Result<pugi::xml_document> document = readXml(path);
    if (!document) return tl::unexpected(document.error());
    const pugi::xml_node robot = document->child("robot");
    if (!robot) {
        return fail(ErrorCode::BadInput, "the XML holds no <robot>, so it is no URDF file",
                    path.string());
    }
    const Result<std::vector<LinkObject>> links = UrdfReader(path).read(robot);
    if (!links) return tl::unexpected(links.error());
    return sceneOfLinks(*links, ModelPath(files), {}, path.string(), job);
}

Result<RawScene> readUrdf(const fs::path& path, const ImportOptions& options,
                          const JobContext& job) {
    return readUrdfModel(io::absoluteNormal(path),
                         io::ReachableFiles(foldersOfWorld(path, options.model_folders)), job);
}

std::vector<fs::path> worldInputs(const fs::path& path, const ImportOptions& options) {
    return foldersOfWorld(path, options.model_folders);
}

}  // namespace dollytrack::gazebo
