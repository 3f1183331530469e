#include "app/editor/editor.h"

#include "engine/core/log.h"
#include "ui/theme.h"
#include "ui/widgets/splitter.h"

#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace dollytrack::editor {
namespace {

// No background: gl::clearWindow() already fills the window with the background colour, and drawing
// it again takes a third of a frame's time in software rendering.
constexpr ImGuiWindowFlags kPart =
    ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
    ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
    ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoBackground;

void beginPart(const char* name, ImVec2 at, ImVec2 size, ImGuiWindowFlags more = 0) {
    ImGui::SetNextWindowPos(at);
    ImGui::SetNextWindowSize(size);
    ImGui::Begin(name, nullptr, kPart | more);
}

/// A part without padding and scrolling.
void beginImagePart(const char* name, ImVec2 at, ImVec2 size) {
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
    beginPart(name, at, size, ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
    ImGui::PopStyleVar();
}

/// A part's border; dragging it changes the part's `length` (px at 96 dots per inch).
void dragBorder(const char* name, ImVec2 from, ImVec2 to, bool vertical, float sign, float& length,
                float least, float most) {
    const float scale = ui::scaled(1.0F);
    float px = scale * std::clamp(length, least, most);
    if (ui::splitter(name, from, to, vertical, sign, px, scale * least, scale * most)) {
        length = px / scale;
    }
}

/// The pinned points used for the plan on the screen.
const std::vector<PinnedPoint>& pinnedIn(const PlanOutcome& shown) {
    static const std::vector<PinnedPoint> kNone;
    return shown.state ? shown.state->edits.plan.pinned : kNone;
}

}  // namespace

Editor::Editor(Window& window, std::unique_ptr<gl::Context> drawing, ui::LogBuffer& log,
               EditorSettings settings)
    : window_(window),
      log_(log),
      settings_(std::move(settings)),
      workspace_(&Window::wake),
      autosave_(&Window::wake),
      drawing_(std::move(drawing), &Window::wake),
      layers_(&Window::wake),
      export_folder_(&Window::wake),
      sheet_(&Window::wake),
      files_(&Window::wake),
      pieces_(&Window::wake),
      scene_sync_(drawing_),
      questions_(workspace_, questionCallbacks()),
      pictures_(&Window::wake) {
    ui::loadFonts(window_.contentScale() * settings_.zoom);
    setTheme();
    panels_.timeline.strips = settings_.layout.strips;
    panels_.preview.open = settings_.layout.show_preview;
    panels_.preview.docked = settings_.layout.dock_preview;
    layer_settings_ = settings_.layout.layers;
    docks_.restore(settings_.layout.panels, settings_.layout.open_tabs);
    addCommands();
    makeExportQueue();
    for (const Field& field : parameters_.standard()) {
        palette_parameters_.push_back({field.name, std::string(field.text())});
    }
}

Editor::~Editor() {
    keepPicture();
    rememberSettings();
    settings_saver_.stop();  // two writers must not write at once
    if (const Status saved = saveSettings(settings_); !saved) {
        log::warn("editor", describe(saved.error()));
    }
}

void Editor::setTheme() {
    ui::applyTheme(settings_.theme, window_.contentScale() * settings_.zoom);
}

void Editor::refreshScene() {
    if (const auto news = workspace_.takeNewScene(); news != Workspace::NewScene::None) {
        keepPicture();
        has_picture_ = false;
        selected_.forget();
        panels_.objects = {};
        clip_ = {};
        playback_.reset();
        track_time_.reset();
        step_playback_.goTo(0);
        through_camera_ = false;
        scene_sync_.forget();
        remedies_.forget();
        comparison_.drop();
        motions_.cancel();
        move_preview_.follow(std::nullopt, workspace_.shown());
        panels_.move = {};
        move_drags_.clear();
        recorded_key_s_.reset();
        read_motions_.clear();
        repaired_motion_ = {};
        before_repair_.reset();
        position_before_repair_.reset();
        saved_path_.clear();
        current_time_s_ = 0.0;
        made_motion_ = {};
        recorded_key_.reset();
        dropGizmo();
        noteOpening();
        drawing_.setScene({});
        stored_frame_.reset();
        if (news == Workspace::NewScene::Opened) {
            questions_.forgetProject();
            panels_.export_draft.forgetProject();
            // The autosave copy belongs to the previous project.
            autosave_.discard();
            autosave_.replaces(workspace_.restoredFrom());
            noted_file_.clear();
            import_kept_here_ = false;
            restoreView();
        } else if (import_kept_here_ || workspace_.previousImport()) {
            import_bar_dismissed_ = false;
        }
    }
    const PlanOutcome& shown = workspace_.shown();
    selected_.follow(shown.objects);
    if (plan_timeline_.follow(shown.scene.get(), shown.rays.get(), shown.plan,
                              shown.params.camera.camera_radius_m)) {
        playback_.setFrameCount(frameCount());
        keepCurrentTime();
        if (plan() != nullptr && stored_frame_) goToFrame(*std::exchange(stored_frame_, {}));
        goToRecordedKey();
        restorePositionAfterRepair();
        if (plan() != nullptr) {
            step_playback_.goTo(
                std::min(step_playback_.taken(), plan()->roadmap.steps.steps.size()));
        }
        // Indices of the previous plan are invalid now, also during a drag.
        const bool chosen = selected_.is(ui::Selection::Kind::PositionPoint);
        if (!selected_.keepIn(plan(), pinnedIn(shown))) dropGizmo();
        if (!chosen && selected_.is(ui::Selection::Kind::PositionPoint)) {
            panels_.preview.shows_selection = true;
            docks_.select(panelName(Panel::Selection));
        }
    }
    if (!shown.scene) return;
    loadLettersOf(shown.scene);
    scene_sync_.send(shown, workspace_.lighter());
}

void Editor::loadLettersOf(const std::shared_ptr<const Scene>& scene) {
    if (scene_of_letters_.lock() == scene) return;
    scene_of_letters_ = scene;
    bool more = ui::addLetters(workspace_.sceneFile().string());
    for (const Object& object : scene->objects) more = ui::addLetters(object.name) || more;
    if (more) window_.requestFonts(window_.contentScale() * settings_.zoom);
}

void Editor::noteOpening() {
    import_bar_dismissed_ = textures_note_ = false;
    if (!workspace_.isOpen()) return;
    const std::string scene = workspace_.sceneFile().string();
    import_bar_dismissed_ =
        settings_.hasSeen(kImportKept + scene) || workspace_.previousImport().has_value();
    const std::size_t missing = workspace_.importReport().textures_missing.size();
    missing_textures_note_ = fmt::format("{} textures missing: {}", missing, scene);
    textures_note_ = missing > 0 && !settings_.hasSeen(missing_textures_note_);
}

void Editor::noteCurrentTime() {
    const auto frame = static_cast<std::size_t>(playback_.frame());
    if (plan() == nullptr || frame >= plan()->trajectory.frames.size()) return;
    current_time_s_ = plan()->trajectory.frames[frame].time_s;
}

void Editor::restorePositionAfterRepair() {
    if (!position_before_repair_ || plan() == nullptr || !workspace_.planIsCurrent()) return;
    const Eigen::Vector3d position = *std::exchange(position_before_repair_, std::nullopt);
    if (workspace_.state().edits.plan.motion != repaired_motion_) return;
    const auto& frames = plan()->trajectory.frames;
    const auto nearest = std::ranges::min_element(frames, {}, [&](const TrajectoryFrame& frame) {
        return (frame.pose.position - position).squaredNorm();
    });
    if (nearest != frames.end()) goToFrame(static_cast<int>(nearest - frames.begin()));
}

void Editor::keepCurrentTime() {
    if (plan() == nullptr || frameCount() == 0) return;
    const std::vector<TrajectoryFrame>& frames = plan()->trajectory.frames;
    const auto nearest = std::ranges::min_element(frames, {}, [&](const TrajectoryFrame& frame) {
        return std::abs(frame.time_s - current_time_s_);
    });
    playback_.goTo(static_cast<int>(nearest - frames.begin()));
}

double Editor::secondsToNextFrame() const {
    if (plan() == nullptr) return 1.0;
    const Trajectory& trajectory = plan()->trajectory;
    const auto next = static_cast<std::size_t>(playback_.frame()) + 1;
    if (next >= trajectory.frames.size()) return trajectory.frame_interval_s;
    const double seconds = trajectory.frames[next].time_s - trajectory.frames[next - 1].time_s;
    return seconds > 0.0 ? seconds : trajectory.frame_interval_s;
}

void Editor::play() {
    if (!playback_.playing()) return;
    double seconds = ImGui::GetIO().DeltaTime * panels_.timeline.speed;
    while (seconds > 0.0 && playback_.playing()) {
        constexpr double kShortest_s = 1e-3;  // of a damaged plan
        const double step_s = std::max(secondsToNextFrame(), kShortest_s);
        const double frames = std::min(seconds / step_s, playback_.untilNext());
        playback_.advance(frames, panels_.timeline.loop);
        seconds -= frames * step_s;
    }
    if (playback_.playing()) {
        window_.drawAfter(playback_.untilNext() * secondsToNextFrame() / panels_.timeline.speed);
    }
}

bool Editor::frame() {
    // Files dropped during a question are opened after it is answered.
    if (!questions_.waiting()) {
        for (const std::string& path : window_.takeDroppedPaths()) openAfterAsking(path);
    }
    if (window_.takeCloseRequest()) commands_.find("file.quit")->run();
    if (window_.takeScaleChange()) {
        setTheme();
        window_.requestFonts(window_.contentScale() * settings_.zoom);
    }
    drawing_.takeNews();
    workspace_.poll();
    layers_.poll();
    refreshScene();
    takeMotion();
    followMoveForm();
    followComparison();
    play();
    noteCurrentTime();
    followTracks();
    dropOutdatedKeySelection();
    // Keys belong to an open menu or popup: Escape closes it (already handled) and must do nothing
    // else.
    if (!popup_was_open_ && !dialogIsOpen()) runKeys();
    drawMenus();
    arrange();
    drawDialogs();
    requestLayers();
    requestPicture();
    requestPreview();
    // After quitting, discarded work must not be saved again.
    if (!quitting_) autosave();
    rememberSettings();
    popup_was_open_ = ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup);
    window_.navigation().endFrame(pane_.hovered, dialogIsOpen(), gizmo_.usesKeys());
    window_.setTitle(workspace_.title());
    return !quitting_;
}

