#pragma once

#include "engine/scene/labels.h"
#include "engine/scene/scene.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace dollytrack::test {

/// Builds small scenes in code, without import: boxes and quads, each an object of its own unless
/// put into one together. Everything is in the world's frame: z up, metres.
class SceneBuilder {
  public:
    struct Look {
        int nyu40 = kNyuOtherProp;
        Role role = Role::Target;
        Eigen::Vector3f color = {0.7F, 0.6F, 0.5F};
    };

    /// Starts a new object; the shapes that follow belong to it.
    SceneBuilder& object(const std::string& name, const Look& look);
    SceneBuilder& object(const std::string& name) { return object(name, Look{}); }
    /// A closed box, turned about its own centre by `yaw`.
    SceneBuilder& box(const Eigen::Vector3d& center, const Eigen::Vector3d& size, double yaw = 0.0);
    /// A one-sided rectangle: corner, then its two edges.
    SceneBuilder& quad(const Eigen::Vector3d& corner, const Eigen::Vector3d& edge_u,
                       const Eigen::Vector3d& edge_v);

    /// Floor, ceiling and four walls of zero thickness, as objects of structure.
    SceneBuilder& room(const Eigen::Vector3d& low, const Eigen::Vector3d& high,
                       bool with_ceiling = true);

    /// Fills in ids, boxes, centroids, fronts (+x), large/small and the room's bounds.
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

/// A room 4 x 3 x 2.6 m with a table, two things on it, a sofa and a picture on the wall.
Scene furnishedRoom();

/// Two rooms of 3 x 3 x 2.5 m side by side in x, joined by a door `door_width_m` wide and 2 m
/// high in a wall 0.1 m thick; a box stands in each.
Scene twoRoomsWithDoor(double door_width_m);

}  // namespace dollytrack::test
