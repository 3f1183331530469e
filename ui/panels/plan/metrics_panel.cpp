#include "ui/panels/plan/metrics_panel.h"

#include "planning/analysis/plan_comparison.h"
#include "ui/theme.h"
#include "ui/widgets/cut_text.h"
#include "ui/widgets/item_map.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

namespace dollytrack::ui {
namespace {

void row(const char* name, const std::string& value, const char* why = nullptr) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(name);
    if (why != nullptr && ImGui::IsItemHovered()) ImGui::SetTooltip("%s", why);
    ImGui::TableNextColumn();
    cutText(value, ImGui::GetStyleColorVec4(ImGuiCol_Text), why != nullptr ? why : "");
}

void rateRow(const char* name, double rate, int count, int of, const char* why) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(name);
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", why);
    ImGui::TableNextColumn();
    const std::string text = of > 0 ? fmt::format("{:.1f} %  ({} of {})", 100.0 * rate, count, of)
                                    : fmt::format("{:.1f} %", 100.0 * rate);
    ImGui::ProgressBar(static_cast<float>(rate), {-1, ImGui::GetTextLineHeight() + scaled(4)},
                       text.c_str());
}

bool beginTable(const char* name) {
    if (!ImGui::BeginTable(name, 2)) return false;
    ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch, 0.42F);
    ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch, 0.58F);
    return true;
}

void drawCaptures(const Plan& plan) {
    const CaptureMetrics& capture = plan.capture_metrics;
    if (!beginTable("captures")) return;
    rateRow("Captured", capture.capture_rate, capture.captured, capture.objects,
            "At least 80 % of the silhouette and 120 pixels visible in one frame");
    rateRow("Well captured", capture.well_captured_rate, capture.well_captured, capture.objects,
            "Captured, and the box takes at least 5 % of the image");
    rateRow("Small, captured", capture.small_capture_rate, 0, 0, "Only objects below 0.1 m³");
    row("Area share",
        fmt::format("{:.1f} % box, {:.1f} % mask", 100.0 * capture.area_share_box,
                    100.0 * capture.area_share_mask),
        "Of the image, in each object's best frame");
    ImGui::EndTable();
}

void drawScores(const RepairReport& repair) {
    constexpr const char* kMeaning =
        "Mean image score, and the number of low-scoring frames, which show few objects or none";
    const auto text = [](const ScoreTally& tally) {
        return fmt::format("{:.2f}, {} of {} frames low", tally.mean, tally.low, tally.frames);
    };
    if (repair.rounds == 0 && repair.dropped == 0) {
        row("Image score", text(repair.after), kMeaning);
        return;
    }
    row("Image score", text(repair.before) + " before repair", kMeaning);
    row("  repaired", text(repair.after),
        fmt::format("{} look-aside views, {} detours, {} frames dropped, {} rounds",
                    repair.look_asides, repair.replanned, repair.dropped, repair.rounds)
            .c_str());
}

void drawSurface(const SurfaceShare& surface) {
    row("Surface seen", fmt::format("{:.1f} %", 100.0 * surface.rateOf(surface.seen)),
        "Share of all surface in sight of the camera's positions that some frame shows");
    row("Surface covered",
        fmt::format("{:.1f} % of {:.1f} % possible", 100.0 * surface.rateOf(surface.covered),
                    100.0 * surface.rateOf(surface.coverable)),
        "Share seen from enough directions and with small enough pixels, as the parameters "
        "surface directions and surface mm define");
}

