#pragma once

#include <Eigen/Core>

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack::homes {

/// The content of Sweet Home 3D's Home.xml. Lengths are in cm; the plan's x points right and y
/// *down* the page, elevations up; angles are in radians, clockwise on the page. Names are clean
/// text; all numbers are finite and all sizes positive.

/// A texture that is repeated every width x height.
struct HomeTexture {
    std::string image;  // file name within the home
    double width_cm = 100.0;
    double height_cm = 100.0;
};

/// Linear colour or texture of a surface. Without both, the reader uses its default.
struct HomeSurface {
    std::optional<Eigen::Vector3f> color;
    std::optional<HomeTexture> texture;
};

struct HomeLevel {
    double elevation = 0.0;
    double floor_thickness = 0.0;
    double height = 250.0;
    bool viewable = true;
};

struct HomeBaseboard {
    double thickness = 0.0;
    double height = 0.0;
    HomeSurface surface;
};

/// A wall. Left and right are as seen from its start towards its end.
struct HomeWall {
    Eigen::Vector2d start = Eigen::Vector2d::Zero();
    Eigen::Vector2d end = Eigen::Vector2d::Zero();
    double thickness = 10.0;
    double height = 250.0;
    double height_at_end = 250.0;
    double arc_extent = 0.0;  // angle of a round wall's arc; 0: straight, > 0: bulges left
    int at_start = -1;        // index of the wall joined to it; -1: none
    int at_end = -1;
    int level = -1;  // index; -1: the home has no levels
    HomeSurface left;
    HomeSurface right;
    HomeSurface top;
    std::optional<HomeBaseboard> left_baseboard;
    std::optional<HomeBaseboard> right_baseboard;
};

struct HomeRoom {
    std::string name;
    std::vector<Eigen::Vector2d> points;
    bool floor_visible = true;
    bool ceiling_visible = true;
    int level = -1;
    HomeSurface floor;
    HomeSurface ceiling;
};

enum class PieceKind { Furniture, Light, Opening };

/// A piece of furniture, a lamp, a door or a window. Its model is rotated by `model_rotation`,
/// scaled to width x depth x height, rotated by `angle`, and placed with the centre of its bottom
/// at `position`, `elevation` above its level. At angle 0 its front faces down the page (+y).
struct HomePiece {
    PieceKind kind = PieceKind::Furniture;
    std::string name;
    std::string catalog_id;  // "eTeks#armchair"
    std::string model;       // file name within the home
    Eigen::Vector2d position = Eigen::Vector2d::Zero();
    double elevation = 0.0;
    double angle = 0.0;
    double pitch = 0.0;
    double roll = 0.0;
    double width = 1.0;
    double depth = 1.0;
    double height = 1.0;
    bool mirrored = false;
    bool centered_at_origin = true;  // whether a rotated model is centred after the rotation
    std::optional<Eigen::Matrix3d> model_rotation;
    int level = -1;
    HomeSurface surface;                           // of the whole piece
    std::map<std::string, HomeSurface> materials;  // by material name of the model
    std::string wall_cut_out;   // hole of an opening: SVG path in the unit square
    std::string floor_cut_out;  // hole of a staircase: the same; empty: none
};

enum class CameraKind { Visitor, Stored, Path };

struct HomeCamera {
    CameraKind kind = CameraKind::Stored;
    std::string name;
    Eigen::Vector2d position = Eigen::Vector2d::Zero();
    double height = 0.0;  // above elevation 0
    double yaw = 0.0;     // 0: down the page; clockwise on the page
    double pitch = 0.0;   // positive downwards
    double field_of_view = 1.0;
    std::optional<double> time_s;
};

struct Home {
    double wall_height = 250.0;
    std::vector<HomeLevel> levels;
    std::vector<HomeWall> walls;
    std::vector<HomeRoom> rooms;
    std::vector<HomePiece> pieces;  // including the single pieces of groups
    std::vector<HomeCamera> cameras;
    std::size_t hidden = 0;  // number of invisible walls, rooms and pieces that were left out
};

}  // namespace dollytrack::homes
