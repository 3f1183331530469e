#pragma once

#include "engine/camera/trajectory.h"
#include "engine/core/result.h"
#include "engine/io/trajectories/pose_list.h"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace dollytrack {

/// The coordinate system of a file's positions.
enum class FileWorld {
    Scene,   // the scene file's axes and unit
    YUp,     // metres, y up: the axes of camera.json
    ZUp,     // metres, z up: the scene's world
    Ned,     // metres, x north, y east, z down; north is the world's x
    Camera,  // metres, x right, y down, z forward; forward is the world's y
};

/// A supported format.
struct TrajectoryFormat {
    const char* name;  // on the command line
    const char* text;  // description
    FileWorld world;   // default coordinate system
    Result<PoseList> (*read)(const PoseFile& file);
};

std::span<const TrajectoryFormat> trajectoryFormats();

/// The names of all formats as text: "tum, kitti, ...".
std::string trajectoryFormatNames();

struct TrajectoryReading {
    std::string format;  // empty: detected by file name and content
    std::string world;   // "scene", "y-up", "z-up", "ned", "camera"; empty: the format's default
    Eigen::Affine3d source_from_world = Eigen::Affine3d::Identity();  // see Scene
    Eigen::Isometry3d camera_json_from_world = Eigen::Isometry3d::Identity();
    double interval_s = 0.1;  // frame interval, if the file has no times
    bool has_options = true;  // whether errors may suggest --trajectory-format and
                              // --trajectory-world
};

struct LoadedTrajectory {
    Trajectory trajectory;
    std::string format;
    bool timed = false;              // whether the times are from the file
    std::optional<double> hfov_deg;  // of its images, if the file contains it
};

/// Reads a trajectory of another program and converts it to the scene's world. The file is read
/// once, so it may be a pipe. Errors: Usage for an unknown format or world; BadInput, with file and
/// line, also for positions beyond 1000 km and times that do not increase.
Result<LoadedTrajectory> loadTrajectory(const std::filesystem::path& path,
                                        const TrajectoryReading& reading);

/// A line of a TUM trajectory, without its line end: "timestamp tx ty tz qx qy qz qw", seconds with
/// six decimals and the pose, world_from_camera, with nine.
[[nodiscard]] std::string tumLine(double time_s, const Pose& pose);

/// A trajectory as the text of a TUM file: a comment that names the columns, and a line per frame.
/// The world has z up and is in metres; the camera's x points right, y down, z forward.
[[nodiscard]] std::string tumText(const Trajectory& trajectory);

}  // namespace dollytrack
