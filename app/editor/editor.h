#pragma once

#include "app/editor/export/export_queue.h"
#include "app/editor/export/folder_check.h"
#include "app/editor/export/other_projects.h"
#include "app/editor/files/recent_files.h"
#include "app/editor/objects/piece_count.h"
#include "app/editor/objects/remedy_finder.h"
#include "app/editor/objects/selection_tracker.h"
#include "app/editor/project/autosave.h"
#include "app/editor/project/kept_plan.h"
#include "app/editor/project/motion_worker.h"
#include "app/editor/project/parameter_draft.h"
#include "app/editor/project/quality_worker.h"
#include "app/editor/project/workspace.h"
#include "app/editor/questions.h"
#include "app/editor/shell/panel_docks.h"
#include "app/editor/shell/panel_states.h"
#include "app/editor/shell/settings.h"
#include "app/editor/shell/settings_saver.h"
#include "app/editor/shell/window.h"
#include "app/editor/timeline/plan_timeline.h"
#include "app/editor/timeline/playback.h"
#include "app/editor/timeline/step_playback.h"
#include "app/editor/timeline/track_time.h"
#include "app/editor/viewport/gizmo_session.h"
#include "app/editor/viewport/layer_builder.h"
#include "app/editor/viewport/move_previewer.h"
#include "app/editor/viewport/picture_file.h"
#include "app/editor/viewport/picture_saver.h"
#include "app/editor/viewport/render_scene_sync.h"
#include "render/draw/storey_cutaway.h"
#include "ui/edit_request.h"
#include "ui/overlays/layers.h"
#include "ui/panels/edits/motion_section.h"
#include "ui/panels/export/export_panel.h"
#include "ui/panels/plan/comparison_section.h"
#include "ui/panels/plan/log_panel.h"
#include "ui/viewport/clip_handles.h"
#include "ui/viewport/clip_settings.h"
#include "ui/viewport/render_thread.h"
#include "ui/viewport/viewport_pane.h"
#include "ui/widgets/commands/command_palette.h"
#include "ui/widgets/commands/command_table.h"
#include "ui/widgets/files/file_browser.h"

