#include "ui/panels/scene/start_panel.h"

#include "ui/theme.h"
#include "ui/widgets/cut_text.h"
#include "ui/widgets/form.h"
#include "ui/widgets/icon_button.h"
#include "ui/widgets/item_map.h"

#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace dollytrack::ui {
namespace {

constexpr float kPictureWidth = 96.0F;  // of a row, px at 96 dots per inch
constexpr float kPictureHeight = 60.0F;
constexpr float kRowWidth = 290.0F;  // smallest width of a row

/// One selectable row: a recent file, the built-in scene or "Open…".
struct Row {
    std::string item;  // name in the item map
    std::string title;
    std::string second;
    std::string third;
    const RecentFile* file = nullptr;  // null: the user chooses a file
    bool recent = false;               // can be removed from the list

    [[nodiscard]] bool missing() const { return file != nullptr && file->missing; }
};

std::vector<Row> rowsOf(const StartView& view) {
    std::vector<Row> rows;
    for (std::size_t i = 0; i < view.recent.size(); ++i) {
        const RecentFile& file = view.recent[i];
        rows.push_back({fmt::format("start.recent.{}", i), file.name, file.folder,
                        file.missing ? "The file is missing." : file.date, &file, true});
    }
    if (view.example) {
        rows.push_back({"start.example", "Apartment", "The built-in scene", "", &*view.example});
    }
    rows.push_back({"start.open", "Open…", "A scene or a project (Ctrl+O)", ""});
    return rows;
}

void drawPicture(const Row& row, ImVec2 low, ImVec2 size) {
    ImDrawList* list = ImGui::GetWindowDrawList();
    const ImVec2 high(low.x + size.x, low.y + size.y);
    list->AddRectFilled(low, high, ImGui::GetColorU32(ImGuiCol_FrameBg), scaled(3));
    if (row.file != nullptr && row.file->texture != 0) {
        const ImU32 tint = row.missing() ? IM_COL32(255, 255, 255, 90) : IM_COL32_WHITE;
        list->AddImageRounded(
            reinterpret_cast<ImTextureID>(static_cast<std::intptr_t>(row.file->texture)), low, high,
            {0, 0}, {1, 1}, tint, scaled(3));
        return;
    }
    const char* sign = row.file == nullptr ? "…" : row.recent ? "no picture" : "demo";
    const ImVec2 text = ImGui::CalcTextSize(sign);
    list->AddText({low.x + 0.5F * (size.x - text.x), low.y + 0.5F * (size.y - text.y)},
                  ImGui::GetColorU32(palette().text_dim), sign);
}

/// The three lines of text, shortened to the width.
void drawLines(const Row& row, ImVec2 at, float width) {
    ImDrawList* list = ImGui::GetWindowDrawList();
    const bool missing = row.missing();
    const float line = ImGui::GetTextLineHeight() + scaled(2);
    const auto write = [&](const std::string& text, const ImVec4& color, Cut cut) {
        list->AddText(at, ImGui::GetColorU32(color), cutToWidth(text, width, cut).c_str());
        at.y += line;
    };
    ImGui::PushFont(fonts().bold);
    write(row.title, missing ? palette().text_dim : ImGui::GetStyleColorVec4(ImGuiCol_Text),
          Cut::Middle);
    ImGui::PopFont();
    write(row.second, palette().text_dim, Cut::Middle);
    write(row.third, missing ? palette().warning : palette().text_dim, Cut::End);
}

void open(const Row& row, StartActions& actions) {
    if (row.missing()) return;
    if (row.file == nullptr) {
        actions.choose_file = true;
    } else {
        actions.open = row.file->path;
    }
}

void drawRow(const Row& row, bool chosen, float width, StartActions& actions) {
    const float margin = scaled(6);
    const ImVec2 picture(scaled(kPictureWidth), scaled(kPictureHeight));
    const ImVec2 low = ImGui::GetCursorScreenPos();
    const ImVec2 size(width, picture.y + 2 * margin);
    if (ImGui::InvisibleButton(row.item.c_str(), size)) open(row, actions);
    const bool missing = row.missing();
    nameItem(row.item, !missing);
    const bool hovered = ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem);
    if (hovered && row.file != nullptr) tooltip(row.file->path);
    ImGui::SetItemAllowOverlap();
    ImDrawList* list = ImGui::GetWindowDrawList();
    const ImVec2 high(low.x + size.x, low.y + size.y);
    if (hovered) {
        list->AddRectFilled(low, high, ImGui::GetColorU32(ImGuiCol_HeaderHovered), scaled(5));
    }
    if (chosen) {
        list->AddRect(low, high, ImGui::GetColorU32(palette().accent), scaled(5), 0, scaled(1.5F));
    }
    drawPicture(row, {low.x + margin, low.y + margin}, picture);
    const float side = ImGui::GetTextLineHeight() + scaled(4);
    const float left = low.x + picture.x + 2.5F * margin;
    const bool removable = row.recent && (missing || hovered || chosen);
    drawLines(row, {left, low.y + margin}, high.x - left - margin - (removable ? side : 0.0F));
    if (!removable) return;
    const ImVec2 after = ImGui::GetCursorScreenPos();
    ImGui::SetCursorScreenPos({high.x - side - margin, low.y + margin});
    ImGui::PushID(row.item.c_str());
    if (iconButton(Icon::Close, row.item + ".remove",
                   {"Remove it from this list; the file stays (Del)", {}, false, true})) {
        actions.remove = row.file->path;
    }
    ImGui::PopID();
    ImGui::SetCursorScreenPos(after);
}

