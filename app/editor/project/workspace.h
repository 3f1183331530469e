#pragma once

#include "app/editor/project/autosave.h"
#include "app/editor/project/file_watch.h"
#include "app/editor/project/known_files.h"
#include "app/editor/project/live_planner.h"
#include "app/editor/project/project_loader.h"
#include "engine/document/command_stack.h"
#include "engine/io/settings/project_file.h"
#include "engine/jobs/background_worker.h"
#include "engine/scene/light_params.h"
#include "render/light/light_volume.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dollytrack::editor {

/// The open project and everything computed from it: what a person decided (with undo), the scene,
/// the newest plan, the light. Knows no window. All calls come from one thread and return at once;
/// the work is done in the background and arrives with poll().
class Workspace {
  public:
    explicit Workspace(std::function<void()> wake);
    ~Workspace();

    // Opening and saving
    /// Reads a scene or a project; what is open stays until that has succeeded.
    void open(const std::filesystem::path& path,
              const std::optional<std::filesystem::path>& scene_instead = std::nullopt);
    /// Opens a copy that Autosave kept, as unsaved work of the project it came from.
    void restore(const std::filesystem::path& copy,
                 const std::optional<std::filesystem::path>& scene_instead = std::nullopt);
    /// Reads the scene of the open project again with these import settings (a project's section
    /// `import`). Parameters, edits and steps of undo stay; what is open stays until it is read.
    void readAgain(const nlohmann::json& import);
    /// The same as the scene's own proposal has it, and back.
    void applyProposal();
    void takeBackImport();
    void cancelOpening() { loader_.cancel(); }
    void close();
    /// Where another program has written the file since it was read or written here.
    enum class IfChanged { Ask, Overwrite };
    /// Writes the project, with the plan if it is up to date. An error arrives as a notice, a
    /// question with takeChangedFile(). With Ask, a file that has all of it is left as it is.
    void save(const std::filesystem::path& path, IfChanged if_changed);
    /// The file that was not saved because another program has changed it.
    [[nodiscard]] std::optional<std::filesystem::path> takeChangedFile() {
        return std::exchange(changed_file_, std::nullopt);
    }
    /// The project as it is now, as one would save it, with the plan if it is up to date.
    [[nodiscard]] io::ProjectFile snapshot(bool with_plan = true) const;

    // Changing; each change is one step of undo and starts planning
    /// Applies one operation (engine/document/operation.h). Operations with the same merge key in
    /// a row are one step. Errors are the user's to read.
    Status apply(const nlohmann::json& operation, const std::string& merge_key = {});
    /// Applies a list of them, all or none, as one step of that name.
    Status applyAll(const nlohmann::json& operations, const std::string& name);
    /// Parameters as sections of fields; `name` is what the step is called.
    void setParameters(const nlohmann::json& parameters, const std::string& name,
                       const std::string& merge_key);
    void endMerge() { stack_.endMerge(); }
    void undo();
    void redo();
    void goTo(std::size_t step);

    /// Collects what the background has finished. Once a frame.
    void poll();

    // Reading
    [[nodiscard]] bool isOpen() const { return opened_.has_value(); }
    [[nodiscard]] const std::filesystem::path& path()
        const;  // of the project; empty: not saved yet
    [[nodiscard]] std::string title() const;
    [[nodiscard]] const std::filesystem::path& sceneFile() const { return opened_->scene_file; }
    /// How the scene should likely be read instead, as the command line says it.
    [[nodiscard]] const ImportProposal& proposal() const { return importReport().proposal; }
    /// The import settings before readAgain(); none where the scene was not read again.
    [[nodiscard]] const std::optional<nlohmann::json>& importBefore() const {
        return import_before_;
    }
    [[nodiscard]] const nlohmann::json& importSettings() const { return opened_->import; }
    [[nodiscard]] const ImportReport& importReport() const { return opened_->imported->report; }
    [[nodiscard]] const CommandStack& history() const { return stack_; }
    [[nodiscard]] const ProjectState& state() const { return *stack_.state(); }
    [[nodiscard]] bool unsaved() const { return isOpen() && !stack_.isSaved(); }
    /// The newest plan with the scene it belongs to; may be older than state().
    [[nodiscard]] const PlanOutcome& shown() const { return shown_; }
    [[nodiscard]] bool planIsCurrent() const {
        return shown_.serial == serial_ && shown_.measured && !shown_.outdated &&
               shown_.state == stack_.state();
    }
    [[nodiscard]] std::shared_ptr<const render::LightVolume> light() const { return light_; }
    [[nodiscard]] BackgroundWorker::State loading() const { return loader_.state(); }
    [[nodiscard]] BackgroundWorker::State planning() const { return planner_.state(); }
    [[nodiscard]] bool saving() const { return saves_answered_ != save_serial_; }
    [[nodiscard]] bool lighting() const { return lighter_.state().busy; }
    /// From the last change to its trajectory being there, ms.
    [[nodiscard]] double lastLatency_ms() const { return latency_ms_; }