bool Editor::dialogIsOpen() const {
    return files_.isOpen() || panels_.palette.open || panels_.help.open || sheet_.isOpen() ||
           questions_.waiting();
}

bool Editor::exportsAtBottom() const {
    return docks_.isOpen(panelName(Panel::Export)) &&
           docks_.places().sideOf(panelName(Panel::Export)) == DockSide::Bottom;
}

void Editor::drawBottomRow(ImVec2 low, ImVec2 size) {
    // The export form needs the whole width.
    const bool beside = previewIsDocked() && !exportsAtBottom();
    const float dock = beside ? previewWidth(size.y, size.x) : 0.0F;
    beginPart("bottom", low, {size.x - dock, size.y});
    drawDock(DockSide::Bottom);
    ImGui::End();
    if (!beside) return;
    beginImagePart("preview", {low.x + size.x - dock, low.y}, {dock, size.y});
    drawPreview();
    ImGui::End();
}

void Editor::arrange() {
    const ImVec2 low = ImGui::GetMainViewport()->WorkPos;
    const ImVec2 size = ImGui::GetMainViewport()->WorkSize;
    Layout& layout = settings_.layout;
    const float scale = ui::scaled(1.0F);
    const float status = ImGui::GetFrameHeight() + ui::scaled(6);
    // The viewport keeps a minimum size in small windows.
    const float most_side = std::max(0.5F * (size.x / scale - 320.0F), 180.0F);
    // The export form is taller than the other bottom panels and leaves less to the viewport.
    const bool exports = exportsAtBottom();
    float bottom_height = exports ? layout.bottom_export : layout.bottom;
    if (exports && layout.bottom_export == Layout().bottom_export) {
        // Until the user sets its height, the form grows while the viewport stays large.
        constexpr float kLargeViewport = 600.0F;
        const float most = size.y / scale - kLargeViewport;
        bottom_height = std::max(bottom_height, std::min(export_height_ / scale, most));
    }
    const float most_bottom = std::max(size.y / scale - (exports ? 220.0F : 300.0F), 120.0F);
    // In a small window the panels are smaller than their settings, which hold for a larger one.
    const bool show_left = docks_.places().isVisible(DockSide::Left);
    const bool show_right = docks_.places().isVisible(DockSide::Right);
    const bool show_bottom = docks_.places().isVisible(DockSide::Bottom);
    const float left = show_left ? scale * std::clamp(layout.left, 180.0F, most_side) : 0.0F;
    const float right = show_right ? scale * std::clamp(layout.right, 180.0F, most_side) : 0.0F;
    // The row for track times adds to the height, so that the last strip stays visible.
    const float tracks = hasTracks() ? ImGui::GetFrameHeightWithSpacing() : 0.0F;
    const float bottom =
        show_bottom ? scale * std::clamp(bottom_height, 110.0F, most_bottom) + tracks : 0.0F;
    const float middle = size.y - status - bottom;
    step_playback_.show(false);  // the steps are shown while their panel is
    if (show_left) {
        beginPart("left", low, {left, middle});
        drawDock(DockSide::Left);
        ImGui::End();
    }
    if (show_right) {
        beginPart("right", {low.x + size.x - right, low.y}, {right, middle});
        drawDock(DockSide::Right);
        ImGui::End();
    }
    if (show_bottom) drawBottomRow({low.x, low.y + middle}, {size.x, bottom});
    if (show_bottom && exports) export_height_ = bottom + export_missing_;
    docks_.followDrag(low, {low.x + size.x, low.y + size.y - status});
    beginImagePart("centre", {low.x + left, low.y}, {size.x - left - right, middle});
    drawCentre();
    ImGui::End();
    beginPart("status", {low.x, low.y + size.y - status}, {size.x, status},
              ImGuiWindowFlags_NoScrollbar);
    drawStatus();
    ImGui::End();
    const float grip = ui::scaled(3);
    if (show_left) {
        dragBorder("splitter.left", {low.x + left - grip, low.y},
                   {low.x + left + grip, low.y + middle}, true, 1.0F, layout.left, 180, most_side);
    }
    if (show_right) {
        const float at = low.x + size.x - right;
        dragBorder("splitter.right", {at - grip, low.y}, {at + grip, low.y + middle}, true, -1.0F,
                   layout.right, 180, most_side);
    }
    if (show_bottom) {
        const float before = bottom_height;
        dragBorder("splitter.bottom", {low.x, low.y + middle - grip},
                   {low.x + size.x, low.y + middle + grip}, false, -1.0F, bottom_height, 110,
                   most_bottom);
        if (bottom_height != before) {
            (exports ? layout.bottom_export : layout.bottom) = bottom_height;
        }
    }
}

