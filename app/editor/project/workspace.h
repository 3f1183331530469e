#pragma once

#include "app/editor/files/file_watch.h"
#include "app/editor/files/known_files.h"
#include "app/editor/project/autosave.h"
#include "app/editor/project/import_worker.h"
#include "app/editor/project/light_worker.h"
#include "app/editor/project/live_planner.h"
#include "app/editor/project/project_loader.h"
#include "engine/document/command_stack.h"
#include "engine/io/settings/project_file.h"
#include "engine/jobs/background_worker.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dollytrack::editor {

/// The open project and everything computed from it: the user's edits (with undo), the scene, the
/// newest plan, the light. Independent of the window. All functions are called from one thread and
/// return at once; background results arrive with poll().
class Workspace {
  public:
    explicit Workspace(std::function<void()> wake);
    ~Workspace();

    // Opening and saving
    /// Opens a scene or project in the background; the open one stays until that has succeeded.
    /// `scene_instead` replaces the project's scene file.
    void open(const std::filesystem::path& path,
              const std::optional<std::filesystem::path>& scene_instead = std::nullopt);
    /// Opens an autosave copy as unsaved work of its project.
    void restore(const std::filesystem::path& copy,
                 const std::optional<std::filesystem::path>& scene_instead = std::nullopt);
    /// Imports the open project's scene again with one setting of its section `import` changed;
    /// null removes it. Parameters and edits are kept; the open scene stays until the other is
    /// read. One undo step with this name: undoing it imports the scene again.
    void changeImport(const char* setting, nlohmann::json value, const std::string& name);
    /// Likewise with the import report's proposed settings.
    void applyProposal();
    /// Returns to the settings of previousImport(): by undo if the last step changed them, else by
    /// another step.
    void revertImport();
    /// Confirms the import settings in use against the proposal: they become part of the project.
    /// One undo step with this name.
    void keepImport(const std::string& name);
    void cancelOpening();
    void close();
    /// Sets the editor's view, a section of the project that is stored with save().
    void setView(const nlohmann::json& view);
    /// The view in the project's file, as last read or saved; null: none.
    [[nodiscard]] const nlohmann::json& storedView() const { return view_in_file_; }
    /// What save() does if another program has changed the file since it was read or written here.
    enum class OnConflict { Ask, Overwrite };
    /// Saves the project in the background, with the plan if it is current. Errors arrive as
    /// notices; with Ask, a file changed by another program arrives with takeChangedFile(), and an
    /// up-to-date file is not written again.
    void save(const std::filesystem::path& path, OnConflict on_conflict);
    /// The file that save() did not overwrite because another program has changed it, once.
    [[nodiscard]] std::optional<std::filesystem::path> takeChangedFile() {
        return std::exchange(changed_file_, std::nullopt);
    }
    /// The project in its current state, with the plan if it is current.
    [[nodiscard]] ProjectFile snapshot(bool with_plan = true) const;

    // Changing the project; each change is one undo step and starts planning
    /// Applies one operation (engine/document/operation.h). Consecutive operations with the same
    /// merge key form one undo step. The error message is for the user.
    Status apply(const nlohmann::json& operation, const std::string& merge_key = {});
    /// Applies several operations, all or none, as one undo step with this name.
    Status applyAll(const nlohmann::json& operations, const std::string& name);
    /// Sets the parameters, given as JSON sections of fields; `name` is the step's name. Does
    /// nothing while the scene is imported again.
    void setParameters(const nlohmann::json& parameters, const std::string& name,
                       const std::string& merge_key);
    /// Replaces parameters and edits, as one undo step with this name; the import settings stay.
    void setState(ProjectState state, const std::string& name);
    void endMerge() { stack_.endMerge(); }
    void undo();
    void redo();
    void goTo(std::size_t step);
    /// See CommandStack::rewind().
    void rewind(CommandStack::History earlier);

    /// Takes finished background results. To be called every frame.
    void poll();

