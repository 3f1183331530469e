#include "engine/plan/plan_json.h"

#include "engine/io/files/bounded_json.h"
#include "engine/plan/frame_quality.h"
#include "engine/plan/ledger_json.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace dollytrack {
namespace {

using nlohmann::json;

json vectorJson(const Eigen::Vector3d& v) {
    return json::array({v.x(), v.y(), v.z()});
}

json poseJson(const Pose& pose) {
    const Eigen::Quaterniond& q = pose.rotation;
    return {{"position", vectorJson(pose.position)},
            {"quaternion_xyzw", json::array({q.x(), q.y(), q.z(), q.w()})}};
}

Eigen::Vector3d vectorFrom(const json& value) {
    return {value.at(0).get<double>(), value.at(1).get<double>(), value.at(2).get<double>()};
}

json names(const Scene& scene, const std::vector<int>& ids) {
    json list = json::array();
    for (const int id : ids) list.push_back(scene.object(id).name);
    return list;
}

json pathJson(const CameraPath& path) {
    json vertices = json::array();
    for (const PathVertex& vertex : path.vertices) {
        vertices.push_back(
            {{"position", vectorJson(vertex.position)}, {"position_point", vertex.position_point}});
    }
    return {{"component", path.component}, {"vertices", std::move(vertices)}};
}

/// One entry per room that has its own trajectory.
json roomToursJson(const Plan& plan) {
    json list = json::array();
    for (std::size_t room = 0; room < plan.tour_rooms.size(); ++room) {
        std::vector<int> paths;
        double length_m = 0.0;
        for (std::size_t p = 0; p < plan.paths.size(); ++p) {
            if (plan.paths[p].room != static_cast<int>(room)) continue;
            paths.push_back(static_cast<int>(p));
            length_m += plan.smooth_paths[p].length_m;
        }
        if (paths.empty()) continue;
        const auto inRoom = [&](const TrajectoryFrame& frame) {
            return std::find(paths.begin(), paths.end(), frame.path) != paths.end();
        };
        const auto& frames = plan.trajectory.frames;
        const TourRoom& one = plan.tour_rooms[room];
        list.push_back({{"name", one.name},
                        {"low", vectorJson(one.box.min())},
                        {"high", vectorJson(one.box.max())},
                        {"paths", paths},
                        {"frames", std::count_if(frames.begin(), frames.end(), inRoom)},
                        {"path_length_m", length_m}});
    }
    return list;
}

/// The list of all published capture metrics.
template <class Metrics, class Visitor>
void visitMetrics(Metrics& m, Visitor&& visit) {
    visit("objects", m.objects);
    visit("captured", m.captured);
    visit("well_captured", m.well_captured);
    visit("capture_rate", m.capture_rate);
    visit("well_captured_rate", m.well_captured_rate);
    visit("small_capture_rate", m.small_capture_rate);
    visit("area_share_box", m.area_share_box);
    visit("area_share_mask", m.area_share_mask);
}

}  // namespace

json captureMetricsJson(const CaptureMetrics& metrics) {
    json result;
    visitMetrics(metrics, [&](const char* name, const auto& value) { result[name] = value; });
    // Without objects, rates are undefined.
    if (metrics.objects == 0) {
        for (const char* name : {"capture_rate", "well_captured_rate", "small_capture_rate",
                                 "area_share_box", "area_share_mask"}) {
            result[name] = nullptr;
        }
    }
    return result;
}

Result<CaptureMetrics> captureMetricsFromJson(const json& value) {
    CaptureMetrics metrics;
    try {
        visitMetrics(metrics, [&](const char* name, auto& field) {
            if (const json& one = value.at(name); !one.is_null()) one.get_to(field);
        });
    } catch (const json::exception& e) {
        return fail(ErrorCode::BadInput,
                    fmt::format("A field is missing or of the wrong type ({}).", plainReason(e)),
                    "metrics");
    }
    return metrics;
}

json tallyJson(const ScoreTally& tally) {
    return {{"frames", tally.frames}, {"low", tally.low}, {"mean_score", tally.mean}};
}

json repairJson(const RepairReport& report) {
    return {{"rounds", report.rounds},
            {"threshold", report.threshold},
            {"before", tallyJson(report.before)},
            {"after", tallyJson(report.after)},
            {"glances", report.look_asides},
            {"replanned", report.replanned},
            {"dropped", report.dropped}};
}

