#include "app/editor/editor.h"

#include "engine/geometry/ray_caster.h"
#include "planning/free_space/free_space.h"
#include "render/draw/storey_cutaway.h"
#include "ui/theme.h"
#include "ui/widgets/cut_text.h"
#include "ui/widgets/item_map.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace dollytrack::editor {

using ui::Selection;

namespace {

constexpr const char* kPickList = "under the cursor";
constexpr const char* kSelectionMenu = "menu of the selection";
constexpr float kSamePlace_px = 4.0F;

/// The commands in the menu of the selection, in groups; it shows those that can run.
constexpr std::array<std::array<const char*, 6>, 4> kMenuGroups = {
    {{"view.frame_selected", "view.local", "view.hide", "view.show_all", "view.clip_box",
      "view.frame_all"},
     {"edit.exclude", "edit.include", "edit.split", "edit.add_key", "edit.remove_key",
      "edit.pin_point"},
     {"edit.move", "edit.rotate", "edit.clear_move", "edit.clear_turn"},
     {"timeline.look_through_key", "edit.replace_camera_key", "edit.camera_key", "edit.delete"}}};

/// What a picked element of a layer selects; kind None for elements that cannot be selected.
Selection selectionOf(const ui::PickedElement& element, int candidate_search) {
    const int index = element.tag.index;
    switch (element.tag.kind) {
        case ui::Picked::ObservationPoint:
            return Selection::ofItem(Selection::Kind::ObservationPoint, index);
        case ui::Picked::PositionPoint:
            return Selection::ofItem(Selection::Kind::PositionPoint, index);
        case ui::Picked::Edge:
            return Selection::ofItem(Selection::Kind::Edge, index);
        case ui::Picked::RefusedEdge:
            return Selection::ofItem(Selection::Kind::RefusedEdge, index);
        case ui::Picked::Frame:
            return Selection::ofItem(Selection::Kind::Frame, index);
        case ui::Picked::Candidate:
            return Selection::ofCandidate(candidate_search, index);
        case ui::Picked::CameraKey:
            return Selection::ofItem(Selection::Kind::CameraKey, index);
        case ui::Picked::Sample:
        case ui::Picked::Nothing:
            break;
    }
    return {};
}

/// Ids of the objects along a ray, the nearest first, without those that the view does not show.
std::vector<int> objectsAlong(const RayCaster& rays, const Scene& scene, const render::View& view,
                              const render::ViewRay& ray) {
    constexpr int kMostSurfaces = 64;
    constexpr double kBeyond_m = 1e-3;
    const Eigen::Vector3d way = ray.direction.normalized();
    std::vector<int> ids;
    double from = view.near_m;
    for (int i = 0; i < kMostSurfaces; ++i) {
        const RayHit hit =
            rays.cast(ray.origin, way, std::numeric_limits<double>::infinity(), from);
        if (hit.object_id == 0) break;
        from = hit.distance + kBeyond_m;
        const bool shown =
            !render::isCutAway(view, scene, hit.object_id, ray.origin + hit.distance * way);
        if (shown && std::ranges::count(ids, hit.object_id) == 0) ids.push_back(hit.object_id);
    }
    return ids;
}

/// "sofa" or "sofa and 2 more".
std::string namesOf(const Scene& scene, const std::vector<int>& objects) {
    if (objects.empty()) return "no object";
    const std::string& first = scene.object(objects.front()).name;
    return objects.size() == 1 ? first : fmt::format("{} and {} more", first, objects.size() - 1);
}

}  // namespace

Editor::PickedPixel Editor::pick(const Eigen::Vector2d& pixel) const {
    const ui::ViewImage& image = drawing_.view();
    const std::optional<Eigen::Vector3d> surface = ui::surfaceAt(image, pixel);
    PickedPixel picked;
    if (surface) picked.depth_m = image.view.pose.toCamera(*surface).z();
    picked.elements = layers_.layers().pick(image.view, pixel, picked.depth_m, overlayScale());
    return picked;
}

