#include "ui/widgets/commands/command_palette.h"

#include "engine/scene/scene_report.h"
#include "ui/theme.h"
#include "ui/widgets/form.h"
#include "ui/widgets/item_map.h"

#include <GLFW/glfw3.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>

namespace dollytrack::ui {
namespace {

using Hit = CommandPaletteState::Hit;

constexpr const char* kId = "##command_palette";
constexpr std::size_t kMostHits = 200;

std::string commandText(const Command& command) {
    return command.group + ": " + command.title;
}

std::string hitText(const CommandPaletteView& view, const Hit& hit) {
    switch (hit.kind) {
        case Hit::Kind::Command:
            return commandText(view.commands->all()[hit.index]);
        case Hit::Kind::Parameter:
            return (*view.parameters)[hit.index].name;
        case Hit::Kind::Object:
            return view.scene->objects[hit.index].name;
    }
    return {};
}

std::string hitNote(const CommandPaletteView& view, const Hit& hit) {
    switch (hit.kind) {
        case Hit::Kind::Command:
            return view.commands->all()[hit.index].keys();
        case Hit::Kind::Parameter:
            return "parameter";
        case Hit::Kind::Object:
            return className(view.scene->objects[hit.index]);
    }
    return {};
}

std::string whyNot(const CommandPaletteView& view, const Hit& hit) {
    if (hit.kind != Hit::Kind::Command) return {};
    const Command& command = view.commands->all()[hit.index];
    return command.why_not ? command.why_not() : std::string();
}

std::string itemName(const CommandPaletteView& view, const Hit& hit) {
    switch (hit.kind) {
        case Hit::Kind::Command:
            return "palette.command." + view.commands->all()[hit.index].id;
        case Hit::Kind::Parameter:
            return "palette.parameter." + (*view.parameters)[hit.index].name;
        case Hit::Kind::Object:
            return "palette.object." + std::to_string(view.scene->objects[hit.index].id);
    }
    return {};
}

/// Draws a text with the matched characters in the accent colour.
void drawMatched(const std::string& text, const FuzzyMatch& match, ImVec2 at, bool enabled) {
    ImDrawList* draw = ImGui::GetWindowDrawList();
    const ImU32 plain = ImGui::GetColorU32(enabled ? ImGuiCol_Text : ImGuiCol_TextDisabled);
    const ImU32 matched = ImGui::GetColorU32(palette().accent);
    std::size_t next = 0;
    for (std::size_t i = 0; i < text.size();) {
        const bool hit = next < match.places.size() && match.places[next] == i;
        std::size_t end = i + 1;
        if (hit) {
            ++next;
        } else {
            const std::size_t stop = next < match.places.size() ? match.places[next] : text.size();
            end = std::max(end, stop);
        }
        const char* begin = text.data() + i;
        draw->AddText(at, hit ? matched : plain, begin, text.data() + end);
        at.x += ImGui::CalcTextSize(begin, text.data() + end).x;
        i = end;
    }
}

void drawHit(const CommandPaletteView& view, const Hit& hit, bool selected, bool& pressed) {
    const std::string why_not = whyNot(view, hit);
    const bool enabled = why_not.empty();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float right = at.x + ImGui::GetContentRegionAvail().x;
    const float pad = scaled(6);
    ImGui::PushID(itemName(view, hit).c_str());
    pressed = ImGui::Selectable("##hit", selected, 0, {0, ImGui::GetTextLineHeight() + 2 * pad}) &&
              enabled;
    ImGui::PopID();
    nameItem(itemName(view, hit), enabled);
    if (!enabled) {
        tooltip(why_not);
    } else if (hit.kind == Hit::Kind::Parameter) {
        tooltip((*view.parameters)[hit.index].text);
    }
    drawMatched(hitText(view, hit), hit.match, {at.x + pad, at.y + pad}, enabled);
    const std::string note = selected && !enabled ? why_not : hitNote(view, hit);
    const float width = ImGui::CalcTextSize(note.c_str()).x;
    ImGui::GetWindowDrawList()->AddText({right - width - pad, at.y + pad},
                                        ImGui::GetColorU32(palette().text_dim), note.c_str());
}

void choose(const CommandPaletteView& view, const Hit& hit, CommandPaletteActions& actions) {
    switch (hit.kind) {
        case Hit::Kind::Command:
            actions.run = view.commands->all()[hit.index].id;
            break;
        case Hit::Kind::Parameter:
            actions.focus_parameter = (*view.parameters)[hit.index].name;
            break;
        case Hit::Kind::Object:
            actions.select_object = view.scene->objects[hit.index].id;
            break;
    }
}

/// Handles the arrow and page keys; returns whether the selection moved.
bool moveSelection(CommandPaletteState& state) {
    const int count = static_cast<int>(state.hits.size());
    int step = 0;
    if (ImGui::IsKeyPressed(GLFW_KEY_DOWN)) step = 1;
    if (ImGui::IsKeyPressed(GLFW_KEY_UP)) step = -1;
    if (ImGui::IsKeyPressed(GLFW_KEY_PAGE_DOWN)) step = 8;
    if (ImGui::IsKeyPressed(GLFW_KEY_PAGE_UP)) step = -8;
    if (step == 0 || count == 0) return false;
    state.selected = std::abs(step) == 1 ? (state.selected + step + count) % count
                                         : std::clamp(state.selected + step, 0, count - 1);
    return true;
}

bool drawHits(const CommandPaletteView& view, CommandPaletteState& state, bool moved,
              CommandPaletteActions& actions) {
    const bool enter =
        ImGui::IsKeyPressed(GLFW_KEY_ENTER, false) || ImGui::IsKeyPressed(GLFW_KEY_KP_ENTER, false);
    bool done = false;
    if (state.hits.empty()) {
        ImGui::TextDisabled("No match.");
        return false;  // a child of height 0 would fill the rest of the screen
    }
    const float row = ImGui::GetTextLineHeight() + 2 * scaled(6) + ImGui::GetStyle().ItemSpacing.y;
    const float most = ImGui::GetIO().DisplaySize.y * 0.6F;
    ImGui::BeginChild("hits", {0, std::min(most, row * static_cast<float>(state.hits.size()))});
    for (int i = 0; i < static_cast<int>(state.hits.size()); ++i) {
        const Hit& hit = state.hits[i];
        bool pressed = false;
        drawHit(view, hit, i == state.selected, pressed);
        if (moved && i == state.selected) ImGui::SetScrollHereY(0.5F);
        const bool by_key = enter && i == state.selected && whyNot(view, hit).empty();
        if (!pressed && !by_key) continue;
        choose(view, hit, actions);
        done = true;
    }
    ImGui::EndChild();
    return done;
}

}  // namespace

std::vector<Hit> findInPalette(const CommandPaletteView& view, const std::string& text) {
    std::vector<Hit> hits;
    const auto consider = [&](Hit::Kind kind, std::size_t index, const std::string& name) {
        if (auto match = fuzzyMatch(text, name)) hits.push_back({kind, index, std::move(*match)});
    };
    if (view.commands != nullptr) {
        for (std::size_t i = 0; i < view.commands->all().size(); ++i) {
            consider(Hit::Kind::Command, i, commandText(view.commands->all()[i]));
        }
    }
    if (text.empty()) {
        for (Hit& hit : hits) hit.match = {};
        return hits;
    }
    if (view.parameters != nullptr) {
        for (std::size_t i = 0; i < view.parameters->size(); ++i) {
            consider(Hit::Kind::Parameter, i, (*view.parameters)[i].name);
        }
    }
    if (view.scene != nullptr) {
        for (std::size_t i = 0; i < view.scene->objects.size(); ++i) {
            consider(Hit::Kind::Object, i, view.scene->objects[i].name);
        }
    }
    std::ranges::stable_sort(hits, std::ranges::greater{},
                             [](const Hit& hit) { return hit.match.score; });
    if (hits.size() > kMostHits) hits.resize(kMostHits);
    return hits;
}

CommandPaletteActions drawCommandPalette(const CommandPaletteView& view,
                                         CommandPaletteState& state) {
    CommandPaletteActions actions;
    if (!state.open) return actions;
    const bool begins = !ImGui::IsPopupOpen(kId) && !state.found;
    if (begins) {
        state.text.clear();
        state.selected = 0;
        ImGui::OpenPopup(kId);
    }
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const float width = std::min(scaled(600), screen.x - scaled(40));
    ImGui::SetNextWindowPos({screen.x / 2, screen.y * 0.12F}, ImGuiCond_Always, {0.5F, 0.0F});
    ImGui::SetNextWindowSize({width, 0});
    if (!ImGui::BeginPopup(kId, ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings)) {
        state.open = false;
        state.found = false;
        return actions;
    }
    if (begins) ImGui::SetKeyboardFocusHere();
    ImGui::SetNextItemWidth(-1);
    ImGui::InputTextWithHint("##text", "Find a command, a parameter or an object", &state.text);
    nameItem("palette.text");
    bool moved = moveSelection(state);
    if (!state.found || state.found_for != state.text) {
        state.hits = findInPalette(view, state.text);
        state.found_for = state.text;
        state.found = true;
        state.selected = 0;
        moved = true;
    }
    const bool done = drawHits(view, state, moved, actions);
    if (done || ImGui::IsKeyPressed(GLFW_KEY_ESCAPE, false)) {
        ImGui::CloseCurrentPopup();
        state.open = false;
        state.found = false;
    }
    ImGui::EndPopup();
    return actions;
}

}  // namespace dollytrack::ui
