#include "app/editor/editor.h"

#include "engine/core/log.h"
#include "engine/document/operation.h"
#include "render/look_inside.h"
#include "ui/panels/metrics_panel.h"
#include "ui/panels/parameters_panel.h"
#include "ui/theme.h"
#include "ui/widgets/item_map.h"
#include "ui/widgets/splitter.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

namespace dollytrack::editor {
namespace {

constexpr ImGuiWindowFlags kPart = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                   ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse |
                                   ImGuiWindowFlags_NoSavedSettings |
                                   ImGuiWindowFlags_NoBringToFrontOnFocus;

bool beginPart(const char* name, ImVec2 at, ImVec2 size, ImGuiWindowFlags more = 0) {
    ImGui::SetNextWindowPos(at);
    ImGui::SetNextWindowSize(size);
    return ImGui::Begin(name, nullptr, kPart | more);
}

}  // namespace

Editor::Editor(Window& window, std::unique_ptr<gl::Context> drawing, ui::LogBook& log,
               EditorSettings settings)
    : window_(window),
      log_(log),
      settings_(std::move(settings)),
      workspace_(&Window::wake),
      drawing_(std::move(drawing), &Window::wake),
      draft_fields_(planning::listFields(draft_)),
      standard_fields_(planning::listFields(standard_)) {
    ui::loadFonts(window_.contentScale() * settings_.zoom);
    setTheme();
    addCommands();
}

Editor::~Editor() {
    settings_.window = window_.settings();
    if (const Status saved = saveSettings(settings_); !saved) {
        log::warn("editor", describe(saved.error()));
    }
}

void Editor::setTheme() {
    ui::applyTheme(settings_.theme, window_.contentScale() * settings_.zoom);
}

void Editor::refreshScene() {
    if (workspace_.takeOpened()) {
        selected_.clear();
        hidden_.clear();
        scene_sent_ = false;
        drawn_geometry_ = 0;
        if (!workspace_.isOpen()) drawing_.setScene(nullptr, nullptr, 0);
        if (workspace_.isOpen()) {
            settings_.addRecent(workspace_.path().empty() ? workspace_.sceneFile()
                                                          : workspace_.path());
        }
        window_.setTitle(workspace_.title());
    }
    const PlanOutcome& shown = workspace_.shown();
    if (!shown.scene) return;
    const auto light = workspace_.light();
    if (scene_sent_ && drawn_geometry_ == shown.geometry && drawn_light_ == light.get()) return;
    if (drawn_geometry_ != shown.geometry) {
        if (!scene_sent_) {
            viewport_.camera = {};
            viewport_.camera.frame(shown.scene->room_bounds, 1.5);
            viewport_.camera.distance *= 0.8;
        }
        hidden_.assign(shown.scene->objects.size() + 1, false);
    }
    drawing_.setScene(shown.scene, light, shown.geometry);
    drawn_geometry_ = shown.geometry;
    drawn_light_ = light.get();
    scene_sent_ = true;
}

void Editor::refreshPicture(const ui::ViewportActions& pane) {
    const PlanOutcome& shown = workspace_.shown();
    if (!shown.scene || !scene_sent_) return;
    ui::ViewRequest request;
    request.view = viewport_.camera.view(pane.width, pane.height);
    request.pixel_scale = window_.contentScale() * settings_.zoom;
    request.view.hidden = hidden_;
    const Eigen::AlignedBox3d building =
        render::buildingOf(*shown.scene, shown.plan ? std::span(shown.plan->rooms)
                                                    : std::span<const Eigen::AlignedBox3d>());
    const Eigen::Vector3d eye = viewport_.camera.pose().position;
    const bool outside = !building.isEmpty() && !building.contains(eye);
    if (cut_open_ && outside) {
        const std::vector<bool> covers = render::hidesRooms(*shown.scene);
        for (std::size_t i = 0; i < covers.size() && i < request.view.hidden.size(); ++i) {
            if (covers[i]) request.view.hidden[i] = true;
        }
        const Eigen::Vector3d way = viewport_.camera.towardsViewer();
        if (way.z() > -0.1) {
            Eigen::Vector3d aside(way.x(), way.y(), 0.0);
            // From straight above every wall stays; the lower one looks, the steeper the cut.
            aside *= std::min(1.0, 1.6 * (1.0 - way.z()) + 0.2);
            request.view.structure_cut = render::cutTowards(building, building.min().z(), aside);
        }
    }
    const bool dark = settings_.theme == ui::ThemeKind::Dark;
    request.view.backdrop =
        dark ? Eigen::Vector3f(0.125F, 0.137F, 0.153F) : Eigen::Vector3f(0.955F, 0.955F, 0.95F);
    drawing_.requestView(std::move(request));
}

bool Editor::frame() {
    for (const std::string& path : window_.takeDroppedPaths()) workspace_.open(path);
    if (window_.takeCloseRequest()) quitting_ = true;
    if (window_.takeScaleChange()) setTheme();
    workspace_.poll();
    refreshScene();
    commands_.runShortcuts();
    drawMenus();

    const ImGuiViewport* screen = ImGui::GetMainViewport();
    const ImVec2 low = screen->WorkPos;
    const ImVec2 size = screen->WorkSize;
    Layout& layout = settings_.layout;
    const float status = ImGui::GetFrameHeight() + ui::scaled(4);
    const float left = layout.show_left ? ui::scaled(layout.left) : 0.0F;
    const float right = layout.show_right ? ui::scaled(layout.right) : 0.0F;
    const float bottom = layout.show_bottom ? ui::scaled(layout.bottom) : 0.0F;
    const float middle_height = size.y - status - bottom;
    if (layout.show_left) {
        beginPart("left", low, {left, middle_height});
        drawLeft();
        ImGui::End();
    }
    if (layout.show_right) {
        beginPart("right", {low.x + size.x - right, low.y}, {right, middle_height});
        drawRight();
        ImGui::End();
    }
    if (layout.show_bottom) {
        beginPart("bottom", {low.x, low.y + middle_height}, {size.x, bottom});
        drawBottom();
        ImGui::End();
    }
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
    beginPart("centre", {low.x + left, low.y}, {size.x - left - right, middle_height},
              ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
    ImGui::PopStyleVar();
    drawCentre();
    ImGui::End();
    beginPart("status", {low.x, low.y + size.y - status}, {size.x, status},
              ImGuiWindowFlags_NoScrollbar);
    drawStatus();
    ImGui::End();
    drawDialogs();
    refreshPicture(pane_);
    autosave();
    window_.setTitle(workspace_.title());
    return !quitting_;
}

void Editor::autosave() {
    if (!workspace_.isOpen()) return;
    const CommandStack::State& state = workspace_.history().state();
    if (!workspace_.unsaved()) {
        if (autosaved_) autosave_.discard();
        autosaved_.reset();
    } else if (autosaved_ != state && autosave_.isDue()) {
        autosave_.store(workspace_.snapshot(), workspace_.path());
        autosaved_ = state;
    }
}

void Editor::drawMenus() {
    if (!ImGui::BeginMainMenuBar()) return;
    if (ImGui::BeginMenu("File")) {
        commands_.drawMenuItem("file.save");
        commands_.drawMenuItem("file.quit");
        ImGui::EndMenu();
    }
    if (ImGui::BeginMenu("Edit")) {
        commands_.drawMenuItem("edit.undo");
        commands_.drawMenuItem("edit.redo");
        ImGui::EndMenu();
    }
    ImGui::EndMainMenuBar();
}

void Editor::drawLeft() {
    const PlanOutcome& shown = workspace_.shown();
    ui::ObjectsView view;
    view.scene = shown.scene.get();
    if (shown.plan && shown.measured) view.captures = &shown.plan->captures;
    view.selected = &selected_;
    view.hidden = &hidden_;
    const ui::ObjectsActions actions = ui::drawObjectsPanel(view, objects_);
    if (actions.clicked != 0) select(actions.clicked, actions.add_to_selection);
    if (actions.toggle_hidden != 0) {
        const auto at = static_cast<std::size_t>(actions.toggle_hidden);
        hidden_[at] = !hidden_[at];
    }
    if (actions.toggle_target != 0) {
        const bool target = shown.scene->object(actions.toggle_target).role == Role::Target;
        const Status done = workspace_.apply(
            {{"op", target ? "exclude" : "include"}, {"object", actions.toggle_target}});
        if (!done) log::warn("edits", describe(done.error()));
    }
}

void Editor::select(int object, bool add) {
    if (!add) selected_.clear();
    const auto at = std::ranges::find(selected_, object);
    if (at != selected_.end()) {
        selected_.erase(at);
    } else if (object != 0) {
        selected_.push_back(object);
        objects_.scroll_to = object;
    }
}

void Editor::editParameters() {
    if (!workspace_.isOpen()) {
        ImGui::TextDisabled("No scene is open.");
        return;
    }
    if (!setFromJson(draft_fields_, workspace_.state().parameters)) return;
    ui::ParametersView view;
    view.standard = &standard_fields_;
    view.has_scene = true;
    view.filter = &parameter_filter_;
    const ui::ParametersActions actions = ui::drawParametersPanel(view, draft_fields_);
    if (actions.reset_all) {
        draft_ = standard_;
        workspace_.setParameters(toJson(draft_fields_), "Reset all parameters", "");
    } else if (!actions.edited.empty()) {
        const auto field = std::ranges::find(draft_fields_, actions.edited, &Field::name);
        workspace_.setParameters(toJson(draft_fields_),
                                 fmt::format("Set {} to {}", actions.edited, field->valueText()),
                                 "set " + actions.edited);
    }
    if (actions.finished) workspace_.endMerge();
}

void Editor::drawRight() {
    if (!ImGui::BeginTabBar("right tabs")) return;
    if (ImGui::BeginTabItem("Parameters")) {
        editParameters();
        ImGui::EndTabItem();
    }
    ui::nameItem("tab.parameters");
    if (ImGui::BeginTabItem("Metrics")) {
        const PlanOutcome& shown = workspace_.shown();
        const BackgroundWorker::State job = workspace_.planning();
        ui::MetricsView view;
        view.plan = shown.plan.get();
        view.measured = shown.measured;
        view.scene = shown.scene.get();
        view.busy = job.busy;
        view.stage = job.stage;
        view.fraction = job.fraction;
        view.last_run_ms = workspace_.lastLatency_ms();
        const ui::MetricsActions actions = ui::drawMetricsPanel(view);
        if (actions.select_object != 0) select(actions.select_object, false);
        ImGui::EndTabItem();
    }
    ui::nameItem("tab.metrics");
    ImGui::EndTabBar();
}

void Editor::drawBottom() {
    if (!ImGui::BeginTabBar("bottom tabs")) return;
    if (ImGui::BeginTabItem("Log")) {
        ui::drawLogPanel(log_, log_state_);
        ImGui::EndTabItem();
    }
    ui::nameItem("tab.log");
    ImGui::EndTabBar();
}

void Editor::drawCentre() {
    ui::ViewportView view;
    view.image = &drawing_.view();
    const BackgroundWorker::State loading = workspace_.loading();
    if (loading.busy) {
        view.message =
            fmt::format("Opening … {:.0f} %  {}", 100.0 * loading.fraction, loading.stage);
    } else if (!workspace_.isOpen()) {
        view.message = "Drop a scene or a project here, or open one with Ctrl+O";
    } else if (!scene_sent_) {
        view.message = "Preparing the scene …";
    }
    if (!scene_sent_) view.image = nullptr;
    pane_ = ui::drawViewport(view, viewport_);
    if (pane_.camera_moved) window_.animate();
    if (pane_.clicked && view.image != nullptr) {
        select(ui::objectAt(*view.image, *pane_.clicked), pane_.add_to_selection);
    }
}

void Editor::drawStatus() {
    const BackgroundWorker::State job = workspace_.planning();
    if (job.busy) {
        ImGui::ProgressBar(static_cast<float>(job.fraction), {ui::scaled(120), 0}, "");
        ImGui::SameLine();
        ImGui::Text("planning: %s", job.stage.c_str());
    } else if (const std::string error = workspace_.planError(); !error.empty()) {
        ImGui::TextColored(ui::palette().bad, "%s", error.c_str());
    } else if (workspace_.isOpen() && workspace_.shown().plan) {
        const Plan& plan = *workspace_.shown().plan;
        ImGui::Text("%zu frames, %zu key frames, %d of %d captured", plan.trajectory.frames.size(),
                    plan.key_frames.size(), plan.capture_metrics.captured,
                    plan.capture_metrics.objects);
    }
    const std::string right = fmt::format("{:.0f} ms  picture {:.0f} ms", window_.lastFrame_ms(),
                                          drawing_.view().milliseconds);
    ImGui::SameLine(ImGui::GetWindowWidth() - ImGui::CalcTextSize(right.c_str()).x -
                    ui::scaled(12));
    ImGui::TextDisabled("%s", right.c_str());
}

void Editor::drawDialogs() {}

Eigen::AlignedBox3d Editor::selectedBox() const {
    Eigen::AlignedBox3d box;
    const auto& scene = workspace_.shown().scene;
    if (!scene) return box;
    for (const int id : selected_) {
        for (const Eigen::Vector3d& corner : scene->object(id).box.corners()) box.extend(corner);
    }
    return box;
}

}  // namespace dollytrack::editor
