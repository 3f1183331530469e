#include "ui/widgets/fields/number_input.h"

#include "engine/core/clean_text.h"
#include "ui/theme.h"
#include "ui/widgets/form.h"
#include "ui/widgets/item_map.h"
#include "ui/widgets/keyboard_wait.h"

#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <imgui.h>
#include <imgui_internal.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

namespace dollytrack::ui {
namespace {

constexpr double kNote_s = 6.0;
constexpr float kLeastMove_px = 3.0F;

/// The number being typed; only one field can have the keyboard.
struct Typing {
    std::string name;  // name of the field; empty: none
    std::string text;
    bool asked_for_keys = false;
    bool had_keys = false;
    int frame = 0;  // window frame in which the field was last drawn
};
/// The note on the last typed value.
struct Note {
    std::string name;
    std::string text;
    double until_s = 0.0;
};
/// Whether the current drag has changed the value.
struct Drag {
    std::string name;
    bool changed = false;
};
Typing typing;
Note note;
Drag drag;

std::string display(double value, const NumberLimits& limits) {
    std::array<char, 64> text = {};
    std::snprintf(text.data(), text.size(), limits.format.c_str(), value);  // NOLINT
    return text.data() + (limits.format.find('%') == std::string::npos ? "" : limits.unit);
}

std::string plain(double value, const NumberLimits& limits) {
    return fmt::format("{:.10g}", limits.whole ? std::round(value) : value);
}

void beginTyping(double value, const NumberLimits& limits, const std::string& name) {
    ImGui::ClearActiveID();
    typing = {name, plain(value, limits), false, false, ImGui::GetFrameCount()};
    note = {};
}

/// Draws a note below the previous item, inside the window.
void drawNote(const std::string& text, const ImVec4& color, const std::string& name) {
    const ImVec2 low = ImGui::GetItemRectMin();
    const ImVec2 high = ImGui::GetItemRectMax();
    const bool at_right = low.x > ImGui::GetIO().DisplaySize.x / 2;
    ImGui::SetNextWindowPos({at_right ? high.x : low.x, high.y + scaled(3)}, ImGuiCond_Always,
                            {at_right ? 1.0F : 0.0F, 0.0F});
    ImGui::Begin(("##note " + name).c_str(), nullptr,
                 ImGuiWindowFlags_Tooltip | ImGuiWindowFlags_NoInputs |
                     ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_AlwaysAutoResize |
                     ImGuiWindowFlags_NoFocusOnAppearing);
    ImGui::TextColored(color, "%s", text.c_str());
    nameItem(name + ".note");
    ImGui::End();
}

std::string rangeText(const NumberLimits& limits) {
    return limits.range.text() + limits.unit;
}

FieldEdit typeNumber(double& value, const NumberLimits& limits, const std::string& name) {
    FieldEdit edit;
    edit.says = true;
    typing.frame = ImGui::GetFrameCount();
    if (!std::exchange(typing.asked_for_keys, true)) ImGui::SetKeyboardFocusHere();
    const bool entered =
        ImGui::InputText("##typed", &typing.text,
                         ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
    const bool has_keys = ImGui::IsItemActive();
    typing.had_keys = typing.had_keys || has_keys;
    if (!typing.had_keys) awaitKeyboard();
    const TypedNumber read = readNumber(typing.text, limits);
    if (!entered && (has_keys || !typing.had_keys)) {
        const bool wrong = !read.note.empty() && !typing.text.empty();
        drawNote(rangeText(limits), wrong ? palette().bad : palette().text_dim, name);
        return edit;
    }
    typing = {};
    if (ImGui::IsKeyPressed(GLFW_KEY_ESCAPE, false)) return edit;
    if (!read.note.empty()) note = {name, read.note, ImGui::GetTime() + kNote_s};
    if (read.value) {
        edit.changed = *read.value != value;
        edit.finished = edit.changed;
        value = *read.value;
    } else {
        note.text += fmt::format("; it stays {}", display(value, limits));
    }
    return edit;
}

/// Position of a value along the bar, 0..1.
double shareOf(double value, const NumberLimits& limits) {
    const auto& [min, max, least] = limits.range;
    const double inside = std::clamp(value, min, max);
    if (limits.logarithmic) return std::log(inside / min) / std::log(max / min);
    return (inside - min) / (max - min);
}

/// A bar behind the number, which a slider knob would hide.
void drawBar(double value, const NumberLimits& limits) {
    const ImVec2 low = ImGui::GetItemRectMin();
    const ImVec2 high = ImGui::GetItemRectMax();
    const float edge = scaled(2) + ImGui::GetStyle().GrabMinSize / 2;
    const float x =
        low.x + edge + static_cast<float>(shareOf(value, limits)) * (high.x - low.x - 2 * edge);
    ImVec4 fill = palette().accent;
    fill.w = ImGui::IsItemActive() ? 0.6F : 0.4F;
    ImDrawList* list = ImGui::GetWindowDrawList();
    const float rounding = ImGui::GetStyle().FrameRounding;
    list->AddRectFilled(low, {x, high.y}, ImGui::GetColorU32(fill), rounding,
                        ImDrawFlags_RoundCornersLeft);
    const std::string text = display(value, limits);
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    list->PushClipRect(low, high, true);
    list->AddText(
        {std::floor((low.x + high.x - size.x) / 2), low.y + ImGui::GetStyle().FramePadding.y},
        ImGui::GetColorU32(ImGuiCol_Text), text.c_str());
    list->PopClipRect();
}

bool slide(double& value, const NumberLimits& limits) {
    for (const ImGuiCol color : {ImGuiCol_Text, ImGuiCol_SliderGrab, ImGuiCol_SliderGrabActive}) {
        ImGui::PushStyleColor(color, ImVec4(0, 0, 0, 0));
    }
    const bool changed =
        ImGui::SliderScalar("##value", ImGuiDataType_Double, &value, &limits.range.min,
                            &limits.range.max, limits.format.c_str(),
                            ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_NoInput |
                                (limits.logarithmic ? ImGuiSliderFlags_Logarithmic : 0));
    ImGui::PopStyleColor(3);
    return changed;
}

FieldEdit moveNumber(double& value, const NumberLimits& limits, const std::string& name) {
    FieldEdit edit;
    double moved = value;
    // A percent sign in a unit would be read as a format.
    const std::string format =
        limits.format.find('%') == std::string::npos ? limits.format : limits.format + limits.unit;
    const bool asked =
        limits.slides ? slide(moved, limits)
                      : ImGui::DragScalar("##value", ImGuiDataType_Double, &moved, limits.speed,
                                          &limits.range.min, &limits.range.max, format.c_str(),
                                          ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_NoInput);
    if (ImGui::IsItemActivated()) drag = {name, false};
    // The first press of a double click must not change the value.
    const bool only_pressed =
        ImGui::IsMouseDown(ImGuiMouseButton_Left) &&
        !ImGui::IsMouseDragPastThreshold(ImGuiMouseButton_Left, kLeastMove_px);
    if (asked && !only_pressed) {
        moved = limits.range.nearest(moved);
        edit.changed = moved != value;
        drag.changed = drag.changed || edit.changed;
        value = moved;
        note = {};
    }
    if (ImGui::IsItemDeactivated() && drag.name == name) {
        edit.finished = std::exchange(drag, {}).changed;
    }
    if (limits.slides) drawBar(value, limits);
    const bool typed = ImGui::IsItemHovered() &&
                       (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left) ||
                        (ImGui::IsMouseClicked(ImGuiMouseButton_Left) && ImGui::GetIO().KeyCtrl));
    const bool by_key = ImGui::IsItemFocused() && !ImGui::IsItemActive() &&
                        ImGui::IsKeyPressed(GLFW_KEY_ENTER, false);
    if (typed || by_key) beginTyping(value, limits, name);
    return edit;
}

}  // namespace

TypedNumber readNumber(const std::string& text, const NumberLimits& limits) {
    std::string number(trimmed(text));
    const std::string_view unit = trimmed(limits.unit);
    if (!unit.empty() && number.ends_with(unit)) {
        number = trimmed(number.substr(0, number.size() - unit.size()));
    }
    if (std::ranges::count(number, ',') == 1) std::ranges::replace(number, ',', '.');
    if (number.starts_with('+')) number.erase(0, 1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
    if (error != std::errc() || end != number.data() + number.size() || !std::isfinite(value)) {
        return {std::nullopt, fmt::format("\"{}\" is not a number", text)};
    }
    TypedNumber read;
    read.value = limits.range.nearest(value);
    if (*read.value != value) {
        read.note = fmt::format("{}; set to {}{}", rangeText(limits), plain(*read.value, limits),
                                limits.unit);
    } else if (limits.whole && std::round(value) != value) {
        read.value = std::round(value);
        read.note = fmt::format("whole numbers only; set to {:.0f}{}", *read.value, limits.unit);
    }
    return read;
}

bool typedNumberField(std::string& text, const NumberLimits& limits, const std::string& name,
                      const std::string& label) {
    if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
    ImGui::SetNextItemWidth(scaled(120));
    ImGui::InputText(("##" + name).c_str(), &text);
    nameItem(name);
    const TypedNumber typed = readNumber(text, limits);
    // Enter leaves the field; what is no number can be corrected at once.
    if (ImGui::IsItemDeactivated() && !typed.value) ImGui::SetKeyboardFocusHere(-1);
    ImGui::SameLine();
    ImGui::TextUnformatted(label.c_str());
    if (!typed.note.empty()) paragraph(typed.note, palette().warning);
    return typed.value.has_value();
}

FieldEdit numberInput(double& value, const NumberLimits& limits, const std::string& name) {
    // A field that disappears while being typed into does not resume typing when it returns.
    if (typing.name == name && ImGui::GetFrameCount() > typing.frame + 1) typing = {};
    ImGui::PushID(name.c_str());
    FieldEdit edit =
        typing.name == name ? typeNumber(value, limits, name) : moveNumber(value, limits, name);
    ImGui::PopID();
    nameItem(name);
    if (note.name == name) {
        edit.says = true;
        drawNote(note.text, palette().warning, name);
        if (ImGui::GetTime() > note.until_s) note = {};
    }
    return edit;
}

}  // namespace dollytrack::ui
