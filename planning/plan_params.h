#pragma once

#include "engine/camera/camera_params.h"
#include "engine/camera/picture_params.h"
#include "engine/camera/sensor_params.h"
#include "engine/core/field_list.h"
#include "engine/plan/image_score.h"
#include "engine/scene/light_params.h"
#include "planning/free_space_params.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace dollytrack::planning {

/// The carrier of the camera. A preset sets fields of several sections; see applyCameraPreset().
enum class CameraPreset { Free, Handheld, Drone, Robot };

/// Shape that moves are proven collision-free for: the camera's sphere, or that and a cylinder.
enum class BodyShape { Sphere, Cylinder };

/// Viewing direction while the camera moves: any, or along the motion.
enum class Heading { Free, Along };

/// The carrier of the camera, for example a wheeled robot.
struct BodyParams {
    CameraPreset camera_preset = CameraPreset::Free;
    double camera_height_m = 0.0;
    BodyShape body = BodyShape::Sphere;
    double body_radius_m = 0.2;
    double body_height_m = 0.45;
    double max_step_m = 0.03;
    Heading heading = Heading::Free;
    double max_heading_deg = 30.0;
    bool operator==(const BodyParams&) const = default;
};

template <class Params, class Visitor>
void visitBodyParams(Params& p, Visitor&& visit) {
    visit("camera_preset", p.camera_preset,
          ChoiceInfo{{"free", "handheld", "drone", "robot"},
                     "Kind of camera carrier: sets heights, body, heading, pitch band, radius and "
                     "shake; parameters set explicitly override it"});
    visit("camera_height_m", p.camera_height_m,
          FieldInfo{0, 10, "m",
                    "Exact height of the camera above the floor, for a camera that stays on one "
                    "floor level; 0: free"});
    visit("body", p.body,
          ChoiceInfo{{"sphere", "cylinder"},
                     "Shape that moves are proven collision-free for: the camera's sphere alone, "
                     "or also a cylinder below it that stands on the floor"});
    visit("body_radius_m", p.body_radius_m,
          FieldInfo{0.01, 2, "m", "Radius of the cylinder"}.onlyWith("body=cylinder"));
    visit(
        "body_height_m", p.body_height_m,
        FieldInfo{0.05, 10, "m", "Top of the cylinder above the floor"}.onlyWith("body=cylinder"));
    visit("max_step_m", p.max_step_m,
          FieldInfo{0.001, 0.5, "m",
                    "Height of thresholds and rugs that the cylinder passes over; its bottom is at "
                    "this height"}
              .onlyWith("body=cylinder"));
    visit("heading", p.heading,
          ChoiceInfo{{"free", "along"},
                     "free: the camera looks anywhere while it moves; along: it looks along its "
                     "motion, and stops to turn on the spot"});
    visit("max_heading_deg", p.max_heading_deg,
          FieldInfo{1, 90, "deg", "Largest horizontal angle between viewing direction and motion"}
              .onlyWith("heading=along"));
}

/// Which objects count as small, for grouping by supporting surface (paper, 3.2.2).
struct TargetParams {
    double small_volume_m3 = 0.1;
    double size_ratio = 5.0;
    bool operator==(const TargetParams&) const = default;
};

template <class Params, class Visitor>
void visitTargetParams(Params& p, Visitor&& visit) {
    visit("small_volume_m3", p.small_volume_m3,
          FieldInfo{0.0, 10.0, "m3", "Objects below this volume are small"});
    visit("size_ratio", p.size_ratio,
          FieldInfo{1.0, 1000.0, "",
                    "An object is also small if its supporting surface is this many times larger"});
}

/// Viewing direction and cone in which viewpoints are searched (paper, eq. 1).
struct ViewpointParams {
    double fill = 0.72;
    double yaw_offset_deg = 0.0;
    double pitch_offset_deg = 15.0;
    double cone_half_angle_deg = 40.0;
    bool operator==(const ViewpointParams&) const = default;
};

