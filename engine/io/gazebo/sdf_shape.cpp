#include "engine/io/gazebo/sdf_shape.h"

#include "engine/core/clean_text.h"
#include "engine/io/gazebo/link_xml.h"

#include <cmath>

namespace dollytrack::gazebo {
namespace {

double lengthIn(const pugi::xml_node& shape, const char* name) {
    const auto numbers = numbersOf(shape.child_value(name));
    return numbers && numbers->size() == 1 ? numbers->front() : 0.0;
}

Eigen::Vector3d vectorIn(const pugi::xml_node& shape, const char* name) {
    return vectorOf(shape.child_value(name)).value_or(Eigen::Vector3d::Zero());
}

Status readMesh(const pugi::xml_node& mesh, const std::string& link, const Scope& scope,
                Visual& visual) {
    const pugi::xml_node scale = mesh.child("scale");
    const auto factors = scale ? vectorOf(scale.child_value())
                               : std::optional<Eigen::Vector3d>(Eigen::Vector3d::Ones());
    if (!factors || !(std::abs(factors->prod()) > 0.0)) {
        return wrongAt(
            "the <scale> of a mesh of '" + link + "' is not three numbers other than 0; correct it",
            scope, mesh);
    }
    visual.scale = *factors;
    visual.uri = textOf(mesh.child("uri"));
    const pugi::xml_node submesh = mesh.child("submesh");
    visual.submesh = cleanText(textOf(submesh.child("name")));
    const std::string center = textOf(submesh.child("center"));
    visual.center_submesh = center == "true" || center == "1";
    return {};
}

void readPlane(const pugi::xml_node& plane, Visual& visual) {
    visual.shape = Visual::Shape::Plane;
    const auto size = numbersOf(plane.child_value("size"));
    if (size && size->size() == 2) visual.size = {(*size)[0], (*size)[1], 1.0};
    const auto normal = vectorOf(plane.child_value("normal"));
    if (normal && normal->norm() > 1e-9) {
        visual.scene_from_visual =
            visual.scene_from_visual *
            Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), normal->normalized());
    }
}

}  // namespace

Result<bool> readShape(const pugi::xml_node& geometry, const std::string& link, const Scope& scope,
                       Visual& visual) {
    if (const pugi::xml_node mesh = geometry.child("mesh")) {
        if (Status read = readMesh(mesh, link, scope, visual); !read) {
            return tl::unexpected(read.error());
        }
        return true;
    }
    if (const pugi::xml_node box = geometry.child("box")) {
        visual.shape = Visual::Shape::Box;
        visual.size = vectorIn(box, "size");
    } else if (const pugi::xml_node cylinder = geometry.child("cylinder")) {
        visual.shape = Visual::Shape::Cylinder;
        const double width = 2.0 * lengthIn(cylinder, "radius");
        visual.size = {width, width, lengthIn(cylinder, "length")};
    } else if (const pugi::xml_node sphere = geometry.child("sphere")) {
        visual.shape = Visual::Shape::Sphere;
        visual.size.setConstant(2.0 * lengthIn(sphere, "radius"));
    } else if (const pugi::xml_node ellipsoid = geometry.child("ellipsoid")) {
        visual.shape = Visual::Shape::Sphere;
        visual.size = 2.0 * vectorIn(ellipsoid, "radii");
    } else if (const pugi::xml_node plane = geometry.child("plane")) {
        readPlane(plane, visual);
    } else {
        return false;
    }
    // Other programs draw negative sizes as positive ones.
    visual.size = visual.size.cwiseAbs();
    if (visual.size.minCoeff() > 0.0) return true;
    return wrongAt("the size of a visual of '" + link + "' is 0; correct it", scope,
                   geometry.parent());
}

}  // namespace dollytrack::gazebo