#include <nlohmann/json_fwd.hpp>

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack::editor {

/// The editor's main class: draws the panels into the window and turns user actions into changes of
/// the workspace. Long work runs in the background.
class Editor {
  public:
    Editor(Window& window, std::unique_ptr<gl::Context> drawing, ui::LogBuffer& log,
           EditorSettings settings);
    ~Editor();

    void open(const std::filesystem::path& path) { workspace_.open(path); }
    /// Searches for unsaved work of editors that ended unexpectedly and offers to restore it.
    void offerRecoveredWork() { autosave_.searchForRecoveredWork(); }

    /// Draws one window frame; returns false to end the program.
    bool frame();

    /// The displayed state and the widgets' positions, for Inspector.
    [[nodiscard]] nlohmann::json stateJson();

  private:
    // editor.cpp: the frame
    void arrange();
    /// The bottom panels, with the docked preview beside them.
    void drawBottomRow(ImVec2 low, ImVec2 size);
    [[nodiscard]] bool exportsAtBottom() const;
    void refreshScene();
    /// Called when a file has been opened. Decides whether to show the bars that warn of doubtful
    /// import settings and of missing textures.
    void noteOpening();
    /// Loads the fonts again if the names of objects have letters that were not loaded so far.
    void loadLettersOf(const std::shared_ptr<const Scene>& scene);
    void autosave();
    void rememberSettings();
    void setTheme();
    void play();
    /// Remembers the time of the playhead.
    void noteCurrentTime();
    /// Goes to the frame of a new plan nearest to the time of the playhead, as its frames may have
    /// other numbers.
    void keepCurrentTime();
    /// Moves the playhead to the frame nearest to its position before the repair.
    void restorePositionAfterRepair();
    /// Duration of the frame at the playhead.
    [[nodiscard]] double secondsToNextFrame() const;
    /// Whether a dialog is open, which then has the keyboard.
    [[nodiscard]] bool dialogIsOpen() const;

    // editor_commands.cpp
    void addCommands();
    void addFileCommands();
    void addEditCommands();
    void addTargetCommands();
    void addPointCommands();
    void addSelectionCommands();
    void addTimelineCommands();
    void addTransformCommands();  // editor_objects.cpp
    void addObjectCommands();
    void drawMenus();

    // editor_view_commands.cpp
    void addViewCommands();
    void addHidingCommands();
    void addLayerCommands();
    void addWindowCommands();
    /// The handles of the clipping box, if it is on.
    void drawClip();
    /// The view for drawing handles other than the gizmo's. `hovered` is false where the gizmo, the
    /// camera preview or the legend takes the mouse; the pose is unset.
    [[nodiscard]] ui::GizmoView handleView();
    [[nodiscard]] std::optional<ui::GizmoView> clipView();
    void toggleClipBox();
    /// Shows only the selected objects, from nearby; or all again, in the view before.
    void toggleLocalView();

    // editor_panels.cpp
    /// Draws the tabs of a side, and the panel that is selected there.
    void drawDock(DockSide side);
    void drawPanel(Panel panel);
    void drawStatus();
    void drawDragStatus();
    void drawPlanStatus(const Plan& plan);
    void drawLightStatus();
    void drawSceneStatus();
    void drawObjects();
    void drawHistory();
    void drawLayers();
    void drawEdits();
    void drawExport();
    void drawParameters();
    /// Notes below parameters, by name.
    [[nodiscard]] std::map<std::string, std::string, std::less<>> parameterNotes();
    void setParameter(const std::string& name);  // to the value in the draft
    void drawMetrics();
    void drawSelection();
    void drawTimeline();
    void drawSteps();
    void drawLog();

    // editor_export.cpp
    void makeExportQueue();
    void drawSheet();
    void queueExport(const ui::ExportView& view);
    /// Asks whether to export to another folder or to overwrite the complete dataset in this one.
    void askToReplace(const ui::ExportRequest& request,
                      const std::function<void(const ui::ExportRequest&)>& add);
    void resumeExport(int id, const std::vector<ui::ExportJob>& jobs);
    [[nodiscard]] ui::ExportView exportView();
    /// Queues an export of another project with the settings of the form.
    void addOtherProject(const OtherProject& project);
    [[nodiscard]] std::filesystem::path exportFolder() const;

    // editor_state.cpp
    [[nodiscard]] nlohmann::json exportsJson() const;
    // Parts of stateJson().
    void addProjectTo(nlohmann::json& state);
    void addSelectionTo(nlohmann::json& state) const;
    void addTimelineTo(nlohmann::json& state) const;
    void addViewTo(nlohmann::json& state);
    void addWindowTo(nlohmann::json& state);
    /// The viewport's camera, the frame and the hidden objects, as a section of the project file;
    /// the plan does not depend on it.
    [[nodiscard]] nlohmann::json viewToStore() const;
    /// Takes the stored view of a project that was just opened, if it has one.
    void restoreView();
    /// Adds the displayed objects, position points and plan to the JSON state that
    /// the inspector returns.
    void addSceneAndPlanTo(nlohmann::json& state);

    // editor_viewport.cpp
    void drawCentre();
    void drawPreview();
    /// Whether the preview is drawn beside the bottom panels instead of over the viewport.
    [[nodiscard]] bool previewIsDocked() const;
    /// Width of the docked preview beside bottom panels of this height, px.
    [[nodiscard]] float previewWidth(float height, float window_width) const;
    void drawLegend();
    void editWithGizmo();
    [[nodiscard]] std::optional<ui::GizmoView> gizmoView();
    void drawBars();
    void drawImportBar();
    void drawSavedPathBar();
    void drawTextureBar();
    void requestPicture();
    void requestPreview();
    void requestLayers();
    /// "Front Orthographic", "User Perspective" or "Camera"
    [[nodiscard]] std::string viewName() const;
    [[nodiscard]] render::View viewportView(const ui::ViewerCamera& camera) const;
    /// Where the viewport is looked at from; also before a scene is open.
    [[nodiscard]] Pose viewPose() const;
    /// The storeys of the shown scene. A scene must be open.
    [[nodiscard]] const std::vector<render::StoreyView>& storeys() const;
    /// Factor for widths and sizes of overlays: below 1 if the camera is far from the scene.
    [[nodiscard]] double overlayScale() const;
    [[nodiscard]] std::optional<Pose> previewPose() const;

    // editor_picking.cpp: clicks into the viewport
    struct PickedPixel {
        double depth_m = 0.0;                     // of the scene's surface; 0: there is none
        std::vector<ui::PickedElement> elements;  // of layers, the best first
    };
    [[nodiscard]] PickedPixel pick(const Eigen::Vector2d& pixel) const;
    [[nodiscard]] std::vector<ui::Selection> underCursor(const Eigen::Vector2d& pixel);
    /// Selects the first of underCursor(); a second click at the same place selects the next. With
    /// `add`, adds the object or takes it out; with `list`, shows them all to choose from.
    void clickAt(const Eigen::Vector2d& pixel, bool add, bool list);
    void drawPickList();
    /// Opens the menu of the selection, which becomes `selection` unless that is part of it.
    void openSelectionMenu(const ui::Selection& selection);
    void drawSelectionMenu();
    /// The text of an element in that list.
    [[nodiscard]] std::string nameOf(const ui::Selection& selection) const;
    /// Selects the objects in a part of the image, parts of the building only if nothing else is;
    /// or takes all in it out of the selection.
    void selectInBox(const Eigen::AlignedBox2d& pixels, bool add, bool remove);
    /// Selects all objects that are not hidden, without the building.
    void selectAll();

    // editor_start.cpp: the start screen, and the pictures that it shows
    /// Path of the built-in scene; empty if it is not installed.
    [[nodiscard]] static std::string exampleScene();
    /// Saves a small copy of the viewport's image, which the start screen shows beside the file.
    void keepPicture();
    void drawStart();
    [[nodiscard]] nlohmann::json startJson() const;

    // editor_objects.cpp
    /// Ids of the selected objects, if they can be moved.
    [[nodiscard]] std::vector<int> movableObjects() const;
    /// Id of the selected object if exactly one is selected and can be moved; otherwise 0.
    [[nodiscard]] int movableObject() const;
    /// The object's box with the newest edits, which the scene on the screen may lack.
    [[nodiscard]] OrientedBox objectBox(int id) const;
    /// Where the gizmo of these objects is drawn. For one object: the centre of its box, with the
    /// object's rotation as yaw. For several: the mean of their centres, without rotation.
    [[nodiscard]] Pose poseOfObjects(const std::vector<int>& ids) const;
    /// The objects that edits have moved since the scene on the screen was built.
    [[nodiscard]] std::vector<ui::MovedObject> movedObjects() const;
    void moveWithGizmo(const ui::GizmoView& view, const std::vector<int>& ids);
    /// Moves and turns the dragged objects about their middle, relative to `before_drag_`.
    void moveDragged(const ui::PoseChange& change);
    /// Applies the `moves` of the operation move_objects.
    void applyMoves(const nlohmann::json& moves, const std::string& merge_key = {});
    [[nodiscard]] nlohmann::json removeKeyHere() const;
    void playTracks();
    void goToTrackTime(double time_s);
    void followTracks();
    void drawTracks();
    [[nodiscard]] bool hasTracks() const;

    // editor_motion.cpp: given camera motions
    void addMotionCommands();
    [[nodiscard]] ui::MotionView motionView();
    void follow(const ui::MotionActions& actions);
    /// The file that the current camera path was read from; null if it is not from a file.
    [[nodiscard]] const MotionFile* motionFile() const;
    void readMotion(const MotionFile& file);
    void takeMotion();
    /// Removes the part of the given motion before or after the current frame.
    void trimMotion(bool before);
    /// The camera move set up in the form; its subject is the selected object, if there is one.
    [[nodiscard]] planning::MoveRequest moveOfForm() const;
    /// Keeps the previewed camera move equal to the form while the form's panel is open.
    void followMoveForm();
    void drawMove();
    void showMove();  // brings its path into view
    /// A drag of a handle of the camera move in the form, which undo takes back.
    struct MoveDragStep {
        CommandStack::State state;  // of the project at that time
        std::string kind;
        planning::MoveOptions before;
    };
    /// The latest drag of a handle, if nothing else was edited since; null: none.
    [[nodiscard]] const MoveDragStep* lastMoveDrag() const;
    bool undoMoveDrag();  // returns false if there is none
    void cancelMoveDrag();
    /// Makes the move that the form describes. Asks first if the camera path has keys or is from a
    /// file.
    void makeMove();
    /// The text of an error that planning a camera move returned. It names settings by their labels
    /// in the form ("From height") instead of their names on the command line ("from_height").
    [[nodiscard]] static std::string moveFault(const Error& error);

    // editor_keys.cpp: key frames of the camera path
    void addCameraKeyCommands();
    /// Keys of the newest edits; empty if there are none.
    [[nodiscard]] const std::vector<MotionKey>& cameraKeys() const;
    [[nodiscard]] const MotionKey* selectedKey() const;
    /// How the plan on the screen passes the keys; empty while a plan for them is being made.
    [[nodiscard]] const std::vector<PassedKey>& passedKeys() const;
    [[nodiscard]] std::string whyNoKey() const;
    void recordKey();
    /// The selected key, or the one that the playhead is on.
    [[nodiscard]] std::optional<std::size_t> keyToReplace() const;
    [[nodiscard]] std::string whyNoReplacing() const;
    void replaceKey();
    /// Moves the playhead to a recorded key as soon as a plan passes it.
    void goToRecordedKey();
    void moveSelectedKey(const Pose& pose);
    /// Drops the selection of a key when keys were added or removed: its index means another one.
    void dropOutdatedKeySelection();
    /// Remembers the key at this time as the latest one recorded, for drawKeyBar().
    void noteRecordedKey(double time_s);
    /// Warns if the camera cannot be at the key recorded last.
    void drawKeyBar();
    /// Says that the first key replaces the planned trajectory.
    void drawFirstKeyBar();
    /// The states of a motion's keys, and what they were computed from.
    struct KeyStates {
        SharedMotion motion;
        std::shared_ptr<const planning::FreeSpace> free_space;
        std::shared_ptr<const planning::AllowedRegion> region;
        std::vector<ui::KeyState> keys;
    };
    /// Whether the camera can be at each key, computed directly from the map, so that it is known
    /// before the motion through the keys is planned.
    const KeyStates& keyStates();
    /// Why the camera collides at the current frame, as a sentence; empty: it does not.
    [[nodiscard]] std::string collisionHere() const;
    /// Moves a key to the nearest place where the camera can be.
    void freeKey(std::size_t key);
    /// Goes to the next (1) or the previous (-1) collision of the camera path.
    void goToCollision(int direction);
    [[nodiscard]] std::vector<ui::TimelineCameraKey> timelineCameraKeys();
    void follow(const ui::TimelineActions& actions);

    // editor_comparison.cpp: the kept plan, and the quality of the frames
    void addComparisonCommands();
    [[nodiscard]] ui::ComparisonView comparisonView();
    void follow(const ui::ComparisonActions& actions);
    void followComparison();  // takes results of the background
    [[nodiscard]] std::string whyPlanNotCurrent() const;
    void addComparison(LayersRequest& request) const;
    /// Has small images of all frames drawn and classified, while that is wanted.
    void probePictures();
    [[nodiscard]] double probedShare() const;  // of the frames whose images are wanted
    /// The tooltip of the frame under the mouse, while weak frames are shown.
    void drawFrameTip();
    [[nodiscard]] nlohmann::json comparisonJson() const;

    // editor_dialogs.cpp
    void drawDialogs();
    void askForFile(const std::string& id);
    void askForUnit();
    void answerFile(const ui::FileAnswer& answer);
    void answerExportFile(const ui::FileAnswer& answer);
    [[nodiscard]] Questions::Callbacks questionCallbacks();
    void openAfterAsking(const std::filesystem::path& path);
    void save();

    // Changing the project and the selection
    void tellRefusal(const Status& done);
    void apply(const nlohmann::json& operation, const std::string& merge_key = {});
    void applyRequest(const ui::EditRequest& request);
    void select(ui::Selection selection);
    void selectObject(int object, bool add);
    void goToFrame(int frame);
    /// Returns from the view through the plan's camera to the view before.
    void leaveCameraView();
    void lookAlongPose(const Pose& pose);
    void dropGizmo();
    void finishDrag();
    void cancelDrag();
    /// Starts a move or a rotation of the selection that follows mouse and keyboard.
    void startKeyTransform(ui::GizmoPart part);
    /// Moves the view, without turning it, until the box fills it.
    void bringIntoView(const Eigen::AlignedBox3d& box);
    /// Brings the box into view and turns the view, if it is in perspective, until nothing hides
    /// the box.
    void showUnobstructed(const Eigen::AlignedBox3d& box);
    void togglePin();
    void deleteSelected();
    void runKeys();
    void runKeypad();
    [[nodiscard]] Eigen::AlignedBox3d selectedBox() const;
    [[nodiscard]] std::optional<OrientedBox> boxAroundSelection() const;
    [[nodiscard]] OrientedBox boxInView();  // editor_objects.cpp
    [[nodiscard]] int frameCount() const;
    /// An object's role after all edits, including those that the shown scene does not contain yet.
    [[nodiscard]] Role newestRole(int object) const;
    [[nodiscard]] const Plan* plan() const { return workspace_.shown().plan.get(); }

    Window& window_;
    ui::LogBuffer& log_;
    EditorSettings settings_;
    SettingsSaver settings_saver_;
    /// Once the user has confirmed the import settings of a scene, this prefix and the scene's path
    /// are an entry in EditorSettings::seen.
    static constexpr const char* kImportKept = "import kept: ";
    bool import_bar_dismissed_ = false;
    bool import_kept_here_ = false;      // since the project was opened
    bool textures_note_ = false;         // the bar about missing textures is shown
    std::string missing_textures_note_;  // remembered once it is hidden
    std::filesystem::path noted_file_;   // the latest entry added to the recent files
    Workspace workspace_;
    Autosave autosave_;
    ui::RenderThread drawing_;
    LayerBuilder layers_;
    ui::CommandTable commands_;
    /// The same view commands on the number pad, as in Blender.
    struct KeypadKey {
        int key = 0;
        bool ctrl = false;
        std::function<void()> run;
    };
    std::vector<KeypadKey> keypad_;
    std::unique_ptr<ExportQueue> exports_;  // null if the export program is missing
    std::string why_no_export_;
    std::string why_no_folders_;
    FolderCheck export_folder_;
    OtherProjects other_projects_{&Window::wake};
    RecentFiles recent_{stateFolder() / "thumbnails", &Window::wake};
    const std::string example_ = exampleScene();
    bool has_picture_ = false;  // the viewport has shown the open scene
    bool was_saving_ = false;   // in the previous window frame
    PictureFile sheet_;
    ui::FileBrowser files_;

    // Selection and display state.
    SelectionTracker selected_;
    PieceCount pieces_;
    ui::LayerSettings layer_settings_;
    ui::ViewerCamera view_before_local_;
    /// A selected object before a drag of the gizmo.
    struct DraggedObject {
        int id = 0;
        ObjectMove move;
        Eigen::Vector3d center = Eigen::Vector3d::Zero();  // of its box, m
    };
    struct Click {
        Eigen::Vector2d pixel;
        Pose view;
    };
    std::optional<Click> last_click_;  // the latest that selected; in the viewport
    struct PickList {
        std::vector<ui::Selection> found;
        std::shared_ptr<const Scene> scene;
        std::shared_ptr<const Plan> plan;
    };
    PickList pick_list_;
    bool opens_selection_menu_ = false;
    ui::ClipSettings clip_;
    ui::ClipHandles clip_handles_;
    mutable std::vector<render::StoreyView> storeys_;  // for the scene and plan below
    mutable std::shared_ptr<const Scene> storeys_of_scene_;
    mutable std::shared_ptr<const Plan> storeys_of_plan_;
    Playback playback_;
    TrackTime track_time_;
    CommandStack::State followed_tracks_;  // state from which track_time_ was read
    StepPlayback step_playback_;
    bool through_camera_ = false;
    GizmoSession gizmo_;
    std::vector<DraggedObject> before_drag_;
    CommandStack::History history_before_drag_;
    std::string refused_key_;  // why the command of the key pressed last cannot run; or empty
    RemedyFinder remedies_{&Window::wake};
    QualityWorker quality_{&Window::wake};
    PlanComparison comparison_{&Window::wake};
    std::shared_ptr<const ui::RenderThread::Views> probes_;  // being drawn; null: none
    std::shared_ptr<const Plan> probed_plan_;
    std::shared_ptr<const render::LightVolume> probed_light_;
    // Of the frames of probed_plan_; null: not all are known; empty: they cannot be drawn.
    ui::PictureClasses frame_classes_;
    MotionWorker motions_{&Window::wake};
    MovePreviewer move_preview_{&Window::wake};
    std::vector<MoveDragStep> move_drags_;
    struct ReadMotion {
        SharedMotion motion;
        MotionFile file;
    };
    // Camera paths read from files, and their repairs; undo and redo return to them.
    std::vector<ReadMotion> read_motions_;
    SharedMotion repaired_motion_;           // result of the last repair
    std::optional<KeptPlan> before_repair_;  // the plan before that repair
    std::string motion_change_;              // what that repair changed
    std::filesystem::path saved_path_;       // file of the camera path saved last, until hidden
    std::weak_ptr<const Scene> scene_of_letters_;  // see loadLettersOf()
    double current_time_s_ = 0.0;      // of the playhead; it stays when the plan changes
    std::optional<int> stored_frame_;  // stored frame of a project whose plan is awaited
    std::optional<Eigen::Vector3d> position_before_repair_;  // of the playhead
    std::optional<double> recorded_key_s_;  // time of a key that the playhead shall move to
    SharedMotion made_motion_;              // result of the last camera move
    std::string move_note_;                 // how obstacles changed that move
    std::size_t key_count_ = 0;             // in the previous window frame
    struct RecordedKey {
        SharedMotion motion;
        std::size_t key = 0;
    };
    std::optional<RecordedKey> recorded_key_;  // latest key recorded; empty after other changes
    KeyStates key_states_;
    PlanTimeline plan_timeline_;
    RenderSceneSync scene_sync_;
    ParameterDraft parameters_;

    // State of the panels.
    PanelStates panels_;
    ui::ViewportActions pane_;
    // Height of the bottom panels at which no part of the export form needs to scroll, px.
    float export_height_ = 0.0F;
    float export_missing_ = 0.0F;  // see ui::ExportActions::missing_height
    bool preview_hovered_ = false;
    bool popup_was_open_ = false;  // in the previous window frame
    std::vector<ui::PaletteItem> palette_parameters_;
    PanelDocks docks_;

    // Questions to the user.
    Questions questions_;
    std::optional<ui::PreviewImage> picture_to_save_;  // image whose file is being chosen
    PictureSaver pictures_;
    bool scene_wanted_to_restore_ = false;
    std::filesystem::path scene_wanted_by_;  // project whose scene file the user is choosing
    bool quitting_ = false;
};

}  // namespace dollytrack::editor