/// What a click can select at a pixel, in the order in which repeated clicks do: visible elements
/// of layers, the object, elements that the pointer just misses, what lies behind.
std::vector<Selection> Editor::underCursor(const Eigen::Vector2d& pixel) {
    const ui::ViewImage& image = drawing_.view();
    const PlanOutcome& shown = workspace_.shown();
    const PickedPixel picked = pick(pixel);
    std::vector<Selection> on;
    std::vector<Selection> beside;
    std::vector<Selection> hidden;
    bool has_frame = false;  // of the many frames along a path, the closest is enough
    for (const ui::PickedElement& element : picked.elements) {
        const Selection selection = selectionOf(element, layers_.candidateSearch());
        const bool frame = selection.kind == Selection::Kind::Frame;
        if (selection.kind == Selection::Kind::None || (frame && has_frame)) continue;
        has_frame = has_frame || frame;
        (!element.visible ? hidden : element.on ? on : beside).push_back(selection);
    }
    std::vector<Selection> found;
    const auto add = [&found](const std::vector<Selection>& more) {
        found.insert(found.end(), more.begin(), more.end());
    };
    // Layers of another plan have other indices.
    const bool current = layers_.layers().plan == shown.plan;
    if (current) add(on);
    if (layer_settings_.free_space && !selected_.inLocalView() && shown.free_space) {
        const auto voxel =
            ui::voxelAt(*shown.free_space, image.view, pixel, cellOptions(layer_settings_));
        const double voxel_depth = voxel ? image.view.pose.toCamera(voxel->center).z() : 0.0;
        if (voxel && (picked.depth_m == 0.0 || voxel_depth < picked.depth_m + 0.1)) {
            Selection selection;
            selection.kind = Selection::Kind::Voxel;
            selection.place = voxel->center;
            found.push_back(selection);
        }
    }
    const int object = ui::objectAt(image, pixel);
    // A point in front of a wall or a floor may be missed by a few pixels.
    const bool building = object == 0 || shown.scene->object(object).structure;
    if (current && building) add(beside);
    if (object != 0) found.push_back(Selection::ofObject(object));
    if (current && !building) add(beside);
    if (current) add(hidden);
    if (shown.rays) {
        const render::ViewRay ray = image.view.rayThrough(pixel.x(), pixel.y());
        for (const int id : objectsAlong(*shown.rays, *shown.scene, image.view, ray)) {
            if (id != object) found.push_back(Selection::ofObject(id));
        }
    }
    return found;
}

void Editor::clickAt(const Eigen::Vector2d& pixel, bool add, bool list) {
    const ui::ViewImage& image = drawing_.view();
    // Ignores images and layers of a previous project.
    if (!workspace_.shown().hasObjectsOf(image.geometry)) return;
    if (add) return selectObject(ui::objectAt(image, pixel), true);
    // The second press of a double click shows what the first has selected.
    if (ImGui::GetIO().MouseClickedLastCount[ImGuiMouseButton_Left] == 2) return;
    const std::vector<Selection> found = underCursor(pixel);
    if (list) {
        pick_list_ = {found, workspace_.shown().scene, workspace_.shown().plan};
        if (!found.empty()) ImGui::OpenPopup(kPickList);
        return;
    }
    const bool again = last_click_ && last_click_->view == image.view.pose &&
                       (last_click_->pixel - pixel).norm() <= ui::scaled(kSamePlace_px);
    last_click_ = {pixel, image.view.pose};
    if (found.empty()) return select({});
    const auto now = std::ranges::find(found, selected_.now());
    const bool next = again && now != found.end() && now + 1 != found.end();
    select(next ? *(now + 1) : found.front());
}

void Editor::drawPickList() {
    if (!ImGui::BeginPopup(kPickList)) {
        pick_list_ = {};
        return;
    }
    const PlanOutcome& shown = workspace_.shown();
    // Ids and indices of another plan mean something else.
    if (pick_list_.scene != shown.scene || pick_list_.plan != shown.plan) {
        ImGui::CloseCurrentPopup();
        pick_list_ = {};
    }
    for (std::size_t i = 0; i < pick_list_.found.size(); ++i) {
        const Selection& one = pick_list_.found[i];
        const std::string text = fmt::format("{}##{}", nameOf(one), i);
        if (ImGui::Selectable(text.c_str(), one == selected_.now())) select(Selection(one));
        ui::nameItem("pick." + std::to_string(i));
    }
    ImGui::EndPopup();
}