    // Reading
    [[nodiscard]] bool isOpen() const { return opened_.has_value(); }
    [[nodiscard]] const std::filesystem::path& path()
        const;  // path of the project; empty: not saved yet
    [[nodiscard]] std::string title() const;
    [[nodiscard]] const std::filesystem::path& sceneFile() const { return opened_->scene_file; }
    /// The proposed import settings, if those in use seem wrong.
    [[nodiscard]] const ImportProposal& proposal() const {
        return keeps_import_ ? kNoProposal : importReport().proposal;
    }
    /// The import settings before the last step up to the current one that changed them; unset if
    /// none did.
    [[nodiscard]] std::optional<nlohmann::json> previousImport() const;
    [[nodiscard]] const nlohmann::json& importSettings() const { return opened_->import; }
    [[nodiscard]] const ImportReport& importReport() const { return opened_->imported->report; }
    /// The open scene as imported, without edits.
    [[nodiscard]] const Scene& importedScene() const { return *opened_->imported; }
    [[nodiscard]] const CommandStack& history() const { return stack_; }
    [[nodiscard]] const ProjectState& state() const { return *stack_.state(); }
    [[nodiscard]] bool unsaved() const { return isOpen() && !stack_.isSaved(); }
    /// The newest plan with its scene; may be older than state().
    [[nodiscard]] const PlanOutcome& shown() const { return shown_; }
    [[nodiscard]] bool planIsCurrent() const {
        return shown_.serial == serial_ && shown_.measured && !shown_.outdated &&
               shown_.state == stack_.state();
    }
    /// The light of the displayed scene, baked in the background.
    [[nodiscard]] const LightWorker& lighter() const { return lighter_; }
    /// Whether the scene is being imported with the settings of the current step.
    [[nodiscard]] bool isImporting() const { return stack_before_import_.has_value(); }
    void stopLight() { lighter_.stop(); }
    void startLight() { lighter_.start(); }
    /// Progress of opening a project, or of importing its scene again.
    [[nodiscard]] BackgroundWorker::State loading() const {
        const BackgroundWorker::State opening = loader_.state();
        return opening.busy ? opening : importer_.state();
    }
    [[nodiscard]] BackgroundWorker::State planning() const { return planner_.state(); }
    /// Ends planning for the newest edits; the previous plan stays on the screen.
    void stopPlanning();
    /// Whether planning was stopped before the newest edits had a plan.
    [[nodiscard]] bool planningStopped() const {
        return isOpen() && stopped_serial_ == serial_ && !planner_.state().busy && !planIsCurrent();
    }
    /// Plans the newest edits.
    void startPlanning() { replan(); }
    [[nodiscard]] bool saving() const { return saves_answered_ != save_serial_; }
    [[nodiscard]] bool lighting() const { return lighter_.state().busy; }
    /// Time from the last change to its trajectory, ms.
    [[nodiscard]] double lastLatency_ms() const { return latency_ms_; }

    /// A message to be shown until the user has read it.
    struct Notice {
        bool is_error = false;
        std::string title;
        std::string text;
        std::filesystem::path missing_scene_of = {};  // project without its scene; or empty
        bool restores = false;                        // that project is an autosave copy
    };
    [[nodiscard]] std::optional<Notice> takeNotice();
    /// Why the newest request gave no plan; empty if it did.
    [[nodiscard]] std::string planError() const;
    /// The autosave copy that the open project was restored from; empty: none.
    [[nodiscard]] const std::filesystem::path& restoredFrom() const { return restored_from_; }
    /// SHA-256 of the project file as last read or written here; empty: not saved yet.
    [[nodiscard]] std::string fileContent() const { return known_files_->contentOf(path()); }
    /// Whether another program has changed the project file since then, and the user has not
    /// dismissed that.
    [[nodiscard]] bool fileChanged() const { return isOpen() && file_watch_.changed(); }
    void dismissFileChange() { file_watch_.dismiss(); }
    /// What happened since the last call: a project was opened or closed, or the scene of the open
    /// one was imported again.
    enum class NewScene { None, Opened, ReadAgain };
    [[nodiscard]] NewScene takeNewScene() { return std::exchange(new_scene_, NewScene::None); }