/// The place of a row in the grid. The recent files fill the first lines, the other rows begin a
/// line of their own.
struct Place {
    int line = 0;
    int column = 0;
};

std::vector<Place> placesOf(const std::vector<Row>& rows, int columns) {
    std::vector<Place> places;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        Place next;
        if (i > 0) {
            next = {places.back().line, places.back().column + 1};
            const bool ends = rows[i].recent != rows[i - 1].recent;
            if (ends || next.column == columns) next = {next.line + 1, 0};
        }
        places.push_back(next);
    }
    return places;
}

/// The row above or below another one, in its column or the last one of a shorter line; the same
/// row at the top and at the bottom.
int rowBeside(const std::vector<Place>& places, int from, int lines) {
    const Place here = places[static_cast<std::size_t>(from)];
    int found = from;
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (places[i].line == here.line + lines && places[i].column <= here.column) {
            found = static_cast<int>(i);
        }
    }
    return found;
}

/// Moves the choice with the arrow keys, opens with Enter, removes with Delete. Returns whether the
/// choice has moved.
bool useKeys(const std::vector<Row>& rows, const std::vector<Place>& places, StartState& state,
             StartActions& actions) {
    const int last = static_cast<int>(rows.size()) - 1;
    const int before = state.chosen = std::clamp(state.chosen, 0, last);
    if (!ImGui::IsWindowFocused()) return false;
    const auto pressed = [](int key) { return ImGui::IsKeyPressed(key); };
    if (pressed(GLFW_KEY_LEFT)) state.chosen = std::max(before - 1, 0);
    if (pressed(GLFW_KEY_RIGHT)) state.chosen = std::min(before + 1, last);
    if (pressed(GLFW_KEY_UP)) state.chosen = rowBeside(places, before, -1);
    if (pressed(GLFW_KEY_DOWN)) state.chosen = rowBeside(places, before, 1);
    const Row& row = rows[static_cast<std::size_t>(state.chosen)];
    if (pressed(GLFW_KEY_ENTER) || pressed(GLFW_KEY_KP_ENTER)) open(row, actions);
    if (pressed(GLFW_KEY_DELETE) && row.recent) actions.remove = row.file->path;
    return state.chosen != before;
}

void drawRows(const std::vector<Row>& rows, StartState& state, StartActions& actions) {
    const float gap = scaled(8);
    const float room = ImGui::GetContentRegionAvail().x - 2 * gap;
    const int columns = std::clamp(static_cast<int>(room / scaled(kRowWidth)), 1, 3);
    const float width = std::min((room - gap * static_cast<float>(columns - 1)) / columns,
                                 scaled(1.4F * kRowWidth));
    const float used = columns * width + (columns - 1) * gap;
    const ImVec2 begin(gap + std::floor(0.5F * (room - used)), ImGui::GetCursorPosY());
    const std::vector<Place> places = placesOf(rows, columns);
    const bool moved = useKeys(rows, places, state, actions);
    const float height = scaled(kPictureHeight + 12) + gap;
    const float title = ImGui::GetTextLineHeight() + gap;
    float top = begin.y;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const bool recent = rows[i].recent;
        const bool begins = i == 0 || recent != rows[i - 1].recent;
        if (begins) {
            if (i > 0) top += gap;
            ImGui::SetCursorPos({begin.x, top + static_cast<float>(places[i].line) * height});
            ImGui::TextColored(palette().text_dim, "%s", recent ? "Recent" : "Begin with");
            top += title;
        }
        ImGui::SetCursorPos({begin.x + static_cast<float>(places[i].column) * (width + gap),
                             top + static_cast<float>(places[i].line) * height});
        const bool chosen = static_cast<int>(i) == state.chosen;
        drawRow(rows[i], chosen, width, actions);
        if (chosen && moved) ImGui::SetScrollHereY(0.5F);
    }
    ImGui::SetCursorPos({begin.x, ImGui::GetCursorPosY() + gap});
}

}  // namespace

StartActions drawStartPanel(const StartView& view, StartState& state) {
    StartActions actions;
    // The start screen takes the keyboard when it appears. It does so for two frames, because other
    // parts of the window that appear in the first one would take it back. Its arrow keys replace
    // Dear ImGui's navigation.
    constexpr int kAppearing = 2;
    const bool covered = ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup);
    if (state.frames < kAppearing && !covered) ImGui::SetNextWindowFocus();
    state.frames = std::min(state.frames + 1, kAppearing);
    ImGui::BeginChild("start", {0, 0}, false, ImGuiWindowFlags_NoNav);
    ImGui::SetCursorPosY(scaled(16));
    drawRows(rowsOf(view), state, actions);
    cutText("Or drop a scene or a project onto the window.", palette().text_dim);
    ImGui::EndChild();
    return actions;
}

}  // namespace dollytrack::ui