template <class Params, class Visitor>
void visitViewpointParams(Params& p, Visitor&& visit) {
    visit("fill", p.fill,
          FieldInfo{
              0.1, 1.0, "",
              "Size of the target in the picture: the share of the image's width or height that "
              "it takes; at most 0.45 with trackability",
              "d"});
    visit("yaw_offset_deg", p.yaw_offset_deg,
          FieldInfo{-180, 180, "deg", "Turns the viewing direction about the vertical", "M"});
    visit("pitch_offset_deg", p.pitch_offset_deg,
          FieldInfo{-89, 89, "deg", "Raises the viewing direction", "M"});
    visit("cone_half_angle_deg", p.cone_half_angle_deg,
          FieldInfo{0, 180, "deg", "Half angle of the search cone around that direction", "M"});
}

/// Weights of the priority search that builds the roadmap (paper, Algorithm 1).
struct RoadmapParams {
    double distance_weight = 1.0;
    double size_weight = 0.5;
    int refusal_limit = 5;
    bool operator==(const RoadmapParams&) const = default;
};

template <class Params, class Visitor>
void visitRoadmapParams(Params& p, Visitor&& visit) {
    visit("distance_weight", p.distance_weight,
          FieldInfo{0, 100, "1/m", "Weight of distance in the priority", "\u03bb"});
    visit("size_weight", p.size_weight,
          FieldInfo{0, 100, "1/m", "Weight of the target's size in the priority", "\u03b4"});
    visit("refusal_limit", p.refusal_limit,
          FieldInfo{1, 100, "", "Number of colliding edges after which a sample is abandoned",
                    "step"});
}

/// RRT* that links separate parts of the roadmap (paper, 3.2.3).
struct LinkParams {
    double sample_sigma_m = 0.5;
    int link_iterations = 1500;
    bool operator==(const LinkParams&) const = default;
};

template <class Params, class Visitor>
void visitLinkParams(Params& p, Visitor&& visit) {
    visit("sample_sigma_m", p.sample_sigma_m,
          FieldInfo{0.01, 10, "m", "Standard deviation of the linking samples", "\u03c3"});
    visit("link_iterations", p.link_iterations,
          FieldInfo{1, 1e6, "", "Maximum number of RRT* samples per link"});
}

enum class PathMode { Tour, LongestBranch };

/// Path through the roadmap: a tour of all key frames, or the tree's longest branch.
struct PathParams {
    PathMode path_mode = PathMode::Tour;
    double max_length_m = 0.0;
    bool operator==(const PathParams&) const = default;
};

template <class Params, class Visitor>
void visitPathParams(Params& p, Visitor&& visit) {
    visit("path_mode", p.path_mode,
          ChoiceInfo{{"tour", "longest_branch"},
                     "tour: every key frame; longest_branch: the tree's longest branch (paper)"});
    visit("max_length_m", p.max_length_m,
          FieldInfo{0, 1e5, "m",
                    "Largest total length of the tour with all its parts; objects that add most "
                    "metres are dropped; 0: no limit"});
}

struct SmoothingParams {
    double corner_distance_m = 0.45;
    bool operator==(const SmoothingParams&) const = default;
};

template <class Params, class Visitor>
void visitSmoothingParams(Params& p, Visitor&& visit) {
    visit("corner_distance_m", p.corner_distance_m,
          FieldInfo{0, 5, "m",
                    "Distance before and after a corner at which its Bezier curve starts and ends",
                    "d"});
}

/// Whether the camera avoids views in which a feature detector finds few corners.
/// Auto: on with motion_preset=slam.
enum class Trackability { Auto, Off, On };

/// Viewing directions between key frames.
struct GazeParams {
    double view_mix = 0.9;
    Trackability trackability = Trackability::Auto;
    bool operator==(const GazeParams&) const = default;
};

