#include "ui/widgets/fields/field_editor.h"

#include "ui/theme.h"
#include "ui/widgets/item_map.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace dollytrack::ui {
namespace {

/// Wider ranges are too coarse for a slider; a drag changes the value in proportion to it.
constexpr double kWidestSlider = 400.0;

std::string unitSuffix(const Field& field) {
    std::string unit(field.unit());
    if (unit == "deg") return "\u00b0";
    if (unit == "m3") return " m\u00b3";
    if (unit == "deg/s") return "\u00b0/s";
    if (unit.empty()) return {};
    return " " + unit;
}

int decimals(double min, double max) {
    const double range = max - min;
    if (range <= 1.0) return 3;
    if (range <= 20.0) return 2;
    return 1;
}

FieldEdit edit(const Field::Real& real, const Field& field, const std::string& path) {
    NumberLimits limits;
    limits.range = real.info.range();
    const auto& [min, max, least] = limits.range;
    limits.unit = unitSuffix(field);
    limits.slides = max - min <= kWidestSlider;
    limits.logarithmic = min > 0.0 && max / min >= 50.0;
    limits.format = limits.slides ? fmt::format("%.{}f", decimals(min, max)) : "%.3g";
    limits.speed = static_cast<float>(std::max(0.01 * std::abs(*real.value), 0.01));
    return numberInput(*real.value, limits, path);
}

FieldEdit edit(const Field::Integer& integer, const Field& field, const std::string& path) {
    NumberLimits limits;
    limits.range = integer.info.range();
    limits.range.min = std::max(limits.range.min, -2147483647.0);
    limits.range.max = std::min(limits.range.max, 2147483647.0);
    limits.unit = unitSuffix(field);
    limits.whole = true;
    limits.format = "%.0f";
    limits.slides = limits.range.max - limits.range.min <= kWidestSlider;
    limits.speed = static_cast<float>(std::max(0.01 * std::abs(*integer.value), 0.2));
    double value = *integer.value;
    const FieldEdit result = numberInput(value, limits, path);
    if (result.changed) *integer.value = static_cast<int>(std::lround(value));
    return result;
}

/// A discrete choice is changed and finished at once.
FieldEdit chosen(bool changed) {
    return {changed, changed};
}

FieldEdit edit(const Field::Switch& on_off, const Field&, const std::string& path) {
    const FieldEdit result = chosen(ImGui::Checkbox("##value", on_off.value));
    nameItem(path);
    return result;
}

FieldEdit edit(const Field::Choice& choice, const Field&, const std::string& path) {
    const int now = choice.get();
    bool changed = false;
    const bool open = ImGui::BeginCombo("##value", std::string(choice.info.names[now]).c_str());
    if (open) {
        for (int i = 0; i < static_cast<int>(choice.info.names.size()); ++i) {
            const std::string name(choice.info.names[i]);
            if (ImGui::Selectable(name.c_str(), i == now)) {
                choice.set(i);
                changed = true;  // also for the same entry: a preset resets values
            }
            nameItem("choice." + name);
        }
        ImGui::EndCombo();
    }
    nameItem(path);
    return chosen(changed);
}

FieldEdit drawWidget(const Field& field, const std::string& path) {
    return std::visit([&](const auto& value) { return edit(value, field, path); }, field.value);
}

void copyValue(const Field& from, const Field& to) {
    std::visit(
        [&to](const auto& source) {
            using Kind = std::decay_t<decltype(source)>;
            const auto& target = std::get<Kind>(to.value);
            if constexpr (std::is_same_v<Kind, Field::Choice>) {
                target.set(source.get());
            } else {
                *target.value = *source.value;
            }
        },
        from.value);
}

void explainField(const Field& field, const Field& standard, const FieldNotes& notes = {}) {
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(scaled(340));
    // The tooltip may cover the note below the field.
    if (!notes.note.empty()) ImGui::TextColored(palette().warning, "%s", notes.note.c_str());
    if (!notes.no_effect_with.empty()) {
        ImGui::TextColored(palette().warning, "No effect with %s", notes.no_effect_with.c_str());
    } else if (const std::string condition(field.onlyWith()); !condition.empty()) {
        ImGui::TextDisabled("Only with %s", condition.c_str());
    }
    ImGui::TextUnformatted(std::string(field.text()).c_str());
    std::string range = field.rangeText();
    if (!field.unit().empty()) range += " " + std::string(field.unit());
    ImGui::TextDisabled("%s   %s", field.name.c_str(), range.c_str());
    const bool typed = std::holds_alternative<Field::Integer>(field.value) ||
                       std::holds_alternative<Field::Real>(field.value);
    ImGui::TextDisabled("default %s%s", standard.valueText().c_str(),
                        typed ? "; double-click to type" : "");
    if (const std::string symbol(field.symbol()); !symbol.empty()) {
        ImGui::TextDisabled("%s is its symbol in the method's paper", symbol.c_str());
    }
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

}  // namespace

std::string readableName(const Field& field) {
    std::string name = field.name;
    for (const char* unit :
         {"_m3", "_mps2", "_dps2", "_mps", "_dps", "_deg", "_px", "_mm", "_m", "_s", "_e"}) {
        if (name.ends_with(unit)) {
            name.resize(name.size() - std::char_traits<char>::length(unit));
            break;
        }
    }
    std::ranges::replace(name, '_', ' ');
    return name;
}

FieldEdit drawFieldValue(const Field& field, const Field& standard, const std::string& path) {
    ImGui::PushID(field.name.c_str());
    const FieldEdit result = drawWidget(field, path);
    if (!result.says && ImGui::IsItemHovered()) explainField(field, standard);
    ImGui::PopID();
    return result;
}

FieldEdit drawField(const Field& field, const Field& standard, const std::string& path,
                    const FieldNotes& notes) {
    FieldEdit result;
    ImGui::PushID(field.name.c_str());
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    const float alpha = ImGui::GetStyle().Alpha;
    ImGui::PushStyleVar(ImGuiStyleVar_Alpha, notes.no_effect_with.empty() ? alpha : 0.45F * alpha);
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(readableName(field).c_str());
    bool hovered = ImGui::IsItemHovered();
    ImGui::TableNextColumn();
    const bool differs = field.valueText() != standard.valueText();
    const float reset_width = ImGui::GetFrameHeight();
    ImGui::SetNextItemWidth(-(reset_width + ImGui::GetStyle().ItemInnerSpacing.x));
    // The list of a choice would be dimmed, too.
    const bool is_choice = std::holds_alternative<Field::Choice>(field.value);
    if (is_choice) ImGui::PopStyleVar();
    result = drawWidget(field, path);
    hovered = hovered || (!result.says && ImGui::IsItemHovered());
    if (!is_choice) ImGui::PopStyleVar();
    if (hovered) explainField(field, standard, notes);
    if (differs) {
        ImGui::SameLine(0.0F, ImGui::GetStyle().ItemInnerSpacing.x);
        if (ImGui::Button("\u21ba", {reset_width, 0})) {
            copyValue(standard, field);
            result = {true, true, true};
        }
        nameItem(path + ".reset");
        if (ImGui::IsItemHovered()) {
            ImGui::SetTooltip("Reset to %s", standard.valueText().c_str());
        }
    }
    if (!notes.note.empty()) {
        ImGui::PushTextWrapPos(0.0F);
        ImGui::TextColored(palette().warning, "%s", notes.note.c_str());
        ImGui::PopTextWrapPos();
        nameItem(path + ".used");
    }
    ImGui::PopID();
    return result;
}

}  // namespace dollytrack::ui