  private:
    struct LoadOutcome {
        std::filesystem::path path;
        Result<OpenedProject> opened;
        bool restored = false;
        bool relocated = false;                    // the user chose another scene file
        std::filesystem::path missing_scene = {};  // path of a missing scene; empty: it exists
        Autosave::Origin origin = {};              // origin of restored work
        std::optional<CommandStack> stack = {};    // undo history, if it was stored
    };
    struct SaveOutcome {
        std::uint64_t serial = 0;
        std::uint64_t document = 0;
        std::filesystem::path path;
        CommandStack::State state;
        bool has_plan = false;
        Status status = {};
        bool changed_elsewhere = false;  // so nothing was written
        nlohmann::json view = {};        // the editor's view in the file, if it was written
        bool was_there = false;          // the file was up to date, so nothing was written
    };

    struct SaveOrder {
        SaveOutcome outcome;  // the parts known in advance
        ProjectFile file;
        std::shared_ptr<const Scene> scene;
        std::shared_ptr<const Plan> plan;  // null: the file gets no plan
        bool asks = false;                 // do not overwrite changes by other programs
        bool nothing_new = false;
    };

    /// Runs on the saver's thread and completes the order's outcome.
    static void write(SaveOrder& order, KnownFiles& known);
    void load(const std::filesystem::path& path,
              const std::optional<std::filesystem::path>& scene_instead, bool restored);
    [[nodiscard]] Status checkEditable() const;
    void replan();
    void replaceHistory(CommandStack stack);
    void setImport(nlohmann::json import, const std::string& name);
    void abandonImport();
    void finishImport(ImportWorker::Outcome outcome);
    void showNothing();
    void logImport() const;
    void install(OpenedProject opened, CommandStack stack);
    static void takeHistory(LoadOutcome& outcome);
    void startLoading(LoadOutcome outcome, std::function<Result<ProjectContent>()> read);
    void finishOpening(LoadOutcome outcome);
    void finishSaving(SaveOutcome outcome);
    void updateLight();
    [[nodiscard]] bool isWanted(const PlanOutcome& outcome) const;
    void take(PlanOutcome outcome);

    static inline const ImportProposal kNoProposal;

    std::function<void()> wake_;
    std::optional<OpenedProject> opened_;
    CommandStack stack_;
    std::uint64_t document_ = 0;  // increases with every opened project
    std::uint64_t save_serial_ = 0;
    std::uint64_t saves_answered_ = 0;
    std::filesystem::path restored_from_;
    // While the scene is imported with the settings of the current step: the history before, whose
    // settings are those of the open scene.
    std::optional<CommandStack> stack_before_import_;
    bool keeps_import_ = false;  // see keepImport()
    bool file_has_plan_ = false;
    nlohmann::json view_in_file_;
    std::optional<std::filesystem::path> changed_file_;
    std::shared_ptr<KnownFiles> known_files_ = std::make_shared<KnownFiles>();
    FileWatch file_watch_;
    CommandStack::State state_when_asked_;  // state when opening another project was requested
    PlanOutcome shown_;
    std::uint64_t serial_ = 0;
    std::uint64_t first_serial_ = 0;    // first serial of this project
    std::uint64_t stopped_serial_ = 0;  // of the request that was stopped
    std::chrono::steady_clock::time_point changed_at_;
    double latency_ms_ = 0.0;
    std::vector<Notice> notices_;
    NewScene new_scene_ = NewScene::None;
    std::shared_ptr<LatestValue<LoadOutcome>> loaded_ =
        std::make_shared<LatestValue<LoadOutcome>>();
    std::shared_ptr<ConcurrentQueue<SaveOrder>> save_orders_ =
        std::make_shared<ConcurrentQueue<SaveOrder>>();
    std::shared_ptr<ConcurrentQueue<SaveOutcome>> saved_ =
        std::make_shared<ConcurrentQueue<SaveOutcome>>();
    BackgroundWorker loader_;
    ImportWorker importer_;
    BackgroundWorker saver_;
    LightWorker lighter_;
    LivePlanner planner_;
};

}  // namespace dollytrack::editor
