#pragma once

#include <Eigen/Geometry>

#include <array>
#include <cstdint>
#include <memory>
#include <string>

namespace dollytrack {

struct DatasetClass;

/// A box that stands upright: its third axis is the world's z.
struct OrientedBox {
    Eigen::Vector3d center = Eigen::Vector3d::Zero();
    Eigen::Vector3d half_size = Eigen::Vector3d::Zero();  // along its own axes, m
    double yaw = 0.0;  // radians, turns the world's x axis onto the box's first axis

    [[nodiscard]] double volume() const { return 8.0 * half_size.prod(); }
    [[nodiscard]] double diagonal() const { return 2.0 * half_size.norm(); }
    [[nodiscard]] std::array<Eigen::Vector3d, 8> corners() const;
    [[nodiscard]] Eigen::Vector3d toBox(const Eigen::Vector3d& in_world) const;
    [[nodiscard]] Eigen::Vector3d toWorld(const Eigen::Vector3d& in_box) const;
    [[nodiscard]] bool contains(const Eigen::Vector3d& in_world, double margin_m = 0.0) const;
    /// Distance from a point to the box, m; 0 inside.
    [[nodiscard]] double distance(const Eigen::Vector3d& in_world) const;
    bool operator==(const OrientedBox&) const = default;
};

/// Whether an object is a target, or why it is none.
enum class Role {
    Target,     // to be captured
    Structure,  // wall, floor, ceiling, door, window, ground, sky: obstacle and label only
    Excluded,   // by the user: obstacle and label only
};

/// Where an object's front direction comes from.
enum class FrontSource {
    Annotation,  // given by the scene or the user
    Wall,        // away from the wall it stands or hangs at
    ShortSide,   // across its longer horizontal side, where the view is open farther
    RoomCentre,  // none of these: towards the open space around it
};

/// One object in the scene. Its triangles and vertices are contiguous in the scene's arrays.
struct Object {
    int id = 0;  // 1.., also the value in instance images; index in Scene::objects is id - 1
    std::string name;
    int nyu40 = 0;                                      // 1..40, 0 when unknown
    std::shared_ptr<const DatasetClass> dataset_class;  // of the scene's own table; else null
    Role role = Role::Target;
    bool structure = false;  // part of the building, whatever its role
    OrientedBox box;
    Eigen::Vector3d centroid = Eigen::Vector3d::Zero();  // area-weighted, m
    Eigen::Vector3d front = Eigen::Vector3d::UnitX();    // horizontal unit vector
    FrontSource front_source = FrontSource::RoomCentre;
    bool large = true;
    bool size_given = false;  // `large` was set by the user, not measured
    std::uint32_t first_triangle = 0;
    std::uint32_t triangle_count = 0;
    std::uint32_t first_vertex = 0;
    std::uint32_t vertex_count = 0;
};

}  // namespace dollytrack
