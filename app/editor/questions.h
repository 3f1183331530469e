#pragma once

#include "app/editor/export/export_queue.h"
#include "app/editor/project/autosave.h"
#include "app/editor/project/workspace.h"
#include "ui/widgets/fields/number_input.h"

#include <nlohmann/json_fwd.hpp>

#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack::editor {

/// Modal messages that wait for an answer, one at a time, and the actions that follow.
class Questions {
  public:
    /// Functions of the window that are called after the user's answers.
    struct Callbacks {
        std::function<void()> save;     // the save command
        std::function<void()> save_as;  // asks for a file
        std::function<void(const RecoveredWork&)> restore;
        std::function<void(const std::filesystem::path& project, bool restores)> find_scene;
        std::function<int()> unfinished_exports;
        std::function<void(const std::vector<int>& jobs)> continue_exports;
        std::function<void(const std::vector<int>& jobs)> forget_exports;
    };

    Questions(Workspace& workspace, Callbacks callbacks);

    /// Shows a message with an OK button.
    void tell(Workspace::Notice notice);
    /// Asks what to do with each autosave copy.
    void offer(std::vector<RecoveredWork> recovered);
    /// Runs `then` when there is no unsaved work, or the user discards it. `what_next` names the
    /// reason: "before you leave".
    void afterUnsaved(std::function<void()> then, const std::string& what_next);
    /// Runs `then` when no exports are running or waiting, or the user agrees to stop them.
    void afterExports(std::function<void()> then);
    /// Asks whether to resume exports that ended with an earlier editor.
    void offerExports(std::vector<ExportQueue::Found> found);
    /// A confirmation or choice.
    struct Confirmation {
        struct Answer {
            std::string label;
            std::function<void()> then;
        };
        std::string title;
        std::string text;
        std::vector<Answer> answers;  // in addition to Cancel
        bool enter_cancels = true;    // false: Enter takes the first answer (harmless)
        struct Number {
            std::shared_ptr<std::string> text;  // of a number field; null: there is none
            ui::NumberLimits limits;
            std::string label;  // beside the field
        } number = {};
    };
    void ask(Confirmation confirmation) { confirmation_ = std::move(confirmation); }
    /// Drops the question about the previous project's file.
    void forgetProject() { changed_file_.clear(); }

    /// Whether a message is open, which then receives the keys.
    [[nodiscard]] bool waiting() const;
    /// Draws the current message; to be called every frame. Messages wait while a file is being
    /// chosen.
    void draw(bool choosing_file);
    /// Adds the current question to the state for Inspector.
    void addTo(nlohmann::json& state) const;

  private:
    enum class Kind {
        None,
        RecoveredWork,
        ChangedFile,
        Unsaved,
        Exports,
        FoundExports,
        Confirmation,
        Notice
    };
    [[nodiscard]] bool pending(Kind kind) const;
    void answerUnsaved(bool choosing_file);
    [[nodiscard]] std::string unsavedQuestion() const;
    void drawRecoveredWork();
    void drawChangedFile();
    void drawUnsaved();
    void drawExports();
    void drawFoundExports();
    void drawConfirmation();
    void drawNotice();

    Workspace& workspace_;
    Callbacks callbacks_;
    Kind shown_ = Kind::None;
    std::deque<Workspace::Notice> notices_;
    std::vector<RecoveredWork> recovered_;
    std::filesystem::path changed_file_;  // changed by another program: overwrite it?
    std::function<void()> after_unsaved_;
    std::string what_next_;
    bool saving_ = false;  // saving was chosen as answer; after_unsaved_ waits for it
    std::function<void()> after_exports_;
    std::vector<ExportQueue::Found> found_exports_;
    std::optional<Confirmation> confirmation_;
    int stopped_exports_ = 0;  // number of exports mentioned in the question
};

}  // namespace dollytrack::editor
