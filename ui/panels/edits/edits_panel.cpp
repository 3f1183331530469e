#include "ui/panels/edits/edits_panel.h"

#include "engine/document/apply_scene_edits.h"
#include "engine/plan/object_key.h"
#include "engine/scene/labels.h"
#include "ui/panels/edits/edit_parts.h"
#include "ui/panels/edits/region_rows.h"
#include "ui/theme.h"
#include "ui/widgets/cut_text.h"
#include "ui/widgets/fields/drag_fields.h"
#include "ui/widgets/fields/text_field.h"
#include "ui/widgets/form.h"
#include "ui/widgets/item_map.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dollytrack::ui {
namespace {

using nlohmann::json;

constexpr double kNoLimit_m = 100.0;  // upper end of the height band that counts as no limit

bool section(const char* title, std::size_t count, const std::string& name) {
    const std::string label = fmt::format("{}  {}###{}", title, count, name);
    ImGui::PushFont(fonts().bold);
    const bool open = ImGui::CollapsingHeader(label.c_str(), ImGuiTreeNodeFlags_DefaultOpen);
    ImGui::PopFont();
    nameItem(name);
    return open;
}

std::string namesOf(const std::vector<ObjectRef>& objects) {
    std::string text;
    for (const ObjectRef& object : objects) text += (text.empty() ? "" : ", ") + object.name;
    return text;
}

json keysOf(const Scene& scene, const std::vector<ObjectRef>& objects) {
    std::vector<int> ids;
    for (const ObjectRef& object : objects) ids.push_back(findObject(scene, object));
    if (std::ranges::find(ids, 0) != ids.end()) return nullptr;
    return objectKeys(scene, ids);
}

std::string changeText(const ObjectChange& change) {
    std::vector<std::string> parts;
    if (change.role) parts.emplace_back(*change.role == Role::Target ? "target" : "excluded");
    if (change.nyu40) parts.emplace_back(nyu40Name(*change.nyu40));
    if (change.front) {
        const double angle = std::atan2(change.front->y(), change.front->x());
        parts.push_back(fmt::format("front {:.0f}\u00b0", angle * 180.0 / std::numbers::pi));
    }
    if (change.large) parts.emplace_back(*change.large ? "large" : "small");
    if (change.move && !change.move->offset_m.isZero(0.0)) {
        parts.push_back(fmt::format("moved {:.2f} m", change.move->offset_m.norm()));
    }
    if (!change.track.empty()) {
        parts.push_back(fmt::format("track to {:g} s", change.track.back().time_s));
    }
    if (change.move && change.move->turn_rad != 0.0) {
        parts.push_back(
            fmt::format("turned {:.0f}\u00b0", change.move->turn_rad * 180.0 / std::numbers::pi));
    }
    return fmt::format("{}", fmt::join(parts, ", "));
}

void drawChanges(const EditsView& view, EditsActions& actions) {
    const auto& changes = view.edits->scene.changes;
    if (changes.empty() || !section("Objects", changes.size(), "edits.objects")) return;
    for (const ObjectChange& change : changes) {
        const int id = findObject(*view.scene, change.object);
        const std::string name = "edits.object." + std::to_string(change.object.id);
        if (id == 0) {
            ImGui::TextColored(palette().warning, "%s", change.object.name.c_str());
            tooltip("This object is not in the scene; the change applies when it returns.");
        } else {
            if (link(change.object.name, name + ".select")) {
                actions.select = Selection::ofObject(id);
            }
            ImGui::SameLine();
            ImGui::TextColored(palette().text_dim, "%s", changeText(change).c_str());
            flowTo("Reset");
            if (button(("Reset##" + name).c_str(), name + ".reset",
                       {.tip = "As the scene has it", .small = true})) {
                actions.edit.operation = {{"op", "reset_object"},
                                          {"object", objectKey(*view.scene, id)}};
            }
        }
    }
}

void drawDefinitions(const EditsView& view) {
    const auto& definitions = view.edits->scene.definitions;
    if (definitions.empty() || !section("New objects", definitions.size(), "edits.definitions")) {
        return;
    }
    for (const ObjectDefinition& definition : definitions) {
        const bool merge = definition.kind == ObjectDefinition::Kind::Merge;
        const std::string from = namesOf(definition.objects);
        ImGui::TextWrapped("%s",
                           merge ? fmt::format("{}: merged from {}", definition.name, from).c_str()
                                 : fmt::format("{}: split into its pieces", from).c_str());
        tooltip("Undo it with Undo or in the history.");
    }
}

/// Splits a comma-separated list and trims spaces.
std::vector<std::string> listed(const std::string& text) {
    std::vector<std::string> list;
    std::size_t begin = 0;
    while (begin <= text.size()) {
        const std::size_t comma = std::min(text.find(',', begin), text.size());
        const std::size_t first = std::min(text.find_first_not_of(' ', begin), comma);
        std::size_t last = comma;
        while (last > first && text[last - 1] == ' ') --last;
        if (last > first) list.push_back(text.substr(first, last - first));
        begin = comma + 1;
    }
    return list;
}

void drawTargetLists(const EditsView& view, EditsActions& actions) {
    heading("Targets");
    if (!beginForm("targets")) return;
    const auto row = [&](const char* label, const char* op, const char* tip,
                         const std::vector<std::string>& list) {
        formLabel(label, tip);
        std::string text = fmt::format("{}", fmt::join(list, ", "));
        if (!textField(text, std::string("edits.") + op) || listed(text) == list) return;
        actions.edit.operation = {{"op", op}, {"what", listed(text)}};
    };
    const SceneEdits& scene = view.edits->scene;
    row("Ignore", "ignore",
        "Classes, or names with * and ?, that are not targets, separated by commas: lamp*, curtain",
        scene.ignore);
    row("Only", "only", "If set, the only targets (classes or names)", scene.only);
    endForm();
}

/// Buttons that set or clear a pinned point as the start or end of the trajectory.
void drawEnds(const EditsView& view, const PinnedPoint& point, const std::string& name,
              EditsActions& actions) {
    const auto end = [&](const char* label, const char* op, const std::string& at,
                         const std::string& tip) {
        const bool is = at == point.name;
        const std::string text = std::string(is ? "\u25cf " : "\u25cb ") + label;
        flowTo(text.c_str());
        if (!button(text.c_str(), name + "." + op, {.tip = tip})) return;
        actions.edit.operation = {{"op", op}};
        if (!is) actions.edit.operation["point"] = point.name;
    };
    end("Start", "set_start", view.edits->plan.start,
        "The trajectory starts here; empty: anywhere");
    end("End", "set_end", view.edits->plan.end, "The trajectory ends here; empty: anywhere");
}

/// Shows whether the plan visits the pinned point; "being checked" while the plan is outdated.
void drawPinState(const EditsView& view, const PinnedPoint& point) {
    if (view.plan == nullptr || !view.plan_is_current) {
        flowTo("being checked \u2026");
        ImGui::TextColored(palette().text_dim, "being checked \u2026");
        return;
    }
    const auto refused = std::ranges::find(view.plan->refused_pins, point.name, &RefusedPin::name);
    if (refused == view.plan->refused_pins.end()) {
        flowTo("\u25cf visited");
        ImGui::TextColored(palette().good, "\u25cf visited");
        tooltip("Planning keeps this pose and visits it.");
    } else {
        // On separate lines, because reasons are long.
        paragraph("\u25cb not possible: " + refused->reason, palette().bad);
    }
}

void drawPins(const EditsView& view, EditsActions& actions) {
    const auto& pinned = view.edits->plan.pinned;
    if (pinned.empty() || !section("Pinned points", pinned.size(), "edits.pins")) return;
    for (std::size_t i = 0; i < pinned.size(); ++i) {
        const PinnedPoint& point = pinned[i];
        const std::string name = "edits.pin." + std::to_string(i);
        ImGui::PushID(name.c_str());
        const std::string for_what =
            point.objects.empty() ? "Placed from a view" : "For " + namesOf(point.objects);
        cutText(point.name, ImGui::GetStyleColorVec4(ImGuiCol_Text),
                for_what + ", at " + placeText(point.pose.position), Cut::Middle);
        drawPinState(view, point);
        if (button("Look through", name + ".look")) actions.look_through = point.pose;
        ImGui::SameLine();
        const bool added = point.objects.empty();
        if (button(added ? "Delete" : "Unpin", name + ".unpin",
                   {.tip = added ? "Remove this point" : "The planner chooses the pose again"})) {
            actions.edit.operation = {{"op", "unpin"}, {"point", point.name}};
        }
        drawEnds(view, point, name, actions);
        ImGui::PopID();
    }
}

void drawRemoved(const EditsView& view, EditsActions& actions) {
    const auto& removed = view.edits->plan.removed;
    if (removed.empty() || !section("Removed points", removed.size(), "edits.removed")) return;
    for (std::size_t i = 0; i < removed.size(); ++i) {
        const std::string name = "edits.removed." + std::to_string(i);
        const json keys = keysOf(*view.scene, removed[i].objects);
        const std::string why_not =
            keys.is_null() ? "An object of this point is no longer in the scene." : "";
        ImGui::TextWrapped("%s", namesOf(removed[i].objects).c_str());
        flowTo("Restore");
        if (button(("Restore##" + name).c_str(), name + ".restore",
                   {.why_not = why_not, .small = true})) {
            actions.edit.operation = {{"op", "restore_point"}, {"objects", keys}};
        }
    }
}

/// Draws the no-go boxes and the buttons that add one.
void drawBoxes(const EditsView& view, EditsActions& actions) {
    const auto& boxes = view.edits->plan.no_go;
    if (!section("No-go boxes", boxes.size(), "edits.boxes")) return;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        const std::string name = "edits.box." + std::to_string(i);
        ImGui::PushID(name.c_str());
        if (link(boxes[i].name, name + ".select")) {
            actions.select = Selection::ofItem(Selection::Kind::NoGoBox, static_cast<int>(i));
        }
        if (beginForm("box")) {
            noGoRows(boxes[i], name, actions.edit);
            endForm();
        }
        if (button("Go to", name + ".go_to")) actions.frame = boxes[i].box;
        ImGui::SameLine();
        if (button("Delete", name + ".delete")) {
            actions.edit.operation = {{"op", "remove_no_go"}, {"name", boxes[i].name}};
        }
        ImGui::PopID();
        ImGui::Spacing();
    }
    if (button("Add box", "edits.add_box", {.tip = "On the surface at the centre of the view"})) {
        actions.edit.operation = addNoGoOperation(view.new_box);
    }
    flowTo("Add around selection");
    const std::string why_not = view.around_selection ? "" : "Select an object first.";
    if (button("Add around selection", "edits.add_box_around", {.why_not = why_not})) {
        actions.edit.operation = addNoGoOperation(*view.around_selection);
    }
}

