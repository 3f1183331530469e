#include "ui/panels/edits/edit_parts.h"

#include "engine/document/apply_scene_edits.h"
#include "ui/theme.h"
#include "ui/widgets/fields/drag_fields.h"
#include "ui/widgets/fields/text_field.h"
#include "ui/widgets/form.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <numbers>

namespace dollytrack::ui {
namespace {

using nlohmann::json;

std::vector<int> idsOf(const Scene& scene, const std::vector<ObjectRef>& objects) {
    std::vector<int> ids;
    for (const ObjectRef& object : objects) ids.push_back(findObject(scene, object));
    std::ranges::sort(ids);
    return ids;
}

/// Requests an operation; the steps of one drag are merged into one undo step by `key`.
void request(EditRequest& edit, const FieldEdit& field, const std::string& key, json operation) {
    if (field.changed) {
        edit.operation = std::move(operation);
        edit.merge_key = key;
    }
    edit.ends_merge = edit.ends_merge || field.finished;
}

}  // namespace

json pointJson(const Eigen::Vector3d& point) {
    return {point.x(), point.y(), point.z()};
}

json turnJson(const Eigen::Quaterniond& rotation) {
    return {rotation.x(), rotation.y(), rotation.z(), rotation.w()};
}

nlohmann::json addNoGoOperation(const OrientedBox& box) {
    constexpr double kThinnest_m = 0.05;
    const Eigen::Vector3d size = (2.0 * box.half_size).cwiseMax(kThinnest_m);
    return {{"op", "add_no_go"},
            {"center", pointJson(box.center)},
            {"size", pointJson(size)},
            {"yaw_deg", box.yaw * 180.0 / std::numbers::pi}};
}

std::string objectName(const Scene& scene, int id) {
    if (id < 1 || id > static_cast<int>(scene.objects.size())) return {};
    const std::string& name = scene.object(id).name;
    return name.empty() ? fmt::format("object {}", id) : name;
}

std::string objectNames(const Scene& scene, const std::vector<int>& ids) {
    if (ids.empty()) return {};
    if (ids.size() == 1) return objectName(scene, ids[0]);
    if (ids.size() == 2) return objectName(scene, ids[0]) + " and " + objectName(scene, ids[1]);
    return fmt::format("{} and {} more", objectName(scene, ids[0]), ids.size() - 1);
}

std::string verdictText(Verdict verdict, const std::string& occluder) {
    switch (verdict) {
        case Verdict::Legal:
            return "legal";
        case Verdict::InObstacle:
            return occluder.empty() ? "in an obstacle" : "touching " + occluder;
        case Verdict::OutsideRoom:
            return "outside the room";
        case Verdict::OccludedBy:
            return occluder.empty() ? "hidden" : "hidden by " + occluder;
        case Verdict::TooClose:
            return "too close";
        case Verdict::Cropped:
            return "cut off by the image's edge";
        case Verdict::TooSmall:
            return "too small in the image";
        case Verdict::NoGo:
            return "in a no-go box";
        case Verdict::HeightBand:
            return "outside the height band";
        case Verdict::PitchBand:
            return "outside the pitch band";
        case Verdict::InGap:
            return "in a gap between surfaces";
        case Verdict::Unscanned:
            return "mostly unscanned in the image";
    }
    return {};
}

std::string sizeText(const Eigen::Vector3d& size) {
    return fmt::format("{:.2f} \u00d7 {:.2f} \u00d7 {:.2f} m", size.x(), size.y(), size.z());
}

std::string placeText(const Eigen::Vector3d& place) {
    return fmt::format("{:.2f}, {:.2f}, {:.2f}", place.x(), place.y(), place.z());
}

std::optional<Selection> objectLinks(const Scene& scene, const std::vector<int>& ids,
                                     const std::string& name, std::size_t most) {
    std::optional<Selection> clicked;
    const std::size_t shown = std::min(ids.size(), most);
    for (std::size_t i = 0; i < shown; ++i) {
        const std::string text = objectName(scene, ids[i]);
        if (i > 0) flowTo(text.c_str());
        if (link(text, name + "." + std::to_string(ids[i]))) clicked = Selection::ofObject(ids[i]);
    }
    if (shown < ids.size()) {
        const std::string rest = fmt::format("and {} more", ids.size() - shown);
        flowTo(rest.c_str());
        ImGui::TextColored(palette().text_dim, "%s", rest.c_str());
    }
    return clicked;
}

void noGoRows(const NoGoBox& box, const std::string& name, EditRequest& edit) {
    formLabel("Name");
    std::string called = box.name;
    // Only a completely typed name becomes an undo step.
    const bool entered = textField(called, name + ".name");
    if (entered && !called.empty() && called != box.name) {
        edit.operation = {{"op", "rename_no_go"}, {"name", box.name}, {"to", called}};
    }
    OrientedBox draft = box.box;
    const BoxEdit changes = boxRows(draft, name);
    const json move = {{"op", "move_no_go"}, {"name", box.name}};
    const auto with = [&](const char* field, json value) {
        json operation = move;
        operation[field] = std::move(value);
        return operation;
    };
    const std::string key = "no_go." + box.name;
    request(edit, changes.center, key + ".center", with("center", pointJson(draft.center)));
    request(edit, changes.size, key + ".size", with("size", pointJson(2.0 * draft.half_size)));
    request(edit, changes.yaw, key + ".yaw", with("yaw_deg", draft.yaw * 180.0 / std::numbers::pi));
}

const ObjectChange* findChange(const Edits& edits, const Scene& scene, int id) {
    for (const ObjectChange& change : edits.scene.changes) {
        if (findObject(scene, change.object) == id) return &change;
    }
    return nullptr;
}

const PinnedPoint* findPin(const Edits& edits, const Scene& scene, std::vector<int> ids) {
    std::ranges::sort(ids);
    for (const PinnedPoint& point : edits.plan.pinned) {
        if (!point.objects.empty() && idsOf(scene, point.objects) == ids) return &point;
    }
    return nullptr;
}

bool isRemoved(const Edits& edits, const Scene& scene, std::vector<int> ids) {
    std::ranges::sort(ids);
    return std::ranges::any_of(edits.plan.removed, [&](const RemovedPoint& removed) {
        return idsOf(scene, removed.objects) == ids;
    });
}

}  // namespace dollytrack::ui