template <class Params, class Visitor>
void visitGazeParams(Params& p, Visitor&& visit) {
    visit("view_mix", p.view_mix,
          FieldInfo{0, 1, "",
                    "Weight of views that show many objects at once: higher values give more room "
                    "views, and make looking across the room between close views cheaper in "
                    "turning time; 0: close views only"});
    visit("trackability", p.trackability,
          ChoiceInfo{{"auto", "off", "on"},
                     "on: between key frames the camera prefers views with at least about 350 "
                     "estimated corners (in an image of 320 x 240), and key frames are taken with "
                     "fill at most 0.45, so that SLAM does not lose track; auto: on with "
                     "motion_preset=slam"});
}

/// Named sets of motion limits; see motionLimits().
enum class MotionPreset { Easy, Medium, Hard, Custom, Slam };

/// Frame rate, duration and motion limits. A motion limit of 0 stands for the preset's value.
struct TimingParams {
    double frame_rate = 10.0;
    bool keep_frame_rate = false;
    double duration_s = 0.0;
    MotionPreset motion_preset = MotionPreset::Medium;
    double max_speed_mps = 0.0;
    double max_acceleration_mps2 = 0.0;
    double max_turn_dps = 0.0;
    double max_turn_acceleration_dps2 = 0.0;
    double max_image_motion_dps = 0.0;
    int max_frames = 0;
    double max_repeat_rate = 1.0;
    bool operator==(const TimingParams&) const = default;
};

template <class Params, class Visitor>
void visitTimingParams(Params& p, Visitor&& visit) {
    visit("frame_rate", p.frame_rate, FieldInfo{0.1, 1000, "1/s", "Frames per second"});
    visit("keep_frame_rate", p.keep_frame_rate,
          SwitchInfo{"With a budget of frames: keep the frame rate and visit fewer objects instead "
                     "of leaving out frames"});
    visit("duration_s", p.duration_s,
          FieldInfo{0, 1e5, "s",
                    "Duration of the trajectory as a clip at a fixed frame_rate: it visits as many "
                    "objects as the motion limits allow; 0: as long as needed"});
    visit("motion_preset", p.motion_preset,
          ChoiceInfo{
              {"easy", "medium", "hard", "custom", "slam"},
              "Motion limits used where the five below are 0, in m/s, m/s2, deg/s, deg/s2: easy "
              "0.25, 0.4, 20, 60; medium 0.5, 1, 45, 180; hard 1.5, 4, 120, 720; custom: none; "
              "slam: 0.5, 1, 40, 120 and an image motion of 40 deg/s, with the frame rate kept and "
              "trackability on"});
    visit("max_speed_mps", p.max_speed_mps,
          FieldInfo{0, 100, "m/s", "Speed limit; 0: the preset's"});
    visit("max_acceleration_mps2", p.max_acceleration_mps2,
          FieldInfo{0, 1000, "m/s2", "Acceleration limit, also in curves; 0: the preset's"});
    visit("max_turn_dps", p.max_turn_dps,
          FieldInfo{0, 3600, "deg/s", "Turning rate limit; 0: the preset's"});
    visit("max_turn_acceleration_dps2", p.max_turn_acceleration_dps2,
          FieldInfo{0, 1e5, "deg/s2", "Limit of turning acceleration; 0: the preset's"});
    visit("max_image_motion_dps", p.max_image_motion_dps,
          FieldInfo{0, 3600, "deg/s",
                    "The camera slows down where turning or passing near objects would move the "
                    "image faster than this, averaged between two views; 0: the preset's limit, if "
                    "any"}
              .onlyWith("heading=free"));
    visit(
        "max_frames", p.max_frames,
        FieldInfo{
            0, 1e6, "",
            "Largest number of frames. Frames between views are left out, mostly where few objects "
            "are in view. A small number also leaves out room views, which shortens the path. With "
            "a fixed frame rate, fewer objects are visited. 0: no limit"});
    visit("max_repeat_rate", p.max_repeat_rate,
          FieldInfo{
              0, 1, "",
              "Leaves out frames that show nothing new until they are at most this share of all. "
              "Without effect where the views of objects and rooms alone repeat more; 1: any share"}
              .onlyWith("max_frames>0"));
}

