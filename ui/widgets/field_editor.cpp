#include "ui/widgets/field_editor.h"

#include "ui/theme.h"
#include "ui/widgets/item_map.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>

namespace dollytrack::ui {
namespace {

/// Ranges this wide cannot be hit with a slider; there a drag changes the value in proportion.
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

bool edit(const Field::Real& real, const Field& field) {
    const double min = real.info.min;
    const double max = real.info.max;
    if (max - min <= kWidestSlider) {
        const std::string format =
            "%." + std::to_string(decimals(min, max)) + "f" + unitSuffix(field);
        const bool wide = min > 0.0 && max / min >= 50.0;
        return ImGui::SliderScalar(
            "##value", ImGuiDataType_Double, real.value, &min, &max, format.c_str(),
            ImGuiSliderFlags_AlwaysClamp | (wide ? ImGuiSliderFlags_Logarithmic : 0));
    }
    const std::string format = "%.3g" + unitSuffix(field);
    const auto speed = static_cast<float>(std::max(0.01 * std::abs(*real.value), 0.01));
    return ImGui::DragScalar("##value", ImGuiDataType_Double, real.value, speed, &min, &max,
                             format.c_str(), ImGuiSliderFlags_AlwaysClamp);
}

bool edit(const Field::Integer& integer, const Field& field) {
    const int min = static_cast<int>(std::max(integer.info.min, -2147483647.0));
    const int max = static_cast<int>(std::min(integer.info.max, 2147483647.0));
    const std::string format = "%d" + unitSuffix(field);
    if (integer.info.max - integer.info.min <= kWidestSlider) {
        return ImGui::SliderInt("##value", integer.value, min, max, format.c_str(),
                                ImGuiSliderFlags_AlwaysClamp);
    }
    const auto speed = static_cast<float>(std::max(0.01 * std::abs(*integer.value), 0.2));
    return ImGui::DragInt("##value", integer.value, speed, min, max, format.c_str(),
                          ImGuiSliderFlags_AlwaysClamp);
}

bool edit(const Field::Switch& on_off, const Field&) {
    return ImGui::Checkbox("##value", on_off.value);
}

bool edit(const Field::Choice& choice, const Field&) {
    const int now = choice.get();
    bool changed = false;
    if (ImGui::BeginCombo("##value", std::string(choice.info.names[now]).c_str())) {
        for (int i = 0; i < static_cast<int>(choice.info.names.size()); ++i) {
            const std::string name(choice.info.names[i]);
            if (ImGui::Selectable(name.c_str(), i == now)) {
                choice.set(i);
                changed = i != now;
            }
            nameItem("choice." + name);
        }
        ImGui::EndCombo();
    }
    return changed;
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

/// The number that is being typed, and into which field. There is one keyboard.
struct Typed {
    std::string field;
    std::string value;
};
Typed& typed() {
    static Typed the_number;
    return the_number;
}

void explainField(const Field& field, const Field& standard) {
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(scaled(340));
    ImGui::TextUnformatted(std::string(field.text()).c_str());
    std::string range = field.rangeText();
    if (!field.unit().empty()) range += " " + std::string(field.unit());
    ImGui::TextDisabled("%s   %s", field.name.c_str(), range.c_str());
    ImGui::TextDisabled("default %s; Ctrl+click to type", standard.valueText().c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

}  // namespace

std::string readableName(const Field& field) {
    std::string name = field.name;
    for (const char* unit : {"_m3", "_mps", "_dps", "_deg", "_px", "_m"}) {
        if (name.ends_with(unit)) {
            name.resize(name.size() - std::char_traits<char>::length(unit));
            break;
        }
    }
    std::ranges::replace(name, '_', ' ');
    return name;
}

FieldEdit drawField(const Field& field, const Field& standard, const std::string& path) {
    FieldEdit result;
    ImGui::PushID(field.name.c_str());
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(readableName(field).c_str());
    if (ImGui::IsItemHovered()) explainField(field, standard);
    if (!field.symbol().empty()) {
        ImGui::SameLine();
        ImGui::TextColored(palette().accent, "%s", std::string(field.symbol()).c_str());
    }
    ImGui::TableNextColumn();
    const bool differs = field.valueText() != standard.valueText();
    const float reset_width = ImGui::GetFrameHeight();
    ImGui::SetNextItemWidth(-(reset_width + ImGui::GetStyle().ItemInnerSpacing.x));
    result.changed = std::visit([&](const auto& value) { return edit(value, field); }, field.value);
    // A number that is being typed counts when it is whole: "0.45" is not 0, then 0.4, then 0.45.
    const bool typing = ImGui::TempInputIsActive(ImGui::GetItemID());
    if (typing && result.changed) {
        typed() = {path, field.valueText()};
        result.changed = false;
    }
    const bool drags = std::holds_alternative<Field::Real>(field.value) ||
                       std::holds_alternative<Field::Integer>(field.value);
    result.finished = drags ? ImGui::IsItemDeactivatedAfterEdit() : result.changed;
    if (!typing && typed().field == path) {
        const bool applied = setField({field}, field.name + "=" + typed().value).has_value();
        typed() = {};
        result.changed = result.changed || applied;
        result.finished = true;
    } else if (typing) {
        result.finished = false;
    }
    nameItem(path);
    if (ImGui::IsItemHovered()) explainField(field, standard);
    if (differs) {
        ImGui::SameLine(0.0F, ImGui::GetStyle().ItemInnerSpacing.x);
        if (ImGui::Button("\u21ba", {reset_width, 0})) {
            copyValue(standard, field);
            result = {true, true, true};
        }
        nameItem(path + ".reset");
        if (ImGui::IsItemHovered()) {
            ImGui::SetTooltip("Back to %s", standard.valueText().c_str());
        }
    }
    ImGui::PopID();
    return result;
}

}  // namespace dollytrack::ui
