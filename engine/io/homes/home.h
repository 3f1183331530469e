#pragma once

#include <Eigen/Core>

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack::homes {

/// A home as Sweet Home 3D keeps it in Home.xml: centimetres, the plan's x to the right and y
/// *down* the page, elevations upwards, angles in radians and clockwise on the page. Names are
/// clean text; every number is finite and every size positive.

/// A picture repeated every width x height, in cm.
struct HomeTexture {
    std::string image;  // a name in the home's files
    double width_cm = 100.0;
    double height_cm = 100.0;
};

/// What a surface looks like; linear colour. Neither: the reader's own choice.
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

/// Left and right as one sees them going from start to end.
struct HomeWall {
    Eigen::Vector2d start = Eigen::Vector2d::Zero();
    Eigen::Vector2d end = Eigen::Vector2d::Zero();
    double thickness = 10.0;
    double height = 250.0;
    double height_at_end = 250.0;
    double arc_extent = 0.0;  // radians that a round wall turns; 0: straight, > 0: bulges left
    int at_start = -1;        // the walls joined to it
    int at_end = -1;
    int level = -1;  // index; -1: a home without levels
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

/// A piece of furniture, a lamp, a door or a window. Its model is turned by `model_rotation`,
/// scaled to fill width x depth x height, turned by `angle` and put with the middle of its bottom
/// at `position` and `elevation` above its level. At angle 0 its front looks down the page (+y).
struct HomePiece {
    PieceKind kind = PieceKind::Furniture;
    std::string name;
    std::string catalog_id;  // "eTeks#armchair"
    std::string model;       // a name in the home's files
    Eigen::Vector2d position = Eigen::Vector2d::Zero();
    double elevation = 0.0;
    double angle = 0.0;
    double pitch = 0.0;
    double roll = 0.0;
    double width = 1.0;
    double depth = 1.0;
    double height = 1.0;
    bool mirrored = false;
    bool centered_at_origin = true;  // a turned model is centred after it is turned
    std::optional<Eigen::Matrix3d> model_rotation;
    int level = -1;
    HomeSurface surface;                           // of the whole piece
    std::map<std::string, HomeSurface> materials;  // by the model's names
    std::string wall_cut_out;                      // of an opening: SVG path in its unit square
    std::string floor_cut_out;                     // of a staircase, likewise; empty: none
};

enum class CameraKind { Visitor, Stored, Path };

struct HomeCamera {
    CameraKind kind = CameraKind::Stored;
    std::string name;
    Eigen::Vector2d position = Eigen::Vector2d::Zero();
    double height = 0.0;  // above the plan's 0
    double yaw = 0.0;     // 0: down the page; rises clockwise on the page
    double pitch = 0.0;   // downwards
    double field_of_view = 1.0;
    std::optional<double> time_s;
};

struct Home {
    double wall_height = 250.0;
    std::vector<HomeLevel> levels;
    std::vector<HomeWall> walls;
    std::vector<HomeRoom> rooms;
    std::vector<HomePiece> pieces;  // those of groups, too, each by itself
    std::vector<HomeCamera> cameras;
    std::size_t hidden = 0;  // walls, rooms and pieces left out because they are not shown
};

}  // namespace dollytrack::homes
