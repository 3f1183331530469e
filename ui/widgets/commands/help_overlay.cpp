#include "ui/widgets/commands/help_overlay.h"

#include "ui/theme.h"
#include "ui/widgets/cut_text.h"
#include "ui/widgets/form.h"
#include "ui/widgets/item_map.h"
#include "ui/widgets/text_match.h"

#include <GLFW/glfw3.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numeric>
#include <vector>

namespace dollytrack::ui {
namespace {

constexpr const char* kId = "##help";

struct Line {
    std::string text;
    std::string keys;
};

struct Block {
    std::string title;
    std::vector<Line> lines;
    /// Height in lines of text, including two for the title and the gap below.
    [[nodiscard]] int height() const { return static_cast<int>(lines.size()) + 2; }
};

Block mouseBlock() {
    return {"Mouse in the viewport",
            {{"Select", "Click"},
             {"Select what lies behind it", "Click again"},
             {"List what lies there", "Alt+Click"},
             {"Add to the selection", "Ctrl+Click"},
             {"Menu of the selection", "Right click"},
             {"Select with a box", "B, Left drag"},
             {"Add with a box", "B, Shift+Left drag"},
             {"Take out with a box", "B, Ctrl+Left drag"},
             {"Orbit", "Left or middle drag"},
             {"Pan", "Shift+Left or middle drag"},
             {"Zoom to the cursor", "Wheel"},
             {"Look around", "Right drag"},
             {"Fly", "Right drag + W A S D"},
             {"Fly down, up", "Right drag + Q, E"}}};
}

Block transformBlock() {
    return {"While moving or rotating",
            {{"Along an axis", "X, Y, Z"},
             {"Along an axis of its own", "X X, Y Y"},
             {"In a plane: lock an axis", "Shift+X, Y, Z"},
             {"Tilt a position point", "R X"},
             {"Exact value, m or degrees", "0-9 . -"},
             {"Value of the next axis", "Tab"},
             {"In steps of 0.1 m, 15\u00b0", "Ctrl"},
             {"In steps of 0.01 m, 1\u00b0", "Ctrl+Shift"},
             {"Done", "Enter, Click"},
             {"Cancel", "Esc, Right click"}}};
}

Block timelineBlock() {
    return {"Mouse in the timeline",
            {{"Go to a frame", "Click, Left drag"},
             {"Zoom", "Wheel"},
             {"Pan", "Middle drag"},
             {"Select a key of the camera path", "Click it"},
             {"Move it to another time", "Drag it"},
             {"Look through it", "Double click it"}}};
}

Block panelBlock() {
    return {"Mouse at panels",
            {{"Move a panel", "Drag its tab"},
             {"Choose its place, hide it", "Right click its tab"},
             {"Resize", "Drag the border"}}};
}

Block fieldBlock() {
    return {"Number fields",
            {{"Change", "Drag"},
             {"Type a value", "Double click, Ctrl+Click"},
             {"Finer", "Alt+Drag"},
             {"Coarser", "Shift+Drag"}}};
}

/// The commands, and what the mouse does. Without a filter, commands that have no key are left out,
/// so that everything fits into a small window.
std::vector<Block> makeBlocks(const CommandTable& commands, const std::string& filter) {
    std::vector<Block> blocks;
    for (const Command& command : commands.all()) {
        if (filter.empty() && command.keys().empty()) continue;
        auto block = std::ranges::find(blocks, command.group, &Block::title);
        if (block == blocks.end()) block = blocks.insert(blocks.end(), {command.group, {}});
        block->lines.push_back({command.title, command.keys()});
    }
    blocks.push_back(mouseBlock());
    blocks.push_back(transformBlock());
    blocks.push_back(timelineBlock());
    blocks.push_back(panelBlock());
    blocks.push_back(fieldBlock());
    for (Block& block : blocks) {
        if (containsIgnoringCase(block.title, filter)) continue;
        std::erase_if(block.lines, [&](const Line& line) {
            return !containsIgnoringCase(line.text, filter) &&
                   !containsIgnoringCase(line.keys, filter);
        });
    }
    std::erase_if(blocks, [](const Block& block) { return block.lines.empty(); });
    return blocks;
}

/// Number of columns needed if none may be higher than `height`; blocks are not split or reordered.
int columnsFor(const std::vector<Block>& blocks, int height) {
    int columns = 1;
    int used = 0;
    for (const Block& block : blocks) {
        if (used > 0 && used + block.height() > height) {
            ++columns;
            used = 0;
        }
        used += block.height();
    }
    return columns;
}

/// The smallest column height at which the blocks fit into `columns`.
int leastHeight(const std::vector<Block>& blocks, int columns) {
    int height = 0;
    for (const Block& block : blocks) height = std::max(height, block.height());
    while (columnsFor(blocks, height) > columns) ++height;
    return height;
}

constexpr float kGap = 8.0F;      // between a text and its keys
constexpr float kMargin = 16.0F;  // at either side of a column

/// Width of the widest line, px.
float widestOf(const std::vector<Block>& blocks) {
    float widest = scaled(200);
    for (const Block& block : blocks) {
        for (const Line& line : block.lines) {
            widest = std::max(widest, ImGui::CalcTextSize(line.text.c_str()).x + scaled(kGap) +
                                          ImGui::CalcTextSize(line.keys.c_str()).x);
        }
    }
    return widest;
}

void drawBlock(const Block& block) {
    ImGui::PushFont(fonts().bold);
    ImGui::TextUnformatted(block.title.c_str());
    ImGui::PopFont();
    for (const Line& line : block.lines) {
        const float room = ImGui::GetContentRegionAvail().x;
        const float right = ImGui::GetCursorPosX() + room;
        const float keys = ImGui::CalcTextSize(line.keys.c_str()).x;
        const float gap = line.keys.empty() ? 0.0F : scaled(kGap);
        cutText(line.text, ImGui::GetStyleColorVec4(ImGuiCol_Text), {}, Cut::End,
                room - keys - gap);
        if (line.keys.empty()) continue;
        ImGui::SameLine();
        // SameLine(x) would count from the table column.
        ImGui::SetCursorPosX(right - keys);
        ImGui::TextColored(palette().accent, "%s", line.keys.c_str());
    }
    ImGui::Dummy({0, ImGui::GetTextLineHeight() * 0.6F});
}

void drawBlocks(const std::vector<Block>& blocks, float width) {
    // No line is cut unless it is wider than the window.
    const float column = std::ceil(widestOf(blocks)) + 2 * scaled(kMargin) + 1.0F;
    const int most_columns = std::clamp(static_cast<int>(width / column), 1, 4);
    const int height = leastHeight(blocks, most_columns);
    const int columns = columnsFor(blocks, height);
    ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, {scaled(kMargin), 0});
    const bool begun = ImGui::BeginTable("columns", columns, ImGuiTableFlags_SizingStretchSame);
    ImGui::PopStyleVar();
    if (!begun) return;
    ImGui::TableNextColumn();
    int used = 0;
    for (const Block& block : blocks) {
        if (used > 0 && used + block.height() > height) {
            ImGui::TableNextColumn();
            used = 0;
        }
        drawBlock(block);
        used += block.height();
    }
    ImGui::EndTable();
}

}  // namespace

