#include "engine/io/settings/stored_plan.h"

#include "engine/document/json_reader.h"
#include "engine/plan/motion_metrics.h"

#include <limits>

namespace dollytrack {
namespace {

using nlohmann::json;

/// The part of planForm() about metrics that are lists or objects.
json metricListsForm() {
    const json tally = {{"frames!", "count"}, {"low!", "count"}, {"mean_score!", "number"}};
    const json remedy = {{"text", "text"},
                         {"well", "flag"},
                         {"set", {"text"}},
                         {"pin", {{"position!", "point"}, {"quaternion_xyzw!", "quaternion"}}},
                         {"remove_no_go", "text"},
                         {"unpin", "text"},
                         {"restore_point", "flag"},
                         {"move", "text"},
                         {"operations", {json::object()}}};
    const json ledger_row = {
        {"object!", "text"},     {"id!", "count"},           {"class", "text"},
        {"captured!", "flag"},   {"well_captured!", "flag"}, {"frame", "count"},
        {"time_s", "number"},    {"key_frame", "flag"},      {"visible_fraction", "number"},
        {"box_share", "number"}, {"mask_share", "number"},   {"distance_m", "number"},
        {"loss", "text"},        {"reason", "text"},         {"occluder", "text"},
        {"remedy", remedy}};
    const json room_tour = {{"name!", "text"},   {"low", "point"},
                            {"high", "point"},   {"paths!", {"count"}},
                            {"frames", "count"}, {"path_length_m", "number"}};
    return {
        {"uncaptured", {{{"object", "text"}, {"id", "count"}, {"reason", "text"}}}},
        {"refused_pins", {{{"point", "text"}, {"reason", "text"}}}},
        {"must_see",
         {{{"region", "text"},
           {"patches", "count"},
           {"seeable", "count"},
           {"seen", "count"},
           {"rate", "number"}}}},
        {"camera_keys", {{{"frame!", "count"}, {"time_s!", "number"}, {"note", "text"}}}},
        {"anchors", {{{"kind", "text"}, {"found", "count"}, {"visited", "count"}}}},
        {"min_clearance_at", {{"position!", "point"}, {"object!", "text"}, {"frame!", "count"}}},
        {"repair",
         {{"rounds", "count"},
          {"threshold", "number"},
          {"before!", tally},
          {"after!", tally},
          {"glances", "count"},
          {"replanned", "count"},
          {"dropped", "count"}}},
        {"ledger", {ledger_row}},
        {"rooms", {room_tour}}};
}

/// The part of planForm() about all metrics.
json metricsForm() {
    json metrics = metricListsForm();
    for (const char* name :
         {"objects", "captured", "well_captured", "frames", "key_frames", "straight_lines_that_hit",
          "surface_patches", "untrackable_frames", "wide_gaps"}) {
        metrics[name] = "count";
    }
    for (const char* name :
         {"capture_rate", "well_captured_rate", "small_capture_rate", "area_share_box",
          "area_share_mask", "repeat_rate", "corner_collision_rate", "frame_collision_rate",
          "must_see_rate", "capturable_rate", "well_capturable_rate", "scanned_share",
          "surface_seen_rate", "surface_covered_rate", "surface_coverable_rate", "trackable_rate",
          "overlap_median_rate", "overlap_min_rate"}) {
        metrics[name] = "rate?";
    }
    for (const char* name : {"object_pixels", "min_clearance_m"}) metrics[name] = "number?";
    for (const char* name :
         {"path_length_m", "frame_interval_s", "duration_s", "surface_patch_m"}) {
        metrics[name] = "number";
    }
    for (const char* name : {"not_well_captured", "missed_capturable", "missed_well_capturable"}) {
        metrics[name] = {"text"};
    }
    MotionMetrics motion;
    visitMotionMetrics(motion, [&](const std::string& name, double) { metrics[name] = "number"; });
    return metrics;
}

/// The schema of a stored plan. A text is the type of a value, a rate being a number from 0 to 1;
/// "?" permits null. All entries of a list have the same schema. Members of an object are optional
/// unless their name ends in "!".
json planForm() {
    const json frame = {{"position!", "point"},       {"quaternion_xyzw!", "quaternion"},
                        {"time_s!", "number"},        {"target!", "point"},
                        {"component", "integer"},     {"path", "integer"},
                        {"position_point", "integer"}};
    const json position_point = {{"position!", "point"},
                                 {"quaternion_xyzw!", "quaternion"},
                                 {"observation_point", "integer"},
                                 {"component", "integer"},
                                 {"fill", "number"},
                                 {"well_captured", {"text"}},
                                 {"captured", {"text"}},
                                 {"pin", "integer"},
                                 {"room_view", "flag"},
                                 {"surface_view", "flag"}};
    return {{"metrics", metricsForm()},
            {"rooms", {{{"low!", "point"}, {"high!", "point"}}}},
            {"trajectory",
             {{"frame_interval_s!", "number"}, {"frames!", {frame}}, {"left_out", {frame}}}},
            {"observation_points",
             {{{"kind", "text"},
               {"position", "point"},
               {"direction", "point"},
               {"objects", {"text"}},
               {"carrier", "integer"}}}},
            {"position_points", {position_point}},
            {"key_frames", {"integer"}},
            {"paths",
             {{{"component!", "integer"},
               {"vertices!", {{{"position!", "point"}, {"position_point!", "integer"}}}}}}}};
}

void checkValue(const JsonReader& from, std::string_view type) {
    constexpr int kMost = std::numeric_limits<int>::max();
    constexpr double kLargest = std::numeric_limits<double>::max();
    if (type.ends_with('?') && from.absent()) return;
    if (type == "count") {
        static_cast<void>(from.integer(0, kMost));
    } else if (type == "integer") {
        static_cast<void>(from.integer(-kMost, kMost));
    } else if (type == "rate?") {
        static_cast<void>(from.number(0.0, 1.0));
    } else if (type.starts_with("number")) {
        static_cast<void>(from.number(-kLargest, kLargest));
    } else if (type == "text") {
        static_cast<void>(from.text());
    } else if (type == "flag") {
        if (!from.json().is_boolean()) from.refuse("This must be true or false.");
    } else if (type == "point") {
        static_cast<void>(from.point());
    } else if (type == "quaternion") {
        const std::size_t size = from.json().is_array() ? from.size() : 0;
        if (size != 4) return from.refuse("This must be a list of four numbers.");
        for (std::size_t i = 0; i < size; ++i) static_cast<void>(from.at(i).number(-2.0, 2.0));
    }
}

void checkForm(const JsonReader& from, const json& form) {
    if (form.is_string()) return checkValue(from, form.get_ref<const std::string&>());
    if (form.is_array()) {
        if (!from.json().is_array()) return from.refuse("This must be a list.");
        for (std::size_t i = 0; i < from.size() && from.good(); ++i) {
            checkForm(from.at(i), form[0]);
        }
        return;
    }
    if (!from.json().is_object()) return from.refuse("This must be an object.");
    for (const auto& [name, member] : form.items()) {
        const bool needed = name.ends_with('!');
        const std::string key = needed ? name.substr(0, name.size() - 1) : name;
        if (needed || from.json().contains(key)) checkForm(from.at(key), member);
        if (!from.good()) return;
    }
}

}  // namespace

Status checkStoredPlan(const json& result, const std::string& where) {
    static const json form = planForm();
    Status status;
    if (!result.is_null()) checkForm(JsonReader(result, where, status), form);
    return status;
}

}  // namespace dollytrack
