#include "app/cli/plan/metrics_table.h"

#include "engine/plan/frame_quality.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace dollytrack::cli {
namespace {

constexpr std::size_t kListed = 12;  // uncaptured objects listed before "and n more"

std::string percent(const nlohmann::json& metrics, const char* name) {
    const auto found = metrics.find(name);
    if (found == metrics.end() || !found->is_number()) return "-";
    return fmt::format("{:.1f} %", 100.0 * found->get<double>());
}

std::string row(std::string_view what, const std::string& value) {
    return fmt::format("  {:<22} {}\n", what, value);
}

std::string tallyText(const nlohmann::json& tally) {
    return fmt::format("{:.2f} mean, {} of {} frames low", tally.value("mean_score", 0.0),
                       tally.value("low", 0), tally.value("frames", 0));
}

/// Rows for the image scores; before and after if frames were repaired.
std::string scoreRows(const nlohmann::json& repair) {
    if (repair.empty()) return {};
    const int dropped = repair.value("dropped", 0);
    if (repair.value("rounds", 0) == 0 && dropped == 0) {
        return row("image score", tallyText(repair["after"]));
    }
    return row("image score", tallyText(repair["before"])) +
           row("  after repair", tallyText(repair["after"])) +
           row("  repairs",
               fmt::format("{} look-aside views, {} detours, {} dropped frames; {} rounds",
                           repair.value("glances", 0), repair.value("replanned", 0), dropped,
                           repair.value("rounds", 0)));
}

/// The row of a given motion; empty for a planned one.
std::string givenMotionRow(const nlohmann::json& m) {
    if (!m.value("given_motion", false)) return {};
    const auto keys = m.find("camera_keys");
    if (keys == m.end()) return row("motion", "as given, not planned");
    return row("motion", fmt::format("through {} given camera key{}, not planned", keys->size(),
                                     keys->size() == 1 ? "" : "s"));
}

/// Rows for the objects: captured, possible, missed, share of the image.
std::string captureRows(const nlohmann::json& m) {
    std::string text;
    if (const std::string scanned = scannedText(m); !scanned.empty()) text += row("scan", scanned);
    text += row("objects", fmt::format("{}", m.value("objects", 0)));
    text +=
        row("captured", fmt::format("{} ({})", percent(m, "capture_rate"), m.value("captured", 0)));
    text += row("well captured", fmt::format("{} ({})", percent(m, "well_captured_rate"),
                                             m.value("well_captured", 0)));
    if (m.contains("capturable_rate")) {
        text += row("  possible", fmt::format("{} captured, {} well", percent(m, "capturable_rate"),
                                              percent(m, "well_capturable_rate")));
        for (const auto& [label, key] : {std::pair{"  missed", "missed_capturable"},
                                         {"  missed well", "missed_well_capturable"}}) {
            std::string names;
            for (const auto& name : m.value(key, nlohmann::json::array())) {
                names += (names.empty() ? "" : ", ") + name.get<std::string>();
            }
            if (!names.empty()) text += row(label, names);
        }
    }
    const std::string small = percent(m, "small_capture_rate");
    text += row("  small objects",
                small == "-" ? "none is below 0.1 m3" : small + " captured (below 0.1 m3)");
    text +=
        row("area share", fmt::format("{} of the image (box), {} (mask)",
                                      percent(m, "area_share_box"), percent(m, "area_share_mask")));
    return text;
}

/// Rows for collisions and the minimum clearance.
std::string collisionRows(const nlohmann::json& m) {
    std::string text;
    const int lines = m.value("straight_lines_that_hit", 0);
    const bool given = m.value("given_motion", false);
    text += row("collisions", given ? fmt::format("{} of frames, {} moves between frames",
                                                  percent(m, "frame_collision_rate"), lines)
                                    : fmt::format("{} of corners, {} of frames",
                                                  percent(m, "corner_collision_rate"),
                                                  percent(m, "frame_collision_rate")));
    if (lines > 0 && !given) {
        text += row("  between frames",
                    fmt::format("none on the path; {} on straight lines between frames", lines));
    }
    std::string clearance = "-";
    if (const auto least = m.find("min_clearance_m"); least != m.end() && least->is_number()) {
        clearance = fmt::format("{:.3f} m", least->get<double>());
    }
    if (m.contains("min_clearance_at")) {
        const nlohmann::json& at = m["min_clearance_at"];
        clearance += fmt::format(" to {}, near frame {} at ({:.2f}, {:.2f}, {:.2f})",
                                 at["object"].get<std::string>(), at["frame"].get<int>(),
                                 at["position"][0].get<double>(), at["position"][1].get<double>(),
                                 at["position"][2].get<double>());
    }
    text += row("minimum clearance", clearance);
    return text;
}

/// Rows for the motion of the camera.
std::string motionRows(const nlohmann::json& m) {
    std::string text;
    const auto spread = [&](const std::string& name, const std::string& unit,
                            const std::string& unit_text) {
        const auto value = [&](const char* what) {
            const double measured = m.value(name + "_" + what + "_" + unit, 0.0);
            return std::abs(measured) < 1e-6 ? 0.0 : measured;  // smaller: rounding error
        };
        return fmt::format("{:.3g} {} median, {:.3g} 95th percentile, {:.3g} maximum",
                           value("median"), unit_text, value("p95"), value("max"));
    };
    text += row("speed", spread("speed", "mps", "m/s"));
    text += row("acceleration", spread("acceleration", "mps2", "m/s2"));
    text += row("jerk", spread("jerk", "mps3", "m/s3"));
    text += row("turning", spread("turn", "dps", "deg/s"));
    text += row("  acceleration", spread("turn_acceleration", "dps2", "deg/s2"));
    text += row("path", fmt::format("{:.1f} m", m.value("path_length_m", 0.0)));
    return text;
}

/// Rows for the visible surface and the anchors.
std::string coverageRows(const nlohmann::json& m) {
    std::string text;
    for (const auto& region : m.value("must_see", nlohmann::json::array())) {
        text += row("seen of " + region.value("region", ""),
                    fmt::format("{:.1f} % of the visible surface ({} of {} patches)",
                                100.0 * region.value("rate", 0.0), region.value("seen", 0),
                                region.value("seeable", 0)));
    }
    if (m.contains("surface_covered_rate")) {
        text += row(
            "surface seen",
            fmt::format("{} of {} patches of {:.0f} cm", percent(m, "surface_seen_rate"),
                        m.value("surface_patches", 0), 100.0 * m.value("surface_patch_m", 0.0)));
        text += row("surface covered",
                    fmt::format("{}; possible: {}", percent(m, "surface_covered_rate"),
                                percent(m, "surface_coverable_rate")));
    }
    for (const auto& anchors : m.value("anchors", nlohmann::json::array())) {
        const int found = anchors.value("found", 0);
        text +=
            row(anchors.value("kind", ""),
                found == 0 ? std::string("none in this scene")
                           : fmt::format("{} of {} visited", anchors.value("visited", 0), found));
    }
    return text;
}

/// The objects that are not captured, each with the reason; only their number if the motion is
/// given, since nothing was planned for them.
std::string uncapturedRows(const nlohmann::json& m) {
    std::string text;
    const auto& uncaptured = m.value("uncaptured", nlohmann::json::array());
    if (!uncaptured.empty() && m.value("given_motion", false)) {
        return row("not captured",
                   fmt::format("{} object{} (plan --explain lists them); the motion is given",
                               uncaptured.size(), uncaptured.size() == 1 ? "" : "s"));
    }
    if (!uncaptured.empty()) text += "not captured:\n";
    for (std::size_t i = 0; i < std::min(kListed, uncaptured.size()); ++i) {
        text += row(uncaptured[i].value("object", ""), uncaptured[i].value("reason", ""));
    }
    if (uncaptured.size() > kListed) {
        text += fmt::format("  and {} more (--json lists all)\n", uncaptured.size() - kListed);
    }
    return text;
}

}  // namespace

