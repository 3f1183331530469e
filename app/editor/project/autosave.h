#pragma once

#include "app/editor/files/owner_mark.h"
#include "engine/document/command_stack.h"
#include "engine/io/settings/project_file.h"
#include "engine/jobs/background_worker.h"

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace dollytrack::editor {

/// Unsaved work of an editor that ended unexpectedly.
struct RecoveredWork {
    std::filesystem::path file;     // the autosave copy, a project file
    std::filesystem::path project;  // the project's own file; empty: never saved
    std::string scene;              // path of its scene file
    std::string when;               // local time of the copy, for display
};

/// Writes copies of unsaved work to the state folder, atomically and in the background, so that a
/// crash loses at most the interval. Main thread only.
class Autosave {
  public:
    /// The project that a copy belongs to.
    struct Origin {
        std::filesystem::path project;  // empty: never saved
        std::string sha256;             // hash of that file when the work began
        nlohmann::json history = {};    // undo history (history_json.h); null in copies without one
    };

    /// `wake` is called when the search for lost work has ended.
    explicit Autosave(std::function<void()> wake);
    ~Autosave();

    /// To be called every frame while there is unsaved work. Returns whether a copy of this state
    /// is due: because the state is new, or because the last write failed.
    [[nodiscard]] bool isDue(const CommandStack::State& state);
    /// Starts writing a copy. `origin` needs no history; that is taken from `history`.
    void store(const CommandStack::History& history, ProjectFile snapshot, const Origin& origin);
    /// Number of copies started so far.
    [[nodiscard]] int count() const { return count_; }
    /// The open work was restored from this copy (empty: it was not), which is deleted when the
    /// first new copy is written.
    void replaces(const std::filesystem::path& copy) { restored_from_ = copy; }
    /// Deletes the copy, after saving or discarding the work.
    void discard();

    /// Searches in the background for copies of editors that no longer run.
    void searchForRecoveredWork();
    [[nodiscard]] bool searching() const { return finder_.state().busy; }
    /// The found work, newest first, once.
    [[nodiscard]] std::vector<RecoveredWork> takeRecoveredWork();
    static void forget(const RecoveredWork& work);
    /// Removes the autosave section from a copy's other sections and returns its content.
    [[nodiscard]] static Origin takeOrigin(nlohmann::json& others);

    static constexpr std::chrono::seconds kInterval{5};
    static constexpr std::chrono::seconds kRetry{10};  // after a failed write

  private:
    struct Written {
        std::filesystem::path replaced;
        Status status;
    };
    void hearOfCopies();

    std::shared_ptr<OwnerMark> mark_;
    std::filesystem::path file_;
    std::filesystem::path restored_from_;
    std::chrono::steady_clock::time_point last_;
    CommandStack::State stored_;  // the state in the copy, written or being written; null: none
    bool failing_ = false;        // the latest write failed and is repeated after kRetry
    int count_ = 0;
    std::shared_ptr<LatestValue<Written>> written_ = std::make_shared<LatestValue<Written>>();
    std::shared_ptr<LatestValue<std::vector<RecoveredWork>>> found_ =
        std::make_shared<LatestValue<std::vector<RecoveredWork>>>();
    BackgroundWorker writer_;
    BackgroundWorker finder_;
};

}  // namespace dollytrack::editor
