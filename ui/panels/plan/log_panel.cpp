#include "ui/panels/plan/log_panel.h"

#include "ui/theme.h"
#include "ui/widgets/fields/choice_combo.h"
#include "ui/widgets/item_map.h"
#include "ui/widgets/text_match.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

namespace dollytrack::ui {
namespace {

ImVec4 levelColor(log::Level level) {
    if (level == log::Level::Error) return palette().bad;
    if (level == log::Level::Warning) return palette().warning;
    return palette().text_dim;
}

bool matches(const log::Record& record, const LogPanelState& state) {
    if (static_cast<int>(record.level) < state.least_level) return false;
    return containsIgnoringCase(record.message, state.filter) ||
           containsIgnoringCase(record.subsystem, state.filter);
}

std::string messageOf(const log::Record& record) {
    if (record.repeats <= 1) return record.message;
    return record.message + " (" + std::to_string(record.repeats) + " times)";
}

std::string asText(const log::Record& record) {
    return std::string(log::name(record.level)) + " " + record.subsystem + ": " + messageOf(record);
}

/// Continues the line after the last widget if the panel has room for this width, px.
void continueLine(float width) {
    const float end = ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x;
    if (ImGui::GetItemRectMax().x + ImGui::GetStyle().ItemSpacing.x + width < end) {
        ImGui::SameLine();
    }
}

float messageColumn() {
    return scaled(150);
}

/// Takes the records that pass the filters if log or filters have changed; returns whether the log
/// has.
bool follow(LogRows& rows, const LogBuffer& buffer, const LogPanelState& state) {
    const unsigned version = buffer.version();
    const bool changed = rows.version != version;
    if (!changed && rows.filter == state.filter && rows.least_level == state.least_level) {
        return false;
    }
    rows.version = version;
    rows.filter = state.filter;
    rows.least_level = state.least_level;
    std::deque<log::Record> all = buffer.records();
    rows.all = all.size();
    rows.records.clear();
    for (log::Record& record : all) {
        if (matches(record, state)) rows.records.push_back(std::move(record));
    }
    rows.bottoms.clear();
    return changed;
}

/// Measures the messages, wrapped to the width of the current window.
void layOut(LogRows& rows) {
    const float width = std::max(ImGui::GetContentRegionAvail().x - messageColumn(), 1.0F);
    const float font_size = ImGui::GetFontSize();
    if (rows.bottoms.size() == rows.records.size() && rows.width == width &&
        rows.font_size == font_size) {
        return;
    }
    rows.width = width;
    rows.font_size = font_size;
    rows.bottoms.clear();
    float bottom = 0.0F;
    for (const log::Record& record : rows.records) {
        bottom += ImGui::CalcTextSize(messageOf(record).c_str(), nullptr, false, width).y +
                  ImGui::GetStyle().ItemSpacing.y;
        rows.bottoms.push_back(bottom);
    }
}

/// One message, wrapped to the width of the window.
void drawRecord(const log::Record& record) {
    ImGui::TextColored(levelColor(record.level), "%-7s", log::name(record.level));
    ImGui::SameLine(scaled(70));
    ImGui::TextColored(palette().text_dim, "%s", record.subsystem.c_str());
    ImGui::SameLine(messageColumn());
    ImGui::PushTextWrapPos(0.0F);
    ImGui::TextUnformatted(messageOf(record).c_str());
    ImGui::PopTextWrapPos();
}

/// Draws the records that the window shows, and gives it the height of all. `to_end`: scrolls to
/// the end, unless the user has scrolled up.
void drawRecords(const LogRows& rows, bool to_end) {
    const float origin = ImGui::GetCursorPosY();
    const float top = ImGui::GetScrollY() - origin;
    const RowRange shown = rowsBetween(rows.bottoms, top, top + ImGui::GetWindowHeight());
    if (shown.first > 0) ImGui::SetCursorPosY(origin + rows.bottoms[shown.first - 1]);
    for (std::size_t i = shown.first; i < shown.end; ++i) {
        drawRecord(rows.records[i]);
        nameItem("log.message." + std::to_string(i));
    }
    const float height = rows.bottoms.empty() ? 0.0F : rows.bottoms.back();
    ImGui::SetCursorPosY(origin + height);
    if (to_end && ImGui::GetScrollY() >= ImGui::GetScrollMaxY() - scaled(4)) {
        ImGui::SetScrollFromPosY(origin + height - ImGui::GetScrollY(), 1.0F);
    }
}

}  // namespace

RowRange rowsBetween(std::span<const float> bottoms, float top, float bottom) {
    const auto first = std::ranges::upper_bound(bottoms, top);
    auto end = std::ranges::lower_bound(first, bottoms.end(), bottom);
    // The row that begins above `bottom` and ends at it or below.
    const bool begins = end != bottoms.end() && bottom > (end == bottoms.begin() ? 0.0F : end[-1]);
    if (begins) ++end;
    return {static_cast<std::size_t>(first - bottoms.begin()),
            static_cast<std::size_t>(end - bottoms.begin())};
}

void LogBuffer::add(const log::Record& record) {
    const std::lock_guard lock(mutex_);
    ++version_;
    // Compares several recent lines, so that alternating messages fold as well.
    const std::size_t looked_at = std::min<std::size_t>(records_.size(), 8);
    for (std::size_t i = 0; i < looked_at; ++i) {
        log::Record& earlier = records_[records_.size() - 1 - i];
        if (earlier.message == record.message && earlier.subsystem == record.subsystem &&
            earlier.level == record.level) {
            earlier.repeats += record.repeats;
            return;
        }
    }
    if (record.level >= log::Level::Warning) ++warnings_;
    records_.push_back(record);
    if (records_.size() > kKept) records_.pop_front();
}

std::deque<log::Record> LogBuffer::records() const {
    const std::lock_guard lock(mutex_);
    return records_;
}

void LogBuffer::clear() {
    const std::lock_guard lock(mutex_);
    ++version_;
    records_.clear();
}

unsigned LogBuffer::version() const {
    const std::lock_guard lock(mutex_);
    return version_;
}

unsigned LogBuffer::warnings() const {
    const std::lock_guard lock(mutex_);
    return warnings_;
}

void drawLogPanel(LogBuffer& buffer, LogPanelState& state) {
    state.seen_warnings = buffer.warnings();
    LogRows& rows = state.rows;
    const bool changed = follow(rows, buffer, state);
    ImGui::SetNextItemWidth(std::min(scaled(260), ImGui::GetContentRegionAvail().x));
    ImGui::InputTextWithHint("##filter", "Filter messages", &state.filter);
    nameItem("log.filter");
    continueLine(scaled(300));  // the width of the other widgets
    ImGui::SetNextItemWidth(scaled(120));
    static constexpr std::array<const char*, 4> kLevels = {"All", "Notes", "Warnings", "Errors"};
    choiceCombo("log.level", state.least_level, kLevels);
    ImGui::SameLine();
    if (ImGui::Button("Copy")) {
        std::string text;
        for (const log::Record& record : rows.records) text += asText(record) + "\n";
        ImGui::SetClipboardText(text.c_str());
    }
    nameItem("log.copy");
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("Copy the messages shown");
    ImGui::SameLine();
    if (ImGui::Button("Clear")) buffer.clear();
    nameItem("log.clear");
    ImGui::SameLine();
    ImGui::TextDisabled("%zu of %zu", rows.records.size(), rows.all);

    ImGui::BeginChild("messages");
    layOut(rows);
    drawRecords(rows, changed);
    ImGui::EndChild();
}

}  // namespace dollytrack::ui