std::string jsonText(const nlohmann::json& json) {
    return json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string scannedText(std::optional<double> share) {
    if (!share) return {};
    return fmt::format("{:.0f} % of the rooms was scanned, the rest is unknown", 100.0 * *share);
}

std::string scannedText(const nlohmann::json& metrics) {
    const auto share = metrics.find("scanned_share");
    if (share == metrics.end() || !share->is_number()) return {};
    return scannedText(std::optional(share->get<double>()));
}

std::string metricsTable(const nlohmann::json& m) {
    std::string text = givenMotionRow(m) + captureRows(m) + collisionRows(m);
    text += row("frames", fmt::format("{} in {:.4g} s, {} of them key frames", m.value("frames", 0),
                                      m.value("duration_s", 0.0), m.value("key_frames", 0)));
    text += row("repeats", percent(m, "repeat_rate"));
    if (m.contains("trackable_rate")) {
        text += row("trackable", percent(m, "trackable_rate") + " of the frames");
    }
    if (m.contains("overlap_min_rate")) {
        text += row("overlap of frames",
                    fmt::format("{} median, {} least; {} gaps below {:.0f} %",
                                percent(m, "overlap_median_rate"), percent(m, "overlap_min_rate"),
                                m.value("wide_gaps", 0), 100.0 * kLeastOverlap));
    }
    text += scoreRows(m.value("repair", nlohmann::json::object()));
    text += motionRows(m) + coverageRows(m);
    for (const auto& room : m.value("rooms", nlohmann::json::array())) {
        text +=
            row(room.value("name", ""), fmt::format("{} frames, {:.1f} m", room.value("frames", 0),
                                                    room.value("path_length_m", 0.0)));
    }
    text += row("time", fmt::format("{:.0f} ms map, {:.0f} ms plan", m.value("map_ms", 0.0),
                                    m.value("plan_ms", 0.0)));
    return text + uncapturedRows(m);
}

}  // namespace dollytrack::cli
