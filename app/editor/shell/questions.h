#pragma once

#include "app/editor/export/export_queue.h"
#include "app/editor/project/autosave.h"
#include "app/editor/project/workspace.h"

#include <nlohmann/json_fwd.hpp>

#include <deque>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack::editor {

/// Messages over the window that wait for an answer, one at a time, and what the answers lead to.
class Questions {
  public:
    /// Where answers lead that need more of the window than the workspace.
    struct Doors {
        std::function<void()> save;     // as the command does
        std::function<void()> save_as;  // asks for a file
        std::function<void(const LostWork&)> restore;
        std::function<void(const std::filesystem::path& project, bool restores)> find_scene;
        std::function<int()> unfinished_exports;
        std::function<void(const std::vector<int>& jobs)> continue_exports;
        std::function<void(const std::vector<int>& jobs)> forget_exports;
    };

    Questions(Workspace& workspace, Doors doors);

    /// A message that is read and put away.
    void tell(Workspace::Notice notice);
    /// Asks what shall become of each copy.
    void offer(std::vector<LostWork> lost);
    /// Does `then` once there is no unsaved work, or it may be lost. `what_next`: "before you
    /// leave".
    void afterUnsaved(std::function<void()> then, const std::string& what_next);
    /// The same for exports that would be stopped.
    void afterExports(std::function<void()> then);
    /// Asks whether to go on with exports that ended with an earlier editor.
    void offerExports(std::vector<ExportQueue::Found> found);
    /// Asks before something that may not be what was meant, or leaves a choice.
    struct Doubt {
        struct Answer {
            std::string label;
            std::function<void()> then;
        };
        std::string title;
        std::string text;
        std::vector<Answer> answers;  // beside cancelling
        bool enter_cancels = true;    // else it takes the first answer, which must harm nothing
    };
    void ask(Doubt doubt) { doubt_ = std::move(doubt); }
    /// Another project is open: what was asked about the one before no longer matters.
    void forgetProject() { changed_file_.clear(); }

    /// Whether something waits for an answer: keys belong to the message then.
    [[nodiscard]] bool waiting() const;
    /// Once a frame. Messages wait while a file is being chosen.
    void draw(bool choosing_file);
    /// What is asked now, for Inspector.
    void addTo(nlohmann::json& state) const;

  private:
    enum class Kind { None, LostWork, ChangedFile, Unsaved, Exports, FoundExports, Doubt, Notice };
    [[nodiscard]] bool pending(Kind kind) const;
    void answerUnsaved(bool choosing_file);
    void drawLostWork();
    void drawChangedFile();
    void drawUnsaved();
    void drawExports();
    void drawFoundExports();
    void drawDoubt();
    void drawNotice();

    Workspace& workspace_;
    Doors doors_;
    Kind shown_ = Kind::None;
    std::deque<Workspace::Notice> notices_;
    std::vector<LostWork> lost_;
    std::filesystem::path changed_file_;  // by another program: overwrite it?
    std::function<void()> after_unsaved_;
    std::string what_next_;
    bool saving_ = false;  // as answer to the question after_unsaved_ waits for
    std::function<void()> after_exports_;
    std::vector<ExportQueue::Found> found_exports_;
    std::optional<Doubt> doubt_;
    int stopped_exports_ = 0;  // of which after_exports_ is asked
};

}  // namespace dollytrack::editor
