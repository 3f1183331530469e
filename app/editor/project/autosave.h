#pragma once

#include "app/editor/export/owner_mark.h"
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

/// Work of an editor that ended without closing its project.
struct LostWork {
    std::filesystem::path file;     // the copy, itself a project
    std::filesystem::path project;  // where it was saved before; empty: never
    std::string scene;              // path of its scene file
    std::string when;               // local time, for people
};

/// Keeps a copy of unsaved work in the state folder, written whole in the background, so that a
/// crash costs at most the interval. Main thread only.
class Autosave {
  public:
    /// The project that a copy's work belongs to.
    struct Origin {
        std::filesystem::path project;  // empty: never saved
        std::string sha256;             // of that file when the work on it began
        nlohmann::json history = {};    // as history_json.h has it; null in copies that had none
    };

    /// `wake` is called when lost work was found.
    explicit Autosave(std::function<void()> wake);
    ~Autosave();

    /// Once a frame while there is unsaved work: whether it is time to hand over a copy of this
    /// state, because it is new or the last one could not be written.
    [[nodiscard]] bool isDue(const CommandStack::State& state);
    /// `origin` without its history, which is written from `history`.
    void store(const CommandStack::History& history, io::ProjectFile snapshot,
               const Origin& origin);
    /// Copies handed over so far.
    [[nodiscard]] int count() const { return count_; }
    /// Work is open that was restored from this copy (empty: other work): it goes when the first
    /// new one is written.
    void replaces(const std::filesystem::path& copy) { restored_from_ = copy; }
    /// The work is saved, or thrown away by its owner: the copy goes.
    void discard();

    /// Looks in the background for copies whose editor no longer runs.
    void lookForLostWork();
    [[nodiscard]] bool looking() const { return finder_.state().busy; }
    /// What was found, newest first; once.
    [[nodiscard]] std::vector<LostWork> takeLostWork();
    static void forget(const LostWork& work);
    /// Takes our notes out of a copy's other sections.
    [[nodiscard]] static Origin takeOrigin(nlohmann::json& others);

    static constexpr std::chrono::seconds kInterval{5};
    static constexpr std::chrono::seconds kRetry{10};  // after a copy that could not be written

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
    CommandStack::State stored_;  // what the copy holds, or will; null: there is none
    bool failing_ = false;        // the newest could not be written
    int count_ = 0;
    std::shared_ptr<Outbox<Written>> written_ = std::make_shared<Outbox<Written>>();
    std::shared_ptr<Outbox<std::vector<LostWork>>> found_ =
        std::make_shared<Outbox<std::vector<LostWork>>>();
    BackgroundWorker writer_;
    BackgroundWorker finder_;
};

}  // namespace dollytrack::editor
