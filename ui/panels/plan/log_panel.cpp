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
#include <vector>

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

/// One message, wrapped to the width of the panel.
void drawRecord(const log::Record& record) {
    ImGui::TextColored(levelColor(record.level), "%-7s", log::name(record.level));
    ImGui::SameLine(scaled(70));
    ImGui::TextColored(palette().text_dim, "%s", record.subsystem.c_str());
    ImGui::SameLine(scaled(150));
    ImGui::PushTextWrapPos(0.0F);
    ImGui::TextUnformatted(messageOf(record).c_str());
    ImGui::PopTextWrapPos();
}

}  // namespace

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
    const std::deque<log::Record> all = buffer.records();
    std::vector<const log::Record*> rows;
    for (const log::Record& record : all) {
        if (matches(record, state)) rows.push_back(&record);
    }
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
        for (const log::Record* record : rows) text += asText(*record) + "\n";
        ImGui::SetClipboardText(text.c_str());
    }
    nameItem("log.copy");
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("Copy the messages shown");
    ImGui::SameLine();
    if (ImGui::Button("Clear")) buffer.clear();
    nameItem("log.clear");
    ImGui::SameLine();
    ImGui::TextDisabled("%zu of %zu", rows.size(), all.size());

    ImGui::BeginChild("messages");
    for (const log::Record* record : rows) drawRecord(*record);
    if (state.seen_version != buffer.version()) {
        state.seen_version = buffer.version();
        // Keeps the position if the user has scrolled up.
        if (ImGui::GetScrollY() >= ImGui::GetScrollMaxY() - scaled(4)) ImGui::SetScrollHereY(1.0F);
    }
    ImGui::EndChild();
}

}  // namespace dollytrack::ui
