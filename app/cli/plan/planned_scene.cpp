#include "app/cli/plan/planned_scene.h"

#include "engine/core/log.h"
#include "engine/core/text_lists.h"
#include "engine/plan/plan_json.h"
#include "planning/collision/allowed_region.h"
#include "planning/free_space/free_space.h"
#include "planning/motions/colliding_frames.h"
#include "planning/pipeline/follow_motion.h"
#include "planning/timing/clip.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace dollytrack::cli {

namespace {

/// Warns about requested anchors that are missing or not visited. If all kinds are requested, only
/// a complete lack is reported.
void warnOfAnchors(const Plan& plan) {
    const auto& anchors = plan.anchors;
    const bool none = !anchors.empty() && std::all_of(anchors.begin(), anchors.end(),
                                                      [](const auto& a) { return a.found == 0; });
    if (none) {
        log::warn("planning", anchors.size() == 1
                                  ? "the scene has no " + anchors[0].kind + " to visit as anchors"
                                  : std::string("the scene has no doorways, openings or corridors "
                                                "to visit as anchors"));
    }
    for (const AnchorTally& one : anchors) {
        if (one.visited >= one.found) continue;
        log::warn("planning",
                  fmt::format("{} of {} {} are not visited: no legal pose, or unreachable",
                              one.found - one.visited, one.found, one.kind));
    }
}

/// Warns if straight lines between frames would hit objects although the path does not. Not if the
/// user chose a frame budget.
void warnOfFewFrames(const Plan& plan, const planning::TimingParams& timing) {
    const int lines = plan.trajectory_metrics.straight_lines_that_hit;
    if (lines == 0 || (timing.max_frames > 0 && !planning::keepsFrameRate(timing))) return;
    log::warn(
        "planning",
        fmt::format(
            "frame_rate is low for this speed: straight lines between frames would collide {} "
            "times, although the path does not; raise frame_rate from {:g}, or set max_speed_mps",
            lines, timing.frame_rate));
}

/// Warns about frames that were left out, about a trajectory of a single frame and, at a kept frame
/// rate, about unused frames if something is left to capture.
void warnOfFrameRate(const Plan& plan, const planning::TimingParams& timing) {
    const CaptureMetrics& captures = plan.capture_metrics;
    const bool all_captured = captures.objects > 0 && captures.captured == captures.objects &&
                              (!plan.surface || plan.surface->covered >= plan.surface->coverable);
    const bool one_frame = plan.trajectory.frames.size() == 1;
    if (all_captured && one_frame) {
        log::warn("planning", "one frame captures every object, so the camera does not move");
    }
    if (all_captured && (one_frame || planning::keepsFrameRate(timing))) return;
    const std::string note = planning::frameRateNote(plan.trajectory, timing);
    if (!note.empty()) log::warn("planning", note);
}

/// Warns about frames with too few image corners for SLAM.
void warnOfFewCorners(const Plan& plan) {
    const std::vector<double>& corners = plan.series.image_corners;
    std::vector<int> few;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        if (corners[i] < kTrackableCorners) few.push_back(static_cast<int>(i));
    }
    if (few.empty()) return;
    log::warn("planning",
              fmt::format("{} of {} frames show too few image corners for SLAM ({}); add pinned "
                          "points that face textured surfaces, or exclude these frames from SLAM",
                          few.size(), corners.size(), frameRanges(few)));
}

/// Whether each path is in a different room, so that exporting by room separates them.
bool roomsPartThem(const std::vector<CameraPath>& paths) {
    std::set<int> components;
    for (const CameraPath& path : paths) components.insert(path.component);
    return components.size() == paths.size();
}

/// Warns about separate motions, which a reader of the poses would take for one motion with jumps.
void warnOfSeparateMotions(const Plan& plan, const planning::ConstraintParams& constraints) {
    if (constraints.rooms != planning::RoomTours::Joined) return;
    std::set<int> motions;
    for (const TrajectoryFrame& frame : plan.trajectory.frames) motions.insert(frame.path);
    if (motions.size() < 2) return;
    log::warn("planning", fmt::format("no collision-free path connects all views: the trajectory "
                                      "has {} separate motions, numbered by 'path' in frames.csv "
                                      "and 'component' in dataset.json{}",
                                      motions.size(),
                                      roomsPartThem(plan.paths)
                                          ? "; --set rooms=each exports each room separately"
                                          : ""));
}

