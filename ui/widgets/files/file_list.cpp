#include "ui/widgets/files/file_list.h"

#include "ui/theme.h"
#include "ui/widgets/cut_text.h"
#include "ui/widgets/form.h"
#include "ui/widgets/item_map.h"
#include "ui/widgets/text_match.h"

#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <ctime>
#include <utility>

namespace dollytrack::ui {
namespace {

constexpr double kTypingPause_s = 1.0;  // after this pause, letters start a new name

std::string dateText(std::int64_t seconds) {
    if (seconds == 0) return {};
    const std::time_t time = seconds;
    std::tm local = {};
    localtime_r(&time, &local);
    std::array<char, 32> text = {};
    std::strftime(text.data(), text.size(), "%Y-%m-%d %H:%M", &local);
    return text.data();
}

/// Selects the first entry that begins with the typed letters. Returns the typed text if it starts
/// a path or matches no entry.
std::string jumpToTyped(const FileListView& view, FileListState& state) {
    ImGuiIO& io = ImGui::GetIO();
    if (io.KeyCtrl || io.InputQueueCharacters.empty()) return {};
    const double now = ImGui::GetTime();
    if (now - state.typed_at > kTypingPause_s) state.typed.clear();
    state.typed_at = now;
    for (const ImWchar c : io.InputQueueCharacters) {
        if (c >= 32 && c < 127) state.typed += static_cast<char>(c);
    }
    const auto row = std::ranges::find_if(*view.rows, [&](const auto entry) {
        return beginsWithIgnoringCase(view.listing->entries[entry].name, state.typed);
    });
    const bool is_path = state.typed.starts_with('~') || state.typed.find('/') != std::string::npos;
    if (is_path || (row == view.rows->end() && !state.typed.empty())) {
        io.InputQueueCharacters.resize(0);
        return std::exchange(state.typed, {});
    }
    if (row != view.rows->end()) {
        state.selected = static_cast<int>(row - view.rows->begin());
        state.scroll = true;
    }
    return {};
}

void moveByKeys(FileListState& state, int count) {
    int step = 0;
    if (ImGui::IsKeyPressed(GLFW_KEY_DOWN)) step = 1;
    if (ImGui::IsKeyPressed(GLFW_KEY_UP)) step = -1;
    if (ImGui::IsKeyPressed(GLFW_KEY_PAGE_DOWN)) step = 12;
    if (ImGui::IsKeyPressed(GLFW_KEY_PAGE_UP)) step = -12;
    if (ImGui::IsKeyPressed(GLFW_KEY_HOME)) step = -count;
    if (ImGui::IsKeyPressed(GLFW_KEY_END)) step = count;
    if (step == 0 || count == 0) return;
    const int from = state.selected < 0 && std::abs(step) < count ? -step : state.selected;
    state.selected = std::clamp(from + step, 0, count - 1);
    state.scroll = true;
}

void sortByHeadings(FolderOrder& order) {
    ImGuiTableSortSpecs* specs = ImGui::TableGetSortSpecs();
    if (specs == nullptr || !specs->SpecsDirty || specs->SpecsCount == 0) return;
    constexpr std::array kKeys = {FolderOrder::Key::Name, FolderOrder::Key::Size,
                                  FolderOrder::Key::Date};
    order.key = kKeys[specs->Specs[0].ColumnIndex];
    order.descending = specs->Specs[0].SortDirection == ImGuiSortDirection_Descending;
    specs->SpecsDirty = false;
}

void drawRow(const FolderEntry& entry, int row, FileListState& state, FileListActions& actions) {
    ImGui::PushID(row);
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    const std::string label = (entry.is_folder ? "\u25b8 " : "   ") + entry.name;
    if (ImGui::Selectable(
            "##row", row == state.selected,
            ImGuiSelectableFlags_SpanAllColumns | ImGuiSelectableFlags_AllowDoubleClick)) {
        actions.selected = actions.selected || state.selected != row;
        state.selected = row;
        if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) actions.opened = true;
    }
    nameItem("files.row." + entry.name);
    if (state.scroll && row == state.selected) {
        ImGui::SetScrollHereY(0.5F);
        state.scroll = false;
    }
    ImGui::SameLine(0, 0);
    if (entry.is_folder) ImGui::PushFont(fonts().bold);
    const float room = ImGui::GetContentRegionAvail().x;
    ImGui::TextUnformatted(cutToWidth(label, room, Cut::Middle).c_str());
    wholeText(label, room);
    if (entry.is_folder) ImGui::PopFont();
    ImGui::TableNextColumn();
    if (!entry.is_folder) {
        const std::string size = sizeText(entry.bytes);
        const float width = ImGui::CalcTextSize(size.c_str()).x;
        ImGui::SetCursorPosX(ImGui::GetCursorPosX() +
                             std::max(0.0F, ImGui::GetContentRegionAvail().x - width));
        ImGui::TextColored(palette().text_dim, "%s", size.c_str());
    }
    ImGui::TableNextColumn();
    ImGui::TextColored(palette().text_dim, "%s", dateText(entry.modified_s).c_str());
    ImGui::PopID();
}

void drawHeadings() {
    ImGui::TableSetupScrollFreeze(0, 1);
    ImGui::TableSetupColumn("Name",
                            ImGuiTableColumnFlags_WidthStretch | ImGuiTableColumnFlags_DefaultSort);
    ImGui::TableSetupColumn(
        "Size", ImGuiTableColumnFlags_WidthFixed | ImGuiTableColumnFlags_PreferSortDescending,
        scaled(80));
    ImGui::TableSetupColumn(
        "Modified", ImGuiTableColumnFlags_WidthFixed | ImGuiTableColumnFlags_PreferSortDescending,
        scaled(130));
    ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
    for (int column = 0; column < 3; ++column) {
        ImGui::TableSetColumnIndex(column);
        const char* name = ImGui::TableGetColumnName(column);
        ImGui::TableHeader(name);
        std::string lower = name;
        for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        nameItem("files.sort." + lower);
    }
}

}  // namespace