enum class ShakeKind { None, Sinusoidal, Handheld };

/// Shake added to the trajectory; see shakeTrajectory().
struct ShakeParams {
    ShakeKind shake = ShakeKind::None;
    double shake_amplitude_m = 0.01;
    double shake_amplitude_deg = 1.0;
    double shake_hz = 1.0;
    bool operator==(const ShakeParams&) const = default;
};

template <class Params, class Visitor>
void visitShakeParams(Params& p, Visitor&& visit) {
    visit("shake", p.shake,
          ChoiceInfo{{"none", "sinusoidal", "handheld"},
                     "Shakes the camera along and about its axes, without collisions"});
    visit("shake_amplitude_m", p.shake_amplitude_m,
          FieldInfo{0, 1, "m", "Largest shift along each axis"}.onlyWith(
              "shake=sinusoidal|handheld"));
    visit("shake_amplitude_deg", p.shake_amplitude_deg,
          FieldInfo{0, 45, "deg", "Largest rotation about each axis"}.onlyWith(
              "shake=sinusoidal|handheld"));
    visit(
        "shake_hz", p.shake_hz,
        FieldInfo{0.01, 50, "Hz", "Frequency of the shake"}.onlyWith("shake=sinusoidal|handheld"));
}

/// Weights of the paper's image score, and the repair of frames that score low (paper, 3.2.4).
struct RepairParams {
    ScoreWeights score;
    double score_threshold = 0.5;
    int repair_rounds = 0;
    bool drop_low_frames = false;
    bool operator==(const RepairParams&) const = default;
};

template <class Params, class Visitor>
void visitRepairParams(Params& p, Visitor&& visit) {
    visit(
        "separation_weight", p.score.separation,
        FieldInfo{0, 100, "", "Weight of the separation of objects in a frame's score", "\u03bb"});
    visit("continuity_weight", p.score.continuity,
          FieldInfo{0, 100, "",
                    "Weight of the number of objects shown, compared with preceding frames",
                    "\u03bc"});
    visit("score_window", p.score.window,
          FieldInfo{1, 100, "", "Number of preceding frames a frame is compared with", "s"});
    visit("squared_separation", p.score.squared,
          SwitchInfo{"Square the distance between boxes, as in D-IoU"});
    visit("score_threshold", p.score_threshold,
          FieldInfo{0, 1, "",
                    "A frame is low-scoring below this share of the trajectory's median score"});
    visit("repair_rounds", p.repair_rounds,
          FieldInfo{0, 20, "",
                    "Rounds in which low-scoring frames are repaired, by look-aside views, then by "
                    "detours; 0: none"});
    visit("drop_low_frames", p.drop_low_frames,
          SwitchInfo{"Drop frames that are still low-scoring, unless an object needs them"});
}

/// Sampling rate of the IMU measurements that an export writes beside the poses.
struct ImuParams {
    double imu_rate_hz = 200.0;
    bool operator==(const ImuParams&) const = default;
};

template <class Params, class Visitor>
void visitImuParams(Params& p, Visitor&& visit) {
    visit("imu_rate_hz", p.imu_rate_hz, FieldInfo{1, 10000, "Hz", "Samples per second in imu.csv"});
}

/// Stereo baseline of an export with two cameras.
struct StereoParams {
    double stereo_baseline_m = 0.1;
    bool operator==(const StereoParams&) const = default;
};

template <class Params, class Visitor>
void visitStereoParams(Params& p, Visitor&& visit) {
    visit("stereo_baseline_m", p.stereo_baseline_m,
          FieldInfo{0.001, 10, "m",
                    "Distance from the left camera, which follows the trajectory, to the right "
                    "one; beyond camera_radius_m the right one is not kept clear of obstacles"});
}