void Editor::rememberSettings() {
    if (workspace_.isOpen()) {
        // The project was opened, or saved under another name.
        const std::filesystem::path& file =
            workspace_.path().empty() ? workspace_.sceneFile() : workspace_.path();
        if (noted_file_ != file) {
            noted_file_ = file;
            if (file != example_)
                settings_.addRecent(file);  // the start screen shows it in a row of its own
        }
        if (was_saving_ && !workspace_.saving()) keepPicture();
    }
    was_saving_ = workspace_.saving();
    settings_.window = window_.settings();
    settings_.layout.strips = panels_.timeline.strips;
    settings_.layout.show_preview = panels_.preview.open;
    settings_.layout.dock_preview = panels_.preview.docked;
    settings_.layout.layers = layer_settings_;
    settings_.layout.panels = docks_.places();
    settings_.layout.open_tabs = docks_.openTabs();
    settings_saver_.follow(settings_);
}

void Editor::autosave() {
    if (!workspace_.isOpen() || workspace_.isImporting()) return;
    const CommandStack::State& state = workspace_.history().state();
    if (!workspace_.unsaved()) {
        autosave_.discard();
    } else if (autosave_.isDue(state)) {
        autosave_.store(workspace_.history().history(), workspace_.snapshot(false),
                        {workspace_.path(), workspace_.fileContent()});
    }
}