/// Where collisions begin, and with which objects: "; they begin at frames 3, 40, ..., with 'sofa',
/// 'lamp', 'chair' and 3 more"; empty if that is not known.
std::string collisionsText(const Plan& plan, const planning::Pipeline& pipeline, const Scene& scene,
                           double camera_radius_m) {
    constexpr std::size_t kMostNames = 3;
    std::vector<int> begins;
    std::vector<std::string> names;  // in the order of the frames
    for (const auto& one : planning::collidingFrames(plan, *pipeline.rays(), camera_radius_m)) {
        begins.push_back(one.first);
        if (one.object_id == 0) continue;
        std::string name = fmt::format("'{}'", scene.object(one.object_id).name);
        if (std::ranges::find(names, name) == names.end()) names.push_back(std::move(name));
    }
    if (begins.empty()) return {};
    std::string text = "; they begin at " + frameRanges(begins);
    if (!names.empty()) text += ", with " + listOf(names, kMostNames);
    return text;
}

/// Warns about keys that a given motion cannot keep, about its collisions, and about parameters
/// that do not apply to it.
void warnOfMotion(const Plan& plan, const planning::Pipeline& pipeline, const Scene& scene,
                  const planning::PlanParams& params) {
    for (const PassedKey& key : plan.passed_keys) {
        if (!key.note.empty()) log::warn("planning", key.note);
    }
    const int moves = plan.trajectory_metrics.straight_lines_that_hit;
    const double frames = plan.trajectory_metrics.frame_collision_rate *
                          static_cast<double>(plan.trajectory.frames.size());
    if (moves > 0 || frames > 0.0) {
        log::warn("planning", fmt::format("the given camera motion collides in {:.0f} frames and "
                                          "on the way to the next frame {} times{}",
                                          frames, moves,
                                          collisionsText(plan, pipeline, scene,
                                                         params.camera.camera_radius_m)));
    }
    const std::vector<std::string> names = planning::withoutEffectOnMotion(params);
    if (names.empty()) return;
    log::warn("planning", "not applied to the given camera motion: " + listOf(names, names.size()));
}

/// The user setting that leaves no free space; empty if some is free.
std::string whyNothingIsFree(const planning::Pipeline& pipeline,
                             const planning::FreeSpaceParams& band) {
    const auto region = pipeline.region();
    const auto free_space = pipeline.freeSpace();
    if (!region->restricts()) return {};
    if (region->hasLevels()) {
        const auto& cells = region->levels().cells();
        if (std::ranges::any_of(cells, [](const auto& room) { return !room.empty(); })) return {};
        return "the body and the camera do not fit on any floor; lower body_radius_m or "
               "body_height_m, or set camera_height_m above camera_radius_m";
    }
    bool in_band = false;
    bool any = false;
    for (std::size_t room = 0; room < free_space->rooms().size(); ++room) {
        const int component = static_cast<int>(room);
        if (!region->cells(component).empty()) return {};
        for (const Eigen::Vector3f& cell : free_space->cells(component)) {
            any = true;
            if (!region->hasBand()) break;
            const double height = region->heightOf(cell.cast<double>());
            in_band |= height >= band.min_height_m && height <= band.max_height_m;
        }
    }
    if (!any) return {};
    if (region->hasBand() && !in_band) {
        return fmt::format(
            "min_height_m={:g} and max_height_m={:g} leave the camera no free position above the "
            "floor; widen the band",
            band.min_height_m, band.max_height_m);
    }
    return region->hasBand()
               ? "the no-go boxes leave the camera no free position between min_height_m and "
                 "max_height_m; move or shrink them"
               : "the no-go boxes leave the camera no free position; move or shrink them";
}

