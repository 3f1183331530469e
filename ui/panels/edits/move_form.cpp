#include "ui/panels/edits/move_form.h"

#include "ui/theme.h"
#include "ui/widgets/fields/drag_fields.h"
#include "ui/widgets/form.h"
#include "ui/widgets/item_map.h"

#include <fmt/format.h>
#include <imgui.h>

#include <utility>

namespace dollytrack::ui {
namespace {

using planning::MoveSetting;
using Options = planning::MoveOptions;

std::string itemName(const MoveSetting& setting) {
    return fmt::format("edits.move.{}", setting.name);
}

/// Draws the check box of an option: set, at first to `text`, or chosen by the program. Returns
/// whether it is set.
bool drawSwitch(const MoveSetting& setting, const std::string& text, Options& options) {
    const std::string name(setting.name);
    bool set = options.contains(name);
    if (ImGui::Checkbox(("##set" + name).c_str(), &set)) {
        if (set) {
            options[name] = text;
        } else {
            options.erase(name);
        }
    }
    nameItem(itemName(setting) + ".set", true);
    tooltip(set ? "Clear the box to have the value chosen to fit the scene"
                : "Chosen to fit the scene; tick the box to set it");
    ImGui::SameLine();
    if (set) return true;
    ImGui::AlignTextToFramePadding();
    ImGui::TextColored(palette().text_dim, "automatic");
    return false;
}

void drawNumber(const MoveSetting& setting, Options& options) {
    if (!drawSwitch(setting, planning::optionText(setting.usual), options)) return;
    std::string& text = options[std::string(setting.name)];
    const auto read = planning::readNumber(text);
    double value = read.value_or(setting.usual);
    const bool degrees = setting.info.unit == "\u00b0";
    const std::string unit = (degrees ? "" : " ") + std::string(setting.info.unit);
    ImGui::SetNextItemWidth(-1.0F);
    const FieldEdit edit = dragNumber(value,
                                      {setting.info.min, setting.info.max, degrees ? 1.0F : 0.02F,
                                       degrees ? "%.0f" : "%.2f", unit.c_str()},
                                      itemName(setting), std::string(setting.info.text));
    if (edit.changed) text = planning::optionText(value);
}

void drawPoint(const MoveSetting& setting, const Eigen::Vector3d& here, Options& options) {
    if (!drawSwitch(setting, planning::optionText(here), options)) return;
    std::string& text = options[std::string(setting.name)];
    Eigen::Vector3d point = planning::readPoint(text).value_or(here);
    if (button("Here", itemName(setting) + ".here", {.tip = "Take it from the viewport"})) {
        point = here;
        text = planning::optionText(here);
    }
    if (dragPoint(point, kPlaceRange, itemName(setting), std::string(setting.info.text)).changed) {
        text = planning::optionText(point);
    }
}

void drawSetting(const MoveFormView& view, const MoveSetting& setting, Options& options) {
    const std::string label = planning::settingLabel(setting.name);
    formLabel(label.c_str(), std::string(setting.info.text));
    switch (setting.kind) {
        case MoveSetting::Kind::Number:
            return drawNumber(setting, options);
        case MoveSetting::Kind::Point:
            // "Here" is the pivot of the view for the centre of a move, and its eye for both ends.
            return drawPoint(setting, setting.name == "center" ? view.pivot : view.eye, options);
        case MoveSetting::Kind::Object: {
            const bool has_center = options.contains("center");
            const std::string shown = has_center            ? "the centre below"
                                      : view.target.empty() ? "middle of the largest room"
                                                            : view.target;
            ImGui::AlignTextToFramePadding();
            ImGui::TextColored(
                has_center || view.target.empty() ? palette().text_dim : palette().accent, "%s",
                shown.c_str());
            nameItem(itemName(setting), true);
        }
    }
}

/// The move on the command line, where it has to name the selected object.
std::string commandLine(const MoveFormView& view, const MoveDraft& draft) {
    planning::MoveRequest move = draft.request();
    const bool at_object = !view.target.empty() && !move.options.contains("center") &&
                           view.target.find(',') == std::string::npos;
    if (at_object) move.options.try_emplace("target", view.target);
    return fmt::format("dollytrack repair SCENE --move '{}' -o PROJECT.dolly",
                       planning::moveText(move));
}

}  // namespace

planning::MoveRequest MoveDraft::request() const {
    planning::MoveRequest request;
    request.kind = kind;
    if (const auto set = options.find(kind); set != options.end()) request.options = set->second;
    return request;
}

MoveFormActions drawMoveForm(const MoveFormView& view, MoveDraft& draft) {
    ImGui::TextColored(palette().text_dim, "Make a camera move");
    bool first = true;
    for (const planning::MoveKind& kind : planning::moveKinds()) {
        const std::string label = planning::settingLabel(kind.name);
        if (!first) flowTo(label.c_str());
        first = false;
        if (button(
                label.c_str(), fmt::format("edits.motion.{}", kind.name),
                {.tip = planning::settingLabel(kind.text), .primary = kind.name == draft.kind})) {
            draft.kind = kind.name;
        }
    }
    const planning::MoveKind* kind = planning::findMoveKind(draft.kind);
    MoveFormActions actions;
    if (kind == nullptr) {
        draft.drawn = false;
        return actions;
    }
    if (beginForm("move", 0.3F)) {
        for (const MoveSetting& setting : kind->settings) {
            drawSetting(view, setting, draft.options[draft.kind]);
        }
        endForm();
    }
    const std::string label = "Make " + draft.kind;
    actions.make =
        button(label.c_str(), "edits.move.make",
               {.why_not = view.why_not,
                .tip = fmt::format("{}. On the command line: {}",
                                   planning::settingLabel(kind->text), commandLine(view, draft))});
    flowTo("Show");
    actions.show = button("Show", "edits.move.show",
                          {.why_not = view.has_path ? "" : "There is no path yet.",
                           .tip = "Bring the path in the viewport into view"});
    flowTo("Close");
    if (!actions.make && button("Close", "edits.move.close", {.tip = "Hide this form"}))
        draft.kind.clear();
    if (!view.note.empty()) {
        ImGui::PushStyleColor(ImGuiCol_Text, palette().text_dim);
        ImGui::TextWrapped("%s", view.note.c_str());
        ImGui::PopStyleColor();
        nameItem("edits.move.note", true);
    }
    // A form that opens below the visible part of the panel is brought into view.
    const float bottom = ImGui::GetWindowPos().y + ImGui::GetWindowHeight();
    if (!std::exchange(draft.drawn, true) && ImGui::GetItemRectMax().y > bottom) {
        ImGui::SetScrollHereY(1.0F);
    }
    return actions;
}

}  // namespace dollytrack::ui