std::string sizeText(std::uint64_t bytes) {
    if (bytes < 1000) return fmt::format("{} B", bytes);
    double size = static_cast<double>(bytes) / 1000.0;
    for (const char* unit : {"kB", "MB", "GB"}) {
        if (size < 999.5) return fmt::format("{:.{}f} {}", size, size < 10.0 ? 1 : 0, unit);
        size /= 1000.0;
    }
    return fmt::format("{:.1f} TB", size);
}

FileListActions drawFileList(const FileListView& view, FolderOrder& order, FileListState& state) {
    FileListActions actions;
    const int before = state.selected;
    const int count = view.listing == nullptr ? 0 : static_cast<int>(view.rows->size());
    if (view.listing != nullptr && view.takes_keys) {
        moveByKeys(state, count);
        actions.path = jumpToTyped(view, state);
        actions.go_up = ImGui::IsKeyPressed(GLFW_KEY_BACKSPACE, false);
        actions.opened = state.selected >= 0 && (ImGui::IsKeyPressed(GLFW_KEY_ENTER, false) ||
                                                 ImGui::IsKeyPressed(GLFW_KEY_KP_ENTER, false));
    }
    if (!ImGui::BeginTable("files", 3,
                           ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg |
                               ImGuiTableFlags_Sortable | ImGuiTableFlags_BordersOuter |
                               ImGuiTableFlags_NoSavedSettings)) {
        return actions;
    }
    drawHeadings();
    sortByHeadings(order);
    ImGuiListClipper clipper;
    clipper.Begin(count);
    if (state.scroll && state.selected >= 0 && state.selected < count) {
        clipper.ForceDisplayRangeByIndices(state.selected, state.selected + 1);
    }
    while (clipper.Step()) {
        for (int row = clipper.DisplayStart; row < clipper.DisplayEnd; ++row) {
            drawRow(view.listing->entries[(*view.rows)[row]], row, state, actions);
        }
    }
    ImGui::EndTable();
    actions.selected = actions.selected || state.selected != before;
    return actions;
}

}  // namespace dollytrack::ui