namespace {

/// Metrics of the trajectory's motion and clearance.
json motionJson(const Scene& scene, const Plan& plan) {
    const TrajectoryMetrics& motion = plan.trajectory_metrics;
    json result = {
        {"repeat_rate", motion.repeat_rate},
        {"object_pixels", motion.object_pixels},
        {"corner_collision_rate", motion.corner_collision_rate},
        {"frame_collision_rate", motion.frame_collision_rate},
        {"straight_lines_that_hit", motion.straight_lines_that_hit},
        {"min_clearance_m", motion.minimum_clearance.clearance_m},
        {"path_length_m", motion.path_length_m},
        {"frames", plan.trajectory.frames.size()},
        {"frame_interval_s", plan.trajectory.frame_interval_s},
        {"duration_s", durationOf(plan.trajectory)},
        {"key_frames", std::count_if(plan.trajectory.frames.begin(), plan.trajectory.frames.end(),
                                     [](const auto& frame) { return frame.position_point >= 0; })},
    };
    if (plan.trajectory.frames.empty()) {
        for (const char* name :
             {"repeat_rate", "object_pixels", "corner_collision_rate", "frame_collision_rate"}) {
            result[name] = nullptr;
        }
    }
    if (plan.given_motion) {
        result["given_motion"] = true;
        result["corner_collision_rate"] = nullptr;  // nothing was rounded
    }
    if (motion.minimum_clearance.object_id == 0) {
        result["min_clearance_m"] = nullptr;
    } else {
        result["min_clearance_at"] = {
            {"position", vectorJson(motion.minimum_clearance.position)},
            {"object", scene.object(motion.minimum_clearance.object_id).name},
            {"frame", motion.minimum_clearance.frame}};
    }
    visitMotionMetrics(motion.motion,
                       [&](const std::string& name, double value) { result[name] = value; });
    if (motion.trackable_rate) result["trackable_rate"] = *motion.trackable_rate;
    return result;
}

/// Adds the rows of must-see regions, and the least of their rates.
void addMustSee(json& metrics, const std::vector<RegionCoverage>& regions) {
    double least = 1.0;
    for (const RegionCoverage& one : regions) {
        least = std::min(least, one.rate());
        metrics["must_see"].push_back({{"region", one.name},
                                       {"patches", one.patches},
                                       {"seeable", one.seeable},
                                       {"seen", one.seen},
                                       {"rate", one.rate()}});
    }
    metrics["must_see_rate"] = least;  // 1 if there is no must-see region
}

}  // namespace

json metricsJson(const Scene& scene, const Plan& plan) {
    json result = captureMetricsJson(plan.capture_metrics);
    result.update(motionJson(scene, plan));
    result.update({
        {"map_ms", plan.map_ms},
        {"plan_ms", plan.plan_ms},
        {"stages", json::object()},
        {"uncaptured", uncapturedJson(scene, plan.ledger)},
        {"not_well_captured", json::array()},
        {"refused_pins", json::array()},
        {"ledger", ledgerJson(scene, plan.ledger)},
        {"repair", repairJson(plan.repair)},
    });
    const bool has_small = std::ranges::any_of(plan.captures, [&](const ObjectCapture& row) {
        return isSmallTarget(scene.object(row.object_id));
    });
    if (!has_small) result["small_capture_rate"] = nullptr;
    for (const PassedKey& key : plan.passed_keys) {
        json& one =
            result["camera_keys"].emplace_back(json{{"frame", key.frame}, {"time_s", key.time_s}});
        if (!key.note.empty()) one["note"] = key.note;
    }
    for (const StageTime& stage : plan.stages) result["stages"][stage.name] = stage.milliseconds;
    for (const LedgerRow& row : plan.ledger) {
        if (!row.captured || row.well_captured) continue;
        result["not_well_captured"].push_back(scene.object(row.object_id).name);
    }
    for (const RefusedPin& one : plan.refused_pins) {
        result["refused_pins"].push_back({{"point", one.name}, {"reason", one.reason}});
    }
    addMustSee(result, plan.must_see);
    for (const AnchorTally& one : plan.anchors) {
        result["anchors"].push_back(
            {{"kind", one.kind}, {"found", one.found}, {"visited", one.visited}});
    }
    if (plan.surface) addSurface(result, *plan.surface);
    if (!plan.tour_rooms.empty()) result["rooms"] = roomToursJson(plan);
    if (plan.scanned_share) result["scanned_share"] = *plan.scanned_share;
    return result;
}

void addBound(json& metrics, const CaptureBound& bound, double milliseconds) {
    metrics["capturable_rate"] = bound.capturable_rate;
    metrics["well_capturable_rate"] = bound.well_capturable_rate;
    const auto missed = [&](const char* how, const std::vector<int>& impossible) {
        json names = json::array();
        for (const json& row : metrics.value("ledger", json::array())) {
            const int id = row.at("id").get<int>();
            const bool possible = std::ranges::find(impossible, id) == impossible.end();
            if (possible && !row.at(how).get<bool>()) names.push_back(row.at("object"));
        }
        return names;
    };
    metrics["missed_capturable"] = missed("captured", bound.not_capturable);
    metrics["missed_well_capturable"] = missed("well_captured", bound.not_well_capturable);
    metrics["bound_ms"] = milliseconds;
}

json trajectoryJson(const Trajectory& trajectory) {
    const auto listed = [](const std::vector<TrajectoryFrame>& frames) {
        json list = json::array();
        for (const TrajectoryFrame& frame : frames) {
            json one = poseJson(frame.pose);
            one["time_s"] = frame.time_s;
            one["target"] = vectorJson(frame.target_in_world);
            one["component"] = frame.component;
            one["path"] = frame.path;
            one["position_point"] = frame.position_point;
            list.push_back(std::move(one));
        }
        return list;
    };
    json result = {{"frame_interval_s", trajectory.frame_interval_s},
                   {"frames", listed(trajectory.frames)}};
    if (!trajectory.left_out.empty()) result["left_out"] = listed(trajectory.left_out);
    return result;
}