void drawHelpOverlay(const CommandTable& commands, HelpState& state) {
    if (!state.open) return;
    const bool begins = !state.shown;
    if (begins) {
        state.filter.clear();
        state.shown = true;
        ImGui::OpenPopup(kId);
    }
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const ImVec2 size = {std::min(scaled(1600), screen.x - scaled(40)),
                         std::min(scaled(760), screen.y - scaled(40))};
    ImGui::SetNextWindowPos({screen.x / 2, screen.y / 2}, ImGuiCond_Always, {0.5F, 0.5F});
    ImGui::SetNextWindowSize(size);
    pushDialogStyle();
    const bool visible =
        ImGui::BeginPopup(kId, ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings);
    popDialogStyle();
    if (!visible) {
        state.open = false;
        state.shown = false;
        return;
    }
    if (begins) ImGui::SetKeyboardFocusHere();
    ImGui::SetNextItemWidth(scaled(280));
    ImGui::InputTextWithHint("##filter", "Find a command or a key", &state.filter);
    nameItem("help.filter");
    ImGui::SameLine();
    ImGui::TextDisabled("Commands without a key are listed while you search.");
    const float close_width = ImGui::CalcTextSize("Close").x + 2 * ImGui::GetStyle().FramePadding.x;
    ImGui::SameLine(ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x - close_width);
    const bool closed = button("Close", "help.close");
    ImGui::Dummy({0, scaled(4)});
    ImGui::BeginChild("blocks");
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ImGui::GetStyle().ItemSpacing.x, scaled(2)});
    const std::vector<Block> blocks = makeBlocks(commands, state.filter);
    if (blocks.empty()) ImGui::TextDisabled("No match.");
    if (!blocks.empty()) drawBlocks(blocks, ImGui::GetContentRegionAvail().x);
    ImGui::PopStyleVar();
    ImGui::EndChild();
    const bool key = !begins && (ImGui::IsKeyPressed(GLFW_KEY_ESCAPE, false) ||
                                 ImGui::IsKeyPressed(GLFW_KEY_F1, false));
    if (closed || key) {
        ImGui::CloseCurrentPopup();
        state.open = false;
        state.shown = false;
    }
    ImGui::EndPopup();
}

}  // namespace dollytrack::ui