/// Openings that the trajectory visits in addition to its objects.
enum class Anchors { None, Doorways, Openings, Corridors, All };

/// One trajectory through all connected rooms, or one trajectory for each room.
enum class RoomTours { Joined, Each };

/// Constraints of the trajectory: pitch band, closed loop, openings to visit, rooms.
struct ConstraintParams {
    double min_pitch_deg = -90.0;
    double max_pitch_deg = 90.0;
    bool loop = false;
    Anchors anchors = Anchors::None;
    RoomTours rooms = RoomTours::Joined;
    bool operator==(const ConstraintParams&) const = default;
};

template <class Params, class Visitor>
void visitConstraintParams(Params& p, Visitor&& visit) {
    visit("min_pitch_deg", p.min_pitch_deg,
          FieldInfo{-90, 90, "deg", "The camera never looks lower; -90: straight down"});
    visit("max_pitch_deg", p.max_pitch_deg,
          FieldInfo{-90, 90, "deg", "The camera never looks higher; 90: straight up"});
    visit("loop", p.loop, SwitchInfo{"The trajectory ends where it starts"});
    visit("anchors", p.anchors,
          ChoiceInfo{{"none", "doorways", "openings", "corridors", "all"},
                     "What the trajectory visits besides objects: it goes through doorways, looks "
                     "out of openings and looks along corridors from both ends"});
    visit("rooms", p.rooms,
          ChoiceInfo{{"joined", "each"},
                     "joined: one trajectory through all connected rooms; each: one per room, each "
                     "exported to its own folder"});
}

/// The purpose of the key frames: good views of the objects, coverage of all surface, or both.
enum class Objective { Objects, Surface, Both };

/// Purpose of the key frames, and how surface shall be seen.
struct CoverageParams {
    Objective objective = Objective::Objects;
    int surface_directions = 3;
    double surface_mm_px = 10.0;
    bool operator==(const CoverageParams&) const = default;
};

template <class Params, class Visitor>
void visitCoverageParams(Params& p, Visitor&& visit) {
    visit("objective", p.objective,
          ChoiceInfo{{"objects", "surface", "both"},
                     "What key frames are for: objects: good views of each object; surface: all "
                     "surface that can be seen, for reconstruction and mapping; both: objects "
                     "first, then the surface that their views do not cover"});
    visit("surface_directions", p.surface_directions,
          FieldInfo{1, 8, "",
                    "For objective=surface or both, and for measuring surface with --quality: "
                    "directions, at least 15 degrees apart, from which each piece of surface shall "
                    "be seen"});
    visit("surface_mm_px", p.surface_mm_px,
          FieldInfo{0.1, 1000, "mm",
                    "For the same: largest width of a pixel on the surface, measured across the "
                    "line of sight"});
}

/// All parameters of a plan and of the images rendered from it. Field names are unique across the
/// sections.
struct PlanParams {
    BodyParams body;
    CameraParams camera;
    FreeSpaceParams free_space;
    ConstraintParams constraints;
    CoverageParams coverage;
    TargetParams targets;
    ViewpointParams viewpoints;
    RoadmapParams roadmap;
    LinkParams linking;
    PathParams path;
    SmoothingParams smoothing;
    GazeParams gaze;
    TimingParams timing;
    ShakeParams shake;
    RepairParams repair;
    ImuParams imu;
    StereoParams stereo;
    PictureParams picture;
    LightParams light;
    SensorParams sensor;
    int seed = 1;
    bool operator==(const PlanParams&) const = default;
};

