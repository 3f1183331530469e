#include "app/editor/editor.h"

#include "planning/free_space/free_space.h"
#include "render/look_inside.h"
#include "ui/panels/edit_parts.h"
#include "ui/panels/layers_panel.h"
#include "ui/theme.h"
#include "ui/widgets/legend_view.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

namespace dollytrack::editor {

using ui::Selection;

render::View Editor::viewportView() const {
    const PlanOutcome& shown = workspace_.shown();
    render::View view;
    if (through_camera_ && frame_ < frameCount()) {
        CameraParams camera = shown.params.camera;
        camera.width_px = pane_.width;
        camera.height_px = pane_.height;
        view.intrinsics = makeIntrinsics(camera);
        view.pose = plan()->trajectory.frames[static_cast<std::size_t>(frame_)].pose;
        view.near_m = camera.near_m;
    } else {
        view = viewport_.camera.view(pane_.width, pane_.height);
    }
    view.hidden = hidden_;
    const bool dark = settings_.theme == ui::ThemeKind::Dark;
    view.backdrop =
        dark ? Eigen::Vector3f(0.125F, 0.137F, 0.153F) : Eigen::Vector3f(0.90F, 0.905F, 0.91F);
    if (through_camera_ || !layer_settings_.ceiling_cut) return view;

    const Eigen::AlignedBox3d building =
        render::buildingOf(*shown.scene, shown.plan ? std::span(shown.plan->rooms)
                                                    : std::span<const Eigen::AlignedBox3d>());
    if (building.isEmpty() || building.contains(viewport_.camera.pose().position)) return view;
    const std::vector<bool> covers = render::hidesRooms(*shown.scene);
    for (std::size_t i = 0; i < std::min(covers.size(), view.hidden.size()); ++i) {
        if (covers[i]) view.hidden[i] = true;
    }
    const Eigen::Vector3d way = viewport_.camera.towardsViewer();
    if (way.z() < -0.1) return view;
    // From straight above every wall stays; the lower one looks, the steeper the cut.
    const Eigen::Vector3d level(way.x(), way.y(), 0.0);
    view.structure_cut = render::cutTowards(building, building.min().z(),
                                            level * std::min(1.0, 1.6 * (1.0 - way.z()) + 0.2));
    return view;
}

void Editor::requestLayers() {
    const PlanOutcome& shown = workspace_.shown();
    if (!shown.scene) return;
    LayersRequest request;
    request.scene = shown.scene;
    request.plan = shown.plan;
    request.free_space = shown.free_space;
    request.camera = shown.params.camera;
    request.settings = layer_settings_;
    request.cone_half_angle_deg = shown.params.viewpoints.cone_half_angle_deg;
    request.stepping = stepping_;
    request.selection = selection_;
    request.no_go = workspace_.state().edits.plan.no_go;
    request.step = step_;
    request.frame = through_camera_ ? -1 : frame_;
    layers_.request(request);
}

void Editor::requestPicture() {
    if (!workspace_.shown().scene || !scene_sent_ || pane_.width < 16) return;
    if (!std::exchange(scene_framed_, true)) {
        viewport_.camera.frame(workspace_.shown().scene->room_bounds,
                               static_cast<double>(pane_.width) / pane_.height);
        viewport_.camera.distance *= 0.78;
    }
    ui::ViewRequest request;
    request.view = viewportView();
    request.pixel_scale = window_.contentScale() * settings_.zoom;
    for (const auto& layer : layers_.layers().layers) {
        request.layers.push_back({std::shared_ptr<const render::Overlay>(layer, &layer->overlay)});
    }
    drawing_.requestView(std::move(request));
}

std::optional<Pose> Editor::previewPose() const {
    if (plan() == nullptr) return std::nullopt;
    if (gizmo_pose_) return gizmo_pose_;
    const auto index = static_cast<std::size_t>(std::max(selection_.index, 0));
    if (preview_.shows_selection && selection_.kind == Selection::Kind::PositionPoint &&
        index < plan()->position_points.size()) {
        return plan()->position_points[index].pose;
    }
    if (frame_ >= frameCount()) return std::nullopt;
    return plan()->trajectory.frames[static_cast<std::size_t>(frame_)].pose;
}

void Editor::requestPreview() {
    const std::optional<Pose> pose = previewPose();
    if (!pose || !scene_sent_ || !preview_.open) return;
    const CameraParams& camera = workspace_.shown().params.camera;
    render::View view;
    view.intrinsics = makeIntrinsics(camera);
    view.pose = *pose;
    view.near_m = camera.near_m;
    const double time_s = frame_ < frameCount()
                              ? plan()->trajectory.frames[static_cast<std::size_t>(frame_)].time_s
                              : 0.0;
    drawing_.requestPreview(view, frame_, time_s, preview_.modality);
}

void Editor::clickAt(const Eigen::Vector2d& pixel, bool add) {
    const ui::ViewImage& image = drawing_.view();
    // A picture or layers of what was open before say nothing of what is.
    if (image.geometry != workspace_.shown().geometry) return;
    const std::optional<Eigen::Vector3d> surface = ui::surfaceAt(image, pixel);
    const double depth = surface ? image.view.pose.toCamera(*surface).z() : 0.0;
    const double scale = window_.contentScale() * settings_.zoom;
    const auto picked = layers_.layers().pick(image.view, pixel, depth, scale);
    if (picked && !add && layers_.layers().plan == workspace_.shown().plan) {
        const int index = picked->tag.index;
        switch (picked->tag.kind) {
            case ui::Picked::ObservationPoint:
                return select(Selection::ofItem(Selection::Kind::ObservationPoint, index));
            case ui::Picked::PositionPoint:
                return select(Selection::ofItem(Selection::Kind::PositionPoint, index));
            case ui::Picked::Edge:
                return select(Selection::ofItem(Selection::Kind::Edge, index));
            case ui::Picked::RefusedEdge:
                return select(Selection::ofItem(Selection::Kind::RefusedEdge, index));
            case ui::Picked::Frame:
                return select(Selection::ofItem(Selection::Kind::Frame, index));
            case ui::Picked::Candidate:
                return select(Selection::ofCandidate(layers_.candidateSearch(), index));
            case ui::Picked::Sample:
            case ui::Picked::Nothing:
                break;
        }
    }
    if (layer_settings_.free_space && workspace_.shown().free_space && !add) {
        const auto voxel = ui::voxelAt(*workspace_.shown().free_space, image.view, pixel,
                                       cellOptions(layer_settings_));
        const double voxel_depth = voxel ? image.view.pose.toCamera(voxel->center).z() : 0.0;
        if (voxel && (!surface || voxel_depth < depth + 0.1)) {
            Selection selection;
            selection.kind = Selection::Kind::Voxel;
            selection.place = voxel->center;
            return select(selection);
        }
    }
    selectObject(ui::objectAt(image, pixel), add);
}

void Editor::editWithGizmo() {
    const auto index = static_cast<std::size_t>(std::max(selection_.index, 0));
    const bool point = selection_.kind == Selection::Kind::PositionPoint && plan() != nullptr &&
                       index < plan()->position_points.size();
    const std::vector<NoGoBox>& boxes = workspace_.state().edits.plan.no_go;
    const bool box = selection_.kind == Selection::Kind::NoGoBox && index < boxes.size();
    gizmo_has_mouse_ = false;
    if ((!point && !box) || through_camera_) {
        if (gizmo_.dragged != ui::GizmoPart::None) dropGizmo();
        return;
    }
    ui::GizmoView view;
    view.view = drawing_.view().view;
    view.origin = pane_.origin;
    view.hovered = pane_.hovered && !preview_hovered_;
    view.turns = point;
    if (point) view.pose = gizmo_pose_.value_or(plan()->position_points[index].pose);
    if (box) view.pose.position = boxes[index].box.center;
    const ui::GizmoActions actions = ui::drawGizmo(view, gizmo_);
    gizmo_has_mouse_ = actions.has_mouse;
    if (box) {
        if (actions.changed) {
            apply({{"op", "move_no_go"},
                   {"name", boxes[index].name},
                   {"center", ui::pointJson(actions.pose.position)}},
                  "gizmo " + boxes[index].name);
        }
        if (actions.finished) workspace_.endMerge();
        return;
    }
    if (actions.changed) {
        gizmo_pose_ = actions.pose;
        window_.animate();
    }
    if (!actions.finished) return;
    const std::optional<Pose> moved = std::exchange(gizmo_pose_, std::nullopt);
    if (!moved) return;
    // The drag is one step: planning follows when it ends, the preview while it lasts.
    const PositionPoint& here = plan()->position_points[index];
    const nlohmann::json position = ui::pointJson(moved->position);
    const nlohmann::json turn = ui::turnJson(moved->rotation);
    const auto& pinned = workspace_.shown().state->edits.plan.pinned;
    if (here.pin >= 0 && static_cast<std::size_t>(here.pin) < pinned.size()) {
        apply({{"op", "move_point"},
               {"point", pinned[static_cast<std::size_t>(here.pin)].name},
               {"position", position},
               {"quaternion_xyzw", turn}});
    } else {
        const auto& objects =
            plan()->observation_points[static_cast<std::size_t>(here.observation_point)].objects;
        apply({{"op", "pin"},
               {"objects", ui::objectKeys(*workspace_.shown().scene, objects)},
               {"position", position},
               {"quaternion_xyzw", turn}});
    }
}

void Editor::drawPreview() {
    const bool has = plan() != nullptr && frameCount() > 0;
    ui::PreviewView view;
    view.image = &drawing_.preview();
    view.scene = workspace_.shown().scene.get();
    const ImVec2 low = ImGui::GetWindowPos();
    const ImVec2 size = ImGui::GetWindowSize();
    view.low = {low.x + ui::scaled(8), low.y + ui::scaled(8)};
    view.high = {low.x + size.x - ui::scaled(8), low.y + size.y - ui::scaled(8)};
    view.busy = drawing_.busy();
    view.point_selected = selection_.kind == Selection::Kind::PositionPoint;
    view.what = preview_.shows_selection && view.point_selected
                    ? fmt::format("position point {}", selection_.index)
                    : fmt::format("frame {}", frame_);
    if (!has) view.why_not = "There is no trajectory.";
    const ui::PreviewActions actions = ui::drawPreviewPanel(view, preview_);
    preview_hovered_ = actions.hovered;
    if (actions.save_png) {
        picture_to_save_ = drawing_.preview();
        askForFile("preview.png");
    }
}

void Editor::drawLegend() {
    std::vector<ui::Legend> legends;
    for (const auto& layer : layers_.layers().layers) {
        if (!layer->legend.entries.empty() || layer->legend.scale) legends.push_back(layer->legend);
    }
    if (legends.empty() || through_camera_) return;
    ImGui::SetNextWindowPos({pane_.origin.x() + ui::scaled(10), pane_.origin.y() + ui::scaled(10)});
    ImGui::SetNextWindowBgAlpha(0.82F);
    constexpr ImGuiWindowFlags kOverlay =
        ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize |
        ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav |
        ImGuiWindowFlags_NoFocusOnAppearing;
    ImGui::SetNextWindowSizeConstraints({0, 0}, {ui::scaled(230), 10000});
    ImGui::Begin("legend", nullptr, kOverlay);
    ui::drawLegends(legends);
    ImGui::End();
}

void Editor::drawCentre() {
    ui::ViewportView view;
    view.image = scene_sent_ && drawing_.ready() ? &drawing_.view() : nullptr;
    const BackgroundWorker::State loading = workspace_.loading();
    if (loading.busy) {
        view.message = fmt::format("Opening … {:.0f} %  {}   (Esc stops)", 100.0 * loading.fraction,
                                   loading.stage);
    } else if (!workspace_.isOpen()) {
        view.message = "Drop a scene or a project here, or press Ctrl+O to open one.";
    } else if (view.image == nullptr || view.image->serial == 0 ||
               view.image->geometry != workspace_.shown().geometry) {
        view.image = nullptr;
        const bool failed = !workspace_.shown().scene && !workspace_.planError().empty();
        view.message = failed ? "The scene cannot be shown: " + workspace_.planError()
                              : "Preparing the scene …";
    }
    view.locked = through_camera_;
    if (through_camera_) {
        const CameraParams& camera = workspace_.shown().params.camera;
        view.aspect = static_cast<double>(camera.width_px) / camera.height_px;
    }
    view.blocked = gizmo_has_mouse_ || preview_hovered_ || preview_.full;
    pane_ = ui::drawViewport(view, viewport_);
    if (pane_.camera_moved) window_.animate();
    if (pane_.unlock) lookThroughFrame(false);
    if (!workspace_.isOpen()) return;
    if (pane_.clicked) clickAt(*pane_.clicked, pane_.add_to_selection);
    if (pane_.double_clicked && !selectedBox().isEmpty()) {
        bringIntoView(selectedBox());
    }
    editWithGizmo();
    if (!preview_.full) drawLegend();
    drawPreview();
}

}  // namespace dollytrack::editor