void drawRegions(const EditsView& view, EditsActions& actions) {
    const auto& regions = view.edits->plan.regions;
    if (!section("Regions", regions.size(), "edits.regions")) return;
    for (std::size_t i = 0; i < regions.size(); ++i) {
        const std::string name = "edits.region." + std::to_string(i);
        ImGui::PushID(name.c_str());
        if (link(regions[i].name, name + ".select")) {
            actions.select = Selection::ofItem(Selection::Kind::Region, static_cast<int>(i));
        }
        if (beginForm("region")) {
            regionRows(regions[i], name, actions.edit);
            endForm();
        }
        if (view.plan != nullptr && view.plan_is_current) {
            if (const auto seen = seenText(*view.plan, regions[i])) {
                ImGui::TextColored(palette().text_dim, "%s", seen->c_str());
            }
        }
        if (button("Go to", name + ".go_to")) actions.frame = regions[i].box;
        ImGui::SameLine();
        if (button("Delete", name + ".delete")) {
            actions.edit.operation = {{"op", "remove_region"}, {"name", regions[i].name}};
        }
        ImGui::PopID();
        ImGui::Spacing();
    }
    if (button("Add region", "edits.add_region",
               {.tip = "A box that weights the objects inside, or whose surface must be seen "
                       "completely"})) {
        actions.edit.operation =
            addRegionOperation(view.around_selection ? *view.around_selection : view.new_box);
    }
}