void drawTrajectory(const Plan& plan, bool measured) {
    const TrajectoryMetrics& metrics = plan.trajectory_metrics;
    if (!beginTable("trajectory")) return;
    const auto frames = static_cast<int>(plan.trajectory.frames.size());
    const auto keys =
        std::count_if(plan.trajectory.frames.begin(), plan.trajectory.frames.end(),
                      [](const TrajectoryFrame& frame) { return frame.position_point >= 0; });
    row("Frames", fmt::format("{}, {} key frames", frames, keys));
    row("Duration", fmt::format("{:.1f} s", durationOf(plan.trajectory)));
    double length = 0.0;
    double clearance = plan.smooth_paths.empty() ? 0.0 : 1e9;
    for (const SmoothPath& path : plan.smooth_paths) {
        length += path.length_m;
        clearance = std::min(clearance, path.min_clearance_m);
    }
    row("Path", fmt::format("{:.1f} m", length));
    const std::string where =
        measured ? fmt::format("{:.3f} m, near frame {}", metrics.minimum_clearance.clearance_m,
                               metrics.minimum_clearance.frame)
                 : fmt::format("{:.3f} m", clearance);
    row("Clearance", where,
        "Smallest distance from the camera's centre to a surface along the path");
    if (measured) {
        row("Repeats", fmt::format("{:.1f} %", 100.0 * metrics.repeat_rate),
            "Share of frames that show almost no new surface");
        row("Object pixels", fmt::format("{:.1f} %", 100.0 * metrics.object_pixels),
            "Share of the images' pixels on targets");
        if (metrics.trackable_rate) {
            row("Trackable", fmt::format("{:.1f} % of the frames", 100.0 * *metrics.trackable_rate),
                "Share of frames with enough corners for SLAM programs");
        }
        if (plan.surface) drawSurface(*plan.surface);
        drawScores(plan.repair);
        const auto spread = [](const SampleStatistics& of, const char* unit) {
            return fmt::format("{:.2f} {}, {:.2f} at most", of.median, unit, of.max);
        };
        const MotionMetrics& motion = metrics.motion;
        row("Speed", spread(motion.speed_mps, "m/s"), "Median between consecutive frames");
        row("Turning", spread(motion.turn_dps, "°/s"), "Median between consecutive frames");
        row("Acceleration", spread(motion.acceleration_mps2, "m/s²"), "Median over three frames");
        row("Jerk", spread(motion.jerk_mps3, "m/s³"), "Median over four frames");
        row("Collisions",
            fmt::format("{:.1f} % corners, {:.1f} % frames", 100.0 * metrics.corner_collision_rate,
                        100.0 * metrics.frame_collision_rate),
            "Corners and frames where the swept camera sphere touches a surface; proven");
    }
    ImGui::EndTable();
}

void drawStages(const Plan& plan) {
    if (!ImGui::BeginTable("stages", 2)) return;
    ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch, 0.42F);
    ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch, 0.58F);
    for (const StageTime& stage : plan.stages) {
        std::string name = stage.name;
        for (char& c : name) {
            if (c == '_') c = ' ';
        }
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(name.c_str());
        ImGui::TableNextColumn();
        if (stage.reused) {
            ImGui::TextDisabled("kept");
        } else {
            ImGui::Text("%.1f ms", stage.milliseconds);
        }
    }
    ImGui::EndTable();
}

int drawUncaptured(const MetricsView& view) {
    int clicked = 0;
    for (const LedgerRow& missing : view.plan->ledger) {
        if (missing.captured) continue;
        ImGui::PushID(missing.object_id);
        const std::string name = view.scene->object(missing.object_id).name;
        const float room = ImGui::GetContentRegionAvail().x;
        if (ImGui::Selectable(cutToWidth(name, room, Cut::Middle).c_str())) {
            clicked = missing.object_id;
        }
        wholeText(name, room);
        nameItem("metrics.uncaptured." + std::to_string(missing.object_id));
        ImGui::Indent();
        ImGui::PushTextWrapPos(0.0F);
        ImGui::TextColored(palette().text_dim, "%s", missing.reason.c_str());
        ImGui::PopTextWrapPos();
        ImGui::Unindent();
        ImGui::PopID();
    }
    return clicked;
}

void title(const char* text) {
    ImGui::Spacing();
    ImGui::PushFont(fonts().bold);
    ImGui::TextUnformatted(text);
    ImGui::PopFont();
}

}  // namespace

MetricsActions drawMetricsPanel(const MetricsView& view) {
    MetricsActions actions;
    ImGui::BeginChild("metrics");
    if (view.plan == nullptr) {
        if (view.busy) {
            ImGui::TextDisabled("Planning: %s …", view.stage.c_str());
        } else {
            ImGui::TextDisabled("There is no plan.");
        }
        ImGui::EndChild();
        return actions;
    }
    actions.comparison = drawComparison(view.comparison);
    title("Objects");
    if (view.measured) {
        drawCaptures(*view.plan);
    } else {
        ImGui::TextDisabled("being counted …");
    }
    title("Trajectory");
    drawTrajectory(*view.plan, view.measured);
    if (view.measured) {
        const bool all = std::ranges::all_of(view.plan->ledger, &LedgerRow::captured);
        title(all ? "Every target is captured" : "Not captured");
        actions.select_object = drawUncaptured(view);
    }
    title("Time");
    ImGui::TextWrapped("%.0f ms map, %.0f ms plan; the last change was visible after %.0f ms",
                       view.plan->map_ms, view.plan->plan_ms, view.last_run_ms);
    drawStages(*view.plan);
    ImGui::EndChild();
    return actions;
}

}  // namespace dollytrack::ui