void Editor::openSelectionMenu(const Selection& selection) {
    const std::vector<int>& objects = selected_.objects();
    const bool part = selection.kind == Selection::Kind::Object &&
                      std::ranges::count(objects, selection.objects.front()) > 0;
    if (!part) select(Selection(selection));
    opens_selection_menu_ = true;
}

void Editor::drawSelectionMenu() {
    if (std::exchange(opens_selection_menu_, false)) ImGui::OpenPopup(kSelectionMenu);
    if (!ImGui::BeginPopup(kSelectionMenu)) return;
    if (!workspace_.shown().scene) {
        ImGui::CloseCurrentPopup();
        ImGui::EndPopup();
        return;
    }
    const std::vector<int>& objects = selected_.objects();
    const std::string name =
        objects.empty() ? nameOf(selected_.now()) : namesOf(*workspace_.shown().scene, objects);
    if (!name.empty()) ImGui::TextDisabled("%s", ui::cutToWidth(name, ui::scaled(280)).c_str());
    bool any = !name.empty();
    for (const auto& group : kMenuGroups) {
        bool begun = false;
        for (const char* id : group) {
            const ui::Command* command = id == nullptr ? nullptr : commands_.find(id);
            if (command == nullptr || !command->canRun()) continue;
            if (any && !begun) ImGui::Separator();
            begun = any = true;
            commands_.drawMenuItem(id);
        }
    }
    ImGui::EndPopup();
}

std::string Editor::nameOf(const Selection& selection) const {
    const Scene& scene = *workspace_.shown().scene;
    const auto objectsOf = [&](int observation_point) {
        return namesOf(scene, plan()->observation_points[observation_point].objects);
    };
    switch (selection.kind) {
        case Selection::Kind::Object:
            return scene.object(selection.objects.front()).name;
        case Selection::Kind::ObservationPoint:
            return "Observation point of " + objectsOf(selection.index);
        case Selection::Kind::PositionPoint: {
            const PositionPoint& point = plan()->position_points[selection.index];
            return "Position point for " + objectsOf(point.observation_point);
        }
        case Selection::Kind::Edge:
            return fmt::format("Edge {} of the roadmap", selection.index);
        case Selection::Kind::RefusedEdge:
            return fmt::format("Refused edge {} of the roadmap", selection.index);
        case Selection::Kind::Frame:
            return fmt::format("Frame {}", selection.index);
        case Selection::Kind::Candidate:
            return "Candidate for " + objectsOf(selection.search);
        case Selection::Kind::Voxel:
            return "Cell of the free-space map";
        case Selection::Kind::CameraKey:
            return fmt::format("Key {} of the camera path", selection.index + 1);
        case Selection::Kind::None:
        case Selection::Kind::Objects:
        case Selection::Kind::NoGoBox:
        case Selection::Kind::Region:
            break;  // a click does not find these
    }
    return {};
}

void Editor::selectInBox(const Eigen::AlignedBox2d& pixels, bool add, bool remove) {
    const ui::ViewImage& image = drawing_.view();
    const PlanOutcome& shown = workspace_.shown();
    if (!shown.hasObjectsOf(image.geometry)) return;
    std::vector<int> ids = ui::objectsIn(image, pixels);
    if (remove) return select(selected_.withoutObjects(ids));
    const auto building = [&](int id) { return shown.scene->object(id).structure; };
    if (!std::ranges::all_of(ids, building)) std::erase_if(ids, building);
    select(selected_.withObjects(ids, add));
}

void Editor::selectAll() {
    const std::vector<bool> hidden = viewportView(panels_.viewport.camera).hidden;
    std::vector<int> ids;
    for (const Object& object : workspace_.shown().scene->objects) {
        const std::size_t id = object.id;
        if (!object.structure && !(id < hidden.size() && hidden[id])) ids.push_back(object.id);
    }
    select(selected_.withObjects(ids, false));
}

}  // namespace dollytrack::editor