void drawHeights(const EditsView& view, EditsActions& actions) {
    heading("Camera height");
    if (!beginForm("heights")) return;
    double low = view.min_height_m;
    double high = view.max_height_m;
    constexpr double kNarrowest_m = 0.05;
    formLabel("At least", "Above the floor below the camera");
    const FieldEdit lower =
        dragNumber(low, {0.0, high - kNarrowest_m, 0.01F, low > 0.0 ? "%.2f" : "no limit", " m"},
                   "edits.height.min");
    formLabel("At most", "Above the floor below the camera");
    const bool limited = high < kNoLimit_m;
    // From "no limit", a slow drag would take minutes to reach a room's height.
    const FieldEdit upper = dragNumber(high,
                                       {low + kNarrowest_m, kNoLimit_m, limited ? 0.01F : 1.0F,
                                        limited ? "%.2f" : "no limit", " m"},
                                       "edits.height.max", "Double-click to type");
    endForm();
    if (limited || low > 0.0) {
        if (button("No limits", "edits.height.reset")) {
            actions.edit.operation = {{"op", "height_band"}};
        }
    }
    if (lower.changed || upper.changed) {
        actions.edit.operation = {{"op", "height_band"}, {"min_m", low}, {"max_m", high}};
        actions.edit.merge_key = lower.changed ? "height.min" : "height.max";
    }
    actions.edit.ends_merge = actions.edit.ends_merge || lower.finished || upper.finished;
}

}  // namespace

EditsActions drawEditsPanel(const EditsView& view, MoveDraft& move) {
    EditsActions actions;
    if (view.edits == nullptr || view.scene == nullptr) {
        ImGui::TextDisabled("No project is open.");
        return actions;
    }
    ImGui::BeginChild("edits");
    const Edits& edits = *view.edits;
    if (edits.scene == SceneEdits{} && edits.plan == PlanEdits{}) {
        paragraph("There are no manual edits. Select an object or a position point to edit it.",
                  palette().text_dim);
    }
    drawChanges(view, actions);
    drawDefinitions(view);
    drawPins(view, actions);
    drawRemoved(view, actions);
    actions.motion = drawMotionSection(view.motion, move);
    drawBoxes(view, actions);
    drawRegions(view, actions);
    drawHeights(view, actions);
    drawTargetLists(view, actions);
    ImGui::EndChild();
    return actions;
}

}  // namespace dollytrack::ui