/// Visits every field. Calls `section(name)` before the fields of each section.
template <class Params, class Section, class Visitor>
void visitPlanParams(Params& p, Section&& section, Visitor&& visit) {
    section("body");  // comes first because its preset sets fields of other sections
    visitBodyParams(p.body, visit);
    section("camera");
    visitCameraParams(p.camera, visit);
    section("free_space");
    visitFreeSpaceParams(p.free_space, visit);
    section("constraints");
    visitConstraintParams(p.constraints, visit);
    section("coverage");
    visitCoverageParams(p.coverage, visit);
    section("targets");
    visitTargetParams(p.targets, visit);
    section("viewpoints");
    visitViewpointParams(p.viewpoints, visit);
    section("roadmap");
    visitRoadmapParams(p.roadmap, visit);
    section("linking");
    visitLinkParams(p.linking, visit);
    section("path");
    visitPathParams(p.path, visit);
    section("smoothing");
    visitSmoothingParams(p.smoothing, visit);
    section("gaze");
    visitGazeParams(p.gaze, visit);
    section("timing");
    visitTimingParams(p.timing, visit);
    section("shake");
    visitShakeParams(p.shake, visit);
    section("repair");
    visitRepairParams(p.repair, visit);
    section("imu");
    visitImuParams(p.imu, visit);
    section("stereo");
    visitStereoParams(p.stereo, visit);
    section("picture");
    visitPictureParams(p.picture, visit);
    section("light");
    visitLightParams(p.light, visit);
    section("sensor");
    visitSensorParams(p.sensor, visit);
    section("random");
    visit("seed", p.seed, FieldInfo{0, 2147483647, "", "Random seed"});
}

/// Whether the parameters of a section affect only the images and files of an export, not the plan.
[[nodiscard]] bool affectsOnlyImages(std::string_view section);

/// Returns the parameters with those of images at their defaults; see affectsOnlyImages().
[[nodiscard]] PlanParams onlyOfThePlan(PlanParams params);

/// Whether both give the same plan. They may differ in the parameters of images.
[[nodiscard]] bool makeSamePlan(const PlanParams& a, const PlanParams& b);

/// Sets the body, camera radius, height band, pitch band and shake kind to the values of
/// params.body.camera_preset.
void applyCameraPreset(PlanParams& params);

/// The distance at which a pixel is surface_mm_px wide across the line of sight, m.
[[nodiscard]] double sharpWithin_m(const PlanParams& params);

/// Whether the objective includes surface.
[[nodiscard]] inline bool asksForSurface(const PlanParams& params) {
    return params.coverage.objective != Objective::Objects;
}

/// The largest ViewpointParams::fill with trackability: key frames then show an object with its
/// surroundings.
inline constexpr double kFillForTrackability = 0.45;

/// Whether views with few corners are avoided; see Trackability.
[[nodiscard]] inline bool asksForTrackability(const GazeParams& gaze, const TimingParams& timing) {
    return gaze.trackability == Trackability::On ||
           (gaze.trackability == Trackability::Auto && timing.motion_preset == MotionPreset::Slam);
}

/// The parameter `fill`, limited to kFillForTrackability if trackability is asked for.
[[nodiscard]] inline double usedFill(const PlanParams& params) {
    const double fill = params.viewpoints.fill;
    return asksForTrackability(params.gaze, params.timing) ? std::min(fill, kFillForTrackability)
                                                           : fill;
}

/// Checks constraints between fields. Error: Usage, naming the field.
Status validate(const PlanParams& params);

/// Sets one parameter in a project's JSON sections and fills in all other fields: those already
/// given keep their value, the rest get their default. A preset also replaces the fields that it
/// sets. Error: BadInput, from setFromJson().
Status setParameter(nlohmann::json& sections, const std::string& name, const nlohmann::json& value);

/// All fields of `params`, for project files, `--set` and widgets. The list points into `params`.
FieldList listFields(PlanParams& params);

/// The fields with different values, by name, with their values in `b` as text.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> changedFields(PlanParams a,
                                                                             PlanParams b);

}  // namespace dollytrack::planning