    /// A message for the user, to be shown in the window until it is read.
    struct Notice {
        bool is_error = false;
        std::string title;
        std::string text;
        std::filesystem::path missing_scene_of = {};  // a project whose scene has to be found
        bool restores = false;                        // it is a copy of lost work
    };
    [[nodiscard]] std::optional<Notice> takeNotice();
    /// Why the newest request gave no plan; empty when it did.
    [[nodiscard]] std::string planError() const;
    /// The copy from which the open project was restored; empty: it was not.
    [[nodiscard]] const std::filesystem::path& restoredFrom() const { return restored_from_; }
    /// SHA-256 of the project's file as this editor knows it; empty: not saved yet.
    [[nodiscard]] std::string fileContent() const { return known_files_->contentOf(path()); }
    /// Whether another program has changed the project's file since it was read or written here,
    /// and the user has not put that aside.
    [[nodiscard]] bool fileChanged() const { return isOpen() && file_watch_.changed(); }
    void dismissFileChange() { file_watch_.dismiss(); }
    /// Whether a new project was opened since the last call.
    [[nodiscard]] bool takeOpened() { return std::exchange(newly_opened_, false); }

  private:
    struct LoadOutcome {
        std::filesystem::path path;
        Result<OpenedProject> opened;
        bool restored = false;
        bool relocated = false;                    // its scene was found elsewhere
        std::filesystem::path missing_scene = {};  // where it should be; empty: it is there
        Autosave::Origin origin = {};              // of what is restored
        std::optional<CommandStack::History> history = {};  // the same; none: it was not kept
        std::optional<nlohmann::json> import_before = {};   // of a scene that is read again
    };
    struct SaveOutcome {
        std::uint64_t serial = 0;
        std::uint64_t document = 0;
        std::filesystem::path path;
        CommandStack::State state;
        bool has_plan = false;
        Status status = {};
        bool changed_elsewhere = false;  // so it was not written
        bool was_there = false;          // all of it, so it was not written
    };

    struct SaveOrder {
        SaveOutcome outcome;  // what is known before
        io::ProjectFile file;
        std::shared_ptr<const Scene> scene;
        std::shared_ptr<const Plan> plan;  // null: none goes into the file
        bool asks = false;                 // before it replaces what another program wrote
        bool nothing_new = false;
    };

    /// On the saver's thread; its outcome gets the rest.
    static void write(SaveOrder& order, KnownFiles& known);
    void load(const std::filesystem::path& path,
              const std::optional<std::filesystem::path>& scene_instead, bool restored);
    [[nodiscard]] Status checkEditable() const;
    void replan();
    void install(OpenedProject opened, std::optional<CommandStack::History> history);
    static void takeHistory(LoadOutcome& outcome);
    void startLoading(LoadOutcome outcome, std::function<Result<ProjectContent>()> read);
    void finishReadingAgain(LoadOutcome outcome);
    void finishOpening(LoadOutcome outcome);
    void finishSaving(SaveOutcome outcome);
    void updateLight();
    [[nodiscard]] bool isWanted(const PlanOutcome& outcome) const;
    void take(PlanOutcome outcome);

    std::function<void()> wake_;
    std::optional<OpenedProject> opened_;
    CommandStack stack_;
    std::uint64_t document_ = 0;  // rises with every project that is opened
    std::uint64_t save_serial_ = 0;
    std::uint64_t saves_answered_ = 0;
    std::filesystem::path restored_from_;
    std::optional<nlohmann::json> import_before_;
    bool file_has_plan_ = false;
    std::optional<std::filesystem::path> changed_file_;
    std::shared_ptr<KnownFiles> known_files_ = std::make_shared<KnownFiles>();
    FileWatch file_watch_;
    CommandStack::State state_when_asked_;  // to open another
    PlanOutcome shown_;
    std::uint64_t serial_ = 0;
    std::uint64_t first_serial_ = 0;  // of this document: earlier plans are of another
    std::chrono::steady_clock::time_point changed_at_;
    double latency_ms_ = 0.0;
    std::shared_ptr<const render::LightVolume> light_;
    std::uint64_t lit_geometry_ = 0;
    std::vector<Eigen::AlignedBox3d> lit_rooms_;
    LightParams lit_params_;
    int light_number_ = 0;
    bool has_their_light_ = false;  // of these rooms, of that geometry, of these parameters
    std::vector<Notice> notices_;
    bool newly_opened_ = false;
    std::shared_ptr<Outbox<LoadOutcome>> loaded_ = std::make_shared<Outbox<LoadOutcome>>();
    std::shared_ptr<Tray<SaveOrder>> save_orders_ = std::make_shared<Tray<SaveOrder>>();
    std::shared_ptr<Tray<SaveOutcome>> saved_ = std::make_shared<Tray<SaveOutcome>>();
    struct Lit {
        int number = 0;  // of the order, see updateLight()
        render::LightVolume light;
    };
    std::shared_ptr<Outbox<Lit>> lit_ = std::make_shared<Outbox<Lit>>();
    BackgroundWorker loader_;
    BackgroundWorker saver_;
    BackgroundWorker lighter_;
    LivePlanner planner_;
};

}  // namespace dollytrack::editor