void Editor::tellRefusal(const Status& done) {
    if (done) return;
    // Field names of operations mean nothing to users of the editor.
    const bool refused = done.error().code == ErrorCode::Usage;
    questions_.tell(
        {true, "That cannot be done", refused ? done.error().message : describe(done.error()), {}});
}

void Editor::apply(const nlohmann::json& operation, const std::string& merge_key) {
    // A newly placed point is selected, so that its gizmo appears. Operations within a merged step
    // keep the selection.
    const bool places_point =
        merge_key.empty() && (operation["op"] == "pin" || operation["op"] == "add_point");
    std::vector<PinnedPoint> pinned_before;
    if (places_point && workspace_.isOpen()) pinned_before = workspace_.state().edits.plan.pinned;
    recorded_key_s_.reset();
    const Status done = workspace_.apply(operation, merge_key);
    tellRefusal(done);
    if (!done || !places_point) return;
    for (const PinnedPoint& point : workspace_.state().edits.plan.pinned) {
        if (std::ranges::count(pinned_before, point) == 0) selected_.awaitPin(point.name);
    }
}

void Editor::applyRequest(const ui::EditRequest& request) {
    const auto counts = [&] {
        if (!workspace_.isOpen()) return std::pair<std::size_t, std::size_t>();
        const PlanEdits& edits = workspace_.state().edits.plan;
        return std::pair(edits.no_go.size(), edits.regions.size());
    };
    const auto [boxes, regions] = counts();
    if (request.asks()) apply(request.operation, request.merge_key);
    // A new box is selected, so that its gizmo appears.
    using Kind = ui::Selection::Kind;
    const auto [boxes_now, regions_now] = counts();
    if (boxes_now > boxes) select(ui::Selection::ofItem(Kind::NoGoBox, static_cast<int>(boxes)));
    if (regions_now > regions) {
        select(ui::Selection::ofItem(Kind::Region, static_cast<int>(regions)));
    }
    if (request.ends_merge) workspace_.endMerge();
}

