#pragma once

#include "engine/scene/labels.h"
#include "engine/scene/scene.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace dollytrack::test {

/// Builds small scenes in code from boxes and quads, grouped into objects. World frame: z up,
/// metres.
class SceneBuilder {
  public:
    struct Look {
        int nyu40 = kNyuOtherProp;
        Role role = Role::Target;
        Eigen::Vector3f color = {0.7F, 0.6F, 0.5F};
    };

    /// Starts a new object to which the following shapes belong.
    SceneBuilder& object(const std::string& name, const Look& look);
    SceneBuilder& object(const std::string& name) { return object(name, Look{}); }
    /// A closed box, turned about its own centre by `yaw`.
    SceneBuilder& box(const Eigen::Vector3d& center, const Eigen::Vector3d& size, double yaw = 0.0);
    /// A one-sided rectangle, given by a corner and two edges; its normal is edge_u x edge_v.
    SceneBuilder& quad(const Eigen::Vector3d& corner, const Eigen::Vector3d& edge_u,
                       const Eigen::Vector3d& edge_v);

    /// Floor, ceiling and four walls of zero thickness, as structure objects.
    SceneBuilder& room(const Eigen::Vector3d& low, const Eigen::Vector3d& high,
                       bool with_ceiling = true);

    /// Returns the scene with ids, boxes, centroids, fronts (+x), size classes and room bounds.
    [[nodiscard]] Scene build() const;

  private:
    struct Part {
        std::string name;
        Look look;
        std::vector<Eigen::Vector3f> positions;
        std::vector<Eigen::Vector3f> normals;
        std::vector<Eigen::Vector2f> uvs;
        std::vector<Triangle> triangles;
        double yaw = 0.0;
    };
    std::vector<Part> parts_;
};

/// A room of 4 x 3 x 2.6 m with a table, two objects on it, a sofa and a picture on the wall.
Scene furnishedRoom();

/// Two rooms of 3 x 3 x 2.5 m side by side in x, joined by a door `door_width_m` wide and 2 m
/// high in a wall 0.1 m thick; a box stands in each.
Scene twoRoomsWithDoor(double door_width_m);

}  // namespace dollytrack::test
