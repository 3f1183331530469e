#include "ui/panels/plan/comparison_section.h"

#include "ui/theme.h"
#include "ui/widgets/cut_text.h"
#include "ui/widgets/form.h"
#include "ui/widgets/item_map.h"

#include <imgui.h>

namespace dollytrack::ui {
namespace {

using planning::Better;
using planning::ComparedMetric;

std::string tipOf(const ComparedMetric& metric) {
    std::string tip = metric.title();
    if (metric.info.better == Better::Higher) tip += ": higher is better";
    if (metric.info.better == Better::Lower) tip += ": lower is better";
    return tip;
}

/// A number at the right edge of its column.
void number(const std::string& text) {
    const float room = ImGui::GetContentRegionAvail().x;
    const float width = ImGui::CalcTextSize(text.c_str()).x;
    if (width < room) ImGui::SetCursorPosX(ImGui::GetCursorPosX() + room - width);
    ImGui::TextUnformatted(text.c_str());
}

void drawRow(const ComparedMetric& metric) {
    const bool differs = metric.differs();
    const int better = metric.betterA();
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    if (!differs) ImGui::PushStyleColor(ImGuiCol_Text, palette().text_dim);
    cutText(metric.title(), ImGui::GetStyleColorVec4(ImGuiCol_Text), tipOf(metric));
    nameItem("comparison." + std::string(metric.info.name));
    ImGui::TableNextColumn();
    number(planning::metricNumber(metric.info, metric.a));
    ImGui::TableNextColumn();
    number(planning::metricNumber(metric.info, metric.b));
    ImGui::TableNextColumn();
    if (better != 0) {
        ImGui::PushStyleColor(ImGuiCol_Text, better > 0 ? palette().good : palette().bad);
    }
    number(metric.differenceText());
    if (better != 0) {
        tooltip(better > 0 ? "A is better" : "B is better");
        ImGui::PopStyleColor();
    }
    if (!differs) ImGui::PopStyleColor();
}

void drawTable(const ComparisonView& view) {
    if (!ImGui::BeginTable("comparison", 4, ImGuiTableFlags_RowBg)) return;
    ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch, 0.46F);
    for (const char* column : {"A", "B", "A - B"}) {
        ImGui::TableSetupColumn(column, ImGuiTableColumnFlags_WidthStretch, 0.18F);
    }
    ImGui::TableNextRow();
    for (const char* column : {"", "A", "B", "A \u2212 B"}) {
        ImGui::TableNextColumn();
        ImGui::PushStyleColor(ImGuiCol_Text, palette().text_dim);
        number(column);
        ImGui::PopStyleColor();
    }
    for (const ComparedMetric& metric : view.metrics) drawRow(metric);
    ImGui::EndTable();
}

}  // namespace

ComparisonActions drawComparison(const ComparisonView& view) {
    ComparisonActions actions;
    actions.keep = button("Keep as B", "comparison.keep",
                          {view.why_not_keep, "Keep this plan to compare later ones with it"});
    flowTo("Open B\u2026");
    actions.open = button("Open B\u2026", "comparison.open",
                          {view.why_not_open,
                           "Compare with the plan of another project of this "
                           "scene"});
    if (view.has_kept) {
        flowTo("Swap");
        actions.swap = button("Swap", "comparison.swap",
                              {view.why_not_swap,
                               "Make B the current plan, with its parameters and edits, and keep "
                               "this one; one step of undo"});
        flowTo("Drop");
        actions.drop = button("Drop", "comparison.drop", {{}, "End the comparison"});
    }
    if (!view.reading.empty()) {
        actions.cancel_reading = drawReading(view.reading, "comparison.cancel_reading");
    }
    if (!view.has_kept) return actions;
    const std::string names = "A: current plan, B: " + view.kept_name;
    cutText(names, palette().text_dim, names);
    if (view.metrics.empty()) {
        ImGui::TextDisabled("A is being measured \u2026");
    } else {
        drawTable(view);
    }
    return actions;
}

}  // namespace dollytrack::ui