void Editor::dropGizmo() {
    if (gizmo_.dragging()) workspace_.endMerge();
    gizmo_.drop();
}

void Editor::finishDrag() {
    workspace_.endMerge();
    gizmo_.drop();
}

void Editor::startKeyTransform(ui::GizmoPart part) {
    // Enter confirms the change instead of the panel's widget that was used last.
    ImGui::SetWindowFocus(nullptr);
    dropGizmo();  // a drag with the mouse ends as an undo step of its own
    panels_.viewport.cancelBoxSelect();
    history_before_drag_ = workspace_.history().history();
    gizmo_.start(part);
}

void Editor::cancelDrag() {
    // A dragged point becomes an edit only at the end; other drags edit continuously.
    dropGizmo();
    workspace_.rewind(history_before_drag_);
}

void Editor::select(ui::Selection selection) {
    if (!(selection == selected_.now())) dropGizmo();
    selected_.set(std::move(selection), plan(), pinnedIn(workspace_.shown()));
    // Shows the view of a selected position point.
    panels_.preview.shows_selection = selected_.is(ui::Selection::Kind::PositionPoint);
    if (selected_.is(ui::Selection::Kind::Frame)) goToFrame(selected_.now().index);
    if (!selected_.objects().empty()) panels_.objects.scroll_to = selected_.objects().back();
    if (!selected_.is(ui::Selection::Kind::None)) docks_.select(panelName(Panel::Selection));
}

void Editor::selectObject(int object, bool add) {
    select(selected_.withObject(object, add));
}

void Editor::goToFrame(int frame) {
    stored_frame_.reset();
    playback_.goTo(frame);
    noteCurrentTime();
    panels_.preview.shows_selection = false;
}

void Editor::runKeys() {
    // A move or rotation by keys takes all of them.
    if (gizmo_.usesKeys()) {
        if (ImGui::IsKeyPressed(GLFW_KEY_ESCAPE, false)) cancelDrag();
        return;
    }
    // While the camera looks around, letters fly it.
    if (panels_.viewport.drag == ui::ViewportState::Drag::Look &&
        ImGui::IsMouseDown(ImGuiMouseButton_Right)) {
        return;
    }
    std::optional<std::string> refused = commands_.runShortcuts(&Window::signOfKey);
    if (refused) refused_key_ = std::move(*refused);
    if (ImGui::IsMouseClicked(ImGuiMouseButton_Left)) refused_key_.clear();
    runKeypad();
}

void Editor::runKeypad() {
    const ImGuiIO& io = ImGui::GetIO();
    if (io.WantTextInput || !workspace_.shown().scene) return;
    for (const KeypadKey& key : keypad_) {
        if (ImGui::IsKeyPressed(key.key) && key.ctrl == io.KeyCtrl) key.run();
    }
}

int Editor::frameCount() const {
    return plan() != nullptr ? static_cast<int>(plan()->trajectory.frames.size()) : 0;
}

Eigen::AlignedBox3d Editor::selectedBox() const {
    if (!workspace_.shown().scene) return {};
    return selected_.box(*workspace_.shown().scene, plan(), workspace_.state().edits.plan);
}

std::optional<OrientedBox> Editor::boxAroundSelection() const {
    const Eigen::AlignedBox3d around = selectedBox();
    if (around.isEmpty()) return std::nullopt;
    return OrientedBox{around.center(), 0.5 * around.sizes(), 0.0};
}

}  // namespace dollytrack::editor
