#include "ui/panels/edits/region_rows.h"

#include "ui/panels/edits/edit_parts.h"
#include "ui/widgets/fields/drag_fields.h"
#include "ui/widgets/fields/text_field.h"
#include "ui/widgets/form.h"
#include "ui/widgets/item_map.h"

#include <fmt/format.h>
#include <imgui.h>

#include <numbers>

namespace dollytrack::ui {
namespace {

using nlohmann::json;

}  // namespace

json addRegionOperation(const OrientedBox& box) {
    json operation = addNoGoOperation(box);
    operation["op"] = "add_region";
    return operation;
}

void regionRows(const Region& region, const std::string& name, EditRequest& edit) {
    const auto ask = [&](const FieldEdit& field, const char* what, json value) {
        if (field.changed) {
            edit.operation = {{"op", "change_region"}, {"name", region.name}};
            edit.operation[what] = std::move(value);
            edit.merge_key = "region." + region.name + "." + what;
        }
        edit.ends_merge = edit.ends_merge || field.finished;
    };
    formLabel("Name");
    std::string called = region.name;
    if (textField(called, name + ".name") && !called.empty() && called != region.name) {
        edit.operation = {{"op", "change_region"}, {"name", region.name}, {"to", called}};
    }
    formLabel("Weight", "Weight of the objects inside if frames are limited; outside it is 1");
    double weight = region.weight;
    const FieldEdit weighed =
        dragNumber(weight, {kSmallestWeight, kLargestWeight, 0.05F, "%.2f"}, name + ".weight");
    ask(weighed, "weight", weight);
    formLabel("Must see", "Frames must show all of its visible surface");
    bool must_see = region.must_see;
    if (ImGui::Checkbox("##must_see", &must_see)) {
        edit.operation = {{"op", "change_region"}, {"name", region.name}, {"must_see", must_see}};
    }
    nameItem(name + ".must_see");
    OrientedBox box = region.box;
    const BoxEdit changes = boxRows(box, name);
    ask(changes.center, "center", pointJson(box.center));
    ask(changes.size, "size", pointJson(2.0 * box.half_size));
    ask(changes.yaw, "yaw_deg", box.yaw * 180.0 / std::numbers::pi);
}

std::optional<std::string> seenText(const Plan& plan, const Region& region) {
    for (const RegionCoverage& one : plan.must_see) {
        if (one.name != region.name) continue;
        return fmt::format("{:.1f} % of the visible surface seen", 100.0 * one.rate());
    }
    return std::nullopt;
}

}  // namespace dollytrack::ui