/// An illegal camera pose for --start or --end is an error; other pins are only dropped.
Status checkEnds(const OpenedScene& opened, const Plan& plan) {
    for (const auto& [option, name] :
         {std::pair("--start", opened.asked_start), std::pair("--end", opened.asked_end)}) {
        if (name.empty()) continue;
        const auto refused = std::ranges::find_if(plan.refused_pins, [&](const RefusedPin& pin) {
            return pin.name == name && pin.verdict != Verdict::Legal;
        });
        if (refused == plan.refused_pins.end()) continue;
        const Eigen::Vector3d& at = opened.plan_edits.pinned[refused->pin].pose.position;
        return fail(ErrorCode::Usage,
                    fmt::format("The camera cannot be at ({:.2f}, {:.2f}, {:.2f}): {}.", at.x(),
                                at.y(), at.z(), refused->reason),
                    option);
    }
    return {};
}

}  // namespace

Result<PlannedScene> planScene(const OpenedScene& opened, planning::Pipeline& pipeline,
                               const JobContext& job) {
    const auto plan = pipeline.run(opened.params, opened.plan_edits, job);
    if (!plan) return tl::unexpected(plan.error());
    if (Status status = checkEnds(opened, **plan); !status) {
        return tl::unexpected(std::move(status.error()));
    }
    for (const RefusedPin& pin : (*plan)->refused_pins) {
        log::warn("planning", "the pinned point \"" + pin.name + "\" is not used: " + pin.reason);
    }
    warnOfFewCorners(**plan);
    if (opened.plan_edits.motion) {
        warnOfMotion(**plan, pipeline, *opened.scene, opened.params);
    } else {
        warnOfAnchors(**plan);
        warnOfFrameRate(**plan, opened.params.timing);
        warnOfFewFrames(**plan, opened.params.timing);
        warnOfSeparateMotions(**plan, opened.params.constraints);
    }
    PlannedScene planned;
    planned.nothing_free = whyNothingIsFree(pipeline, opened.params.free_space);
    planned.scene = opened.scene;
    planned.params = opened.params;
    planned.plan = *plan;
    planned.trajectory = (*plan)->trajectory;
    planned.rooms = (*plan)->rooms;
    planned.metrics = metricsJson(*opened.scene, **plan);
    planned.result = resultJson(*opened.scene, **plan);
    if (const std::string why = whyEmpty(planned); !why.empty()) {
        log::warn("planning", "the trajectory is empty: " + why);
    } else if (!planned.nothing_free.empty()) {
        log::warn("planning", planned.nothing_free);
    }
    return planned;
}

std::string whyEmpty(const PlannedScene& planned) {
    if (!planned.trajectory.frames.empty()) return {};
    if (!planned.nothing_free.empty()) return planned.nothing_free;
    return "nothing can be captured; split objects that contain furniture (operation split of "
           "'dollytrack edit'), or pass --set objective=surface; 'dollytrack info' lists the "
           "objects";
}

Result<PlannedScene> planOrReuse(const OpenedScene& opened, const JobContext& job) {
    if (opened.stored_result.is_null()) {
        planning::Pipeline pipeline(opened.scene);
        return planScene(opened, pipeline, job);
    }
    PlannedScene planned;
    planned.scene = opened.scene;
    planned.params = opened.params;
    planned.result = opened.stored_result;
    planned.metrics = opened.stored_result.value("metrics", nlohmann::json::object());
    Result<Trajectory> trajectory =
        trajectoryFromJson(opened.stored_result.value("trajectory", nlohmann::json::object()));
    if (!trajectory) return tl::unexpected(std::move(trajectory.error()));
    planned.trajectory = std::move(*trajectory);
    if (planned.trajectory.frames.empty()) {  // planned again to find the reason
        planning::Pipeline pipeline(opened.scene);
        return planScene(opened, pipeline, job);
    }
    Result<std::vector<Eigen::AlignedBox3d>> rooms = roomsFromJson(opened.stored_result);
    if (!rooms) return tl::unexpected(std::move(rooms.error()));
    planned.rooms = std::move(*rooms);
    return planned;
}

}  // namespace dollytrack::cli
