#pragma once

#include "engine/camera/trajectory.h"
#include "engine/core/result.h"
#include "engine/io/trajectories/pose_list.h"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace dollytrack::io {

/// What a file's positions are measured in.
enum class FileWorld {
    Scene,   // the scene file's own axes and units
    YUp,     // metres, y up: the axes of camera.json
    ZUp,     // metres, z up: our world
    Ned,     // metres, x north, y east, z down; north is our x
    Camera,  // metres, x right, y down, z forward; forward is our y
};

/// A row of the one table of formats.
struct TrajectoryFormat {
    const char* name;  // as one asks for it
    const char* text;
    FileWorld world;  // what its positions usually are
    Result<PoseList> (*read)(const PoseFile& file);
};

std::span<const TrajectoryFormat> trajectoryFormats();

/// Their names, for people: "tum, kitti, ...".
std::string trajectoryFormatNames();

struct TrajectoryReading {
    std::string format;  // empty: found by name and content
    std::string world;   // "scene", "y-up", "z-up", "ned", "camera"; empty: the format's own
    Eigen::Affine3d source_from_world = Eigen::Affine3d::Identity();  // see Scene
    Eigen::Isometry3d camera_json_from_world = Eigen::Isometry3d::Identity();
    double interval_s = 0.1;  // from frame to frame, where the file has no times
    bool has_options = true;  // --trajectory-format and --trajectory-world are there to be named
};

struct LoadedTrajectory {
    Trajectory trajectory;
    std::string format;
    bool timed = false;              // the times are the file's
    std::optional<double> hfov_deg;  // of its images, where it tells
};

/// Reads a trajectory that some other program wrote, into our world. Errors: Usage for an unknown
/// format or world, with what there is; BadInput, with file and line, also for positions beyond
/// 1000 km and times that do not rise. The file is read once, so it may be a pipe.
Result<LoadedTrajectory> loadTrajectory(const std::filesystem::path& path,
                                        const TrajectoryReading& reading);

}  // namespace dollytrack::io