Result<Trajectory> trajectoryFromJson(const json& value) {
    Trajectory trajectory;
    constexpr double kLongestInterval_s = 1e5;
    constexpr double kLatest_s = 1e7;
    std::string where = "trajectory";
    const auto readFrames = [&](const char* list, std::vector<TrajectoryFrame>& frames) {
        for (const json& one : value.at(list)) {
            where = fmt::format("trajectory {} {}", list, frames.size());
            TrajectoryFrame& frame = frames.emplace_back();
            frame.time_s = one.at("time_s").get<double>();
            frame.pose.position = vectorFrom(one.at("position"));
            const json& q = one.at("quaternion_xyzw");
            frame.pose.rotation = Eigen::Quaterniond(q.at(3).get<double>(), q.at(0).get<double>(),
                                                     q.at(1).get<double>(), q.at(2).get<double>());
            frame.target_in_world = vectorFrom(one.at("target"));
            frame.component = one.value("component", 0);
            frame.path = one.value("path", 0);
            frame.position_point = one.value("position_point", -1);
            const double norm = frame.pose.rotation.norm();
            const double last_s = frames.size() > 1 ? frames.end()[-2].time_s : -kLatest_s;
            if (!frame.pose.position.allFinite() || !(std::abs(norm - 1.0) < 1e-3) ||
                !(frame.time_s >= last_s && frame.time_s <= kLatest_s)) {
                return false;
            }
            // Normalized only if necessary, so that poses written by Dollytrack keep their bits.
            if (std::abs(norm - 1.0) > 1e-9) frame.pose.rotation.normalize();
        }
        return true;
    };
    try {
        trajectory.frame_interval_s = value.at("frame_interval_s").get<double>();
        if (!(trajectory.frame_interval_s > 0.0 &&
              trajectory.frame_interval_s <= kLongestInterval_s)) {
            return fail(ErrorCode::BadInput, "frame_interval_s is not above 0 and at most 1e5.",
                        where);
        }
        if (!readFrames("frames", trajectory.frames) ||
            (value.contains("left_out") && !readFrames("left_out", trajectory.left_out))) {
            return fail(ErrorCode::BadInput,
                        "The pose is not finite, its quaternion does not have length 1, or its "
                        "time is before that of the previous frame or out of range.",
                        where);
        }
    } catch (const json::exception& e) {
        return fail(ErrorCode::BadInput,
                    fmt::format("A field is missing or of the wrong type ({}).", plainReason(e)),
                    where);
    }
    return trajectory;
}

json withoutTimes(json metrics) {
    for (const char* name : {"map_ms", "plan_ms", "bound_ms", "stages"}) metrics.erase(name);
    return metrics;
}

Result<std::vector<Eigen::AlignedBox3d>> roomsFromJson(const json& result) {
    std::vector<Eigen::AlignedBox3d> rooms;
    try {
        for (const json& room : result.value("rooms", json::array())) {
            rooms.emplace_back(vectorFrom(room.at("low")), vectorFrom(room.at("high")));
        }
    } catch (const json::exception& e) {
        return fail(ErrorCode::BadInput,
                    fmt::format("A field is missing or of the wrong type ({}).", plainReason(e)),
                    fmt::format("room {}", rooms.size()));
    }
    return rooms;
}

json resultJson(const Scene& scene, const Plan& plan) {
    json result;
    result["metrics"] = withoutTimes(metricsJson(scene, plan));
    for (const Eigen::AlignedBox3d& room : plan.rooms) {
        result["rooms"].push_back(
            {{"low", vectorJson(room.min())}, {"high", vectorJson(room.max())}});
    }
    result["trajectory"] = trajectoryJson(plan.trajectory);
    for (const ObservationPoint& point : plan.observation_points) {
        result["observation_points"].push_back({{"kind", name(point.kind)},
                                                {"position", vectorJson(point.position)},
                                                {"direction", vectorJson(point.direction)},
                                                {"objects", names(scene, point.objects)},
                                                {"carrier", point.supporter}});
    }
    for (const PositionPoint& point : plan.position_points) {
        json one = poseJson(point.pose);
        one["observation_point"] = point.observation_point;
        one["component"] = point.component;
        one["fill"] = point.fill;
        one["well_captured"] = names(scene, point.well_captured);
        one["captured"] = names(scene, point.captured);
        if (point.pin >= 0) one["pin"] = point.pin;
        if (point.room_view) one["room_view"] = true;
        if (point.surface_view) one["surface_view"] = true;
        result["position_points"].push_back(std::move(one));
    }
    result["key_frames"] = plan.key_frames;
    for (const CameraPath& path : plan.paths) result["paths"].push_back(pathJson(path));
    return result;
}

}  // namespace dollytrack
