#include "app/editor/questions.h"

#include "ui/widgets/message_box.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <utility>

namespace dollytrack::editor {
namespace {

std::string datasetName(const ui::ExportJob& job) {
    const std::filesystem::path& folder = job.request.folder;
    return (folder.has_filename() ? folder : folder.parent_path()).filename().string();
}

std::string titleOf(const std::vector<ExportQueue::Found>& found) {
    return found.size() == 1
               ? fmt::format("The dataset {} is not finished", datasetName(found.front().job))
               : fmt::format("{} datasets are not finished", found.size());
}

/// One line per export: how it ended, and the number of finished frames.
std::string textOf(const std::vector<ExportQueue::Found>& found) {
    constexpr std::size_t kMostNamed = 6;
    std::string text;
    for (std::size_t i = 0; i < std::min(found.size(), kMostNamed); ++i) {
        const auto& [job, editor_died] = found[i];
        text += fmt::format(
            "{}: {}{}.\n", job.request.folder.string(),
            editor_died ? "the editor ended during the export"
                        : "leaving the editor stopped its export",
            job.frames > 0 ? fmt::format(", {} of {} frames are done", job.frames_done, job.frames)
                           : std::string());
    }
    if (found.size() > kMostNamed) {
        text += fmt::format("{} more are in the queue.\n", found.size() - kMostNamed);
    }
    return text + "Finished frames are kept; the rest is in the export queue.";
}

}  // namespace

Questions::Questions(Workspace& workspace, Callbacks callbacks)
    : workspace_(workspace), callbacks_(std::move(callbacks)) {}

void Questions::tell(Workspace::Notice notice) {
    // An error that occurs for every image is shown once.
    const auto same = [&](const Workspace::Notice& waiting) {
        return waiting.title == notice.title && waiting.text == notice.text;
    };
    if (std::ranges::none_of(notices_, same)) notices_.push_back(std::move(notice));
}

void Questions::offer(std::vector<RecoveredWork> recovered) {
    recovered_ = std::move(recovered);
}

void Questions::offerExports(std::vector<ExportQueue::Found> found) {
    found_exports_ = std::move(found);
}

void Questions::afterUnsaved(std::function<void()> then, const std::string& what_next) {
    if (!workspace_.unsaved()) return then();
    after_unsaved_ = std::move(then);
    what_next_ = what_next;
}

void Questions::afterExports(std::function<void()> then) {
    stopped_exports_ = callbacks_.unfinished_exports();
    if (stopped_exports_ == 0) return then();
    after_exports_ = std::move(then);
}

bool Questions::waiting() const {
    return !notices_.empty() || !recovered_.empty() || !changed_file_.empty() || after_unsaved_ ||
           after_exports_ || !found_exports_.empty() || confirmation_;
}

bool Questions::pending(Kind kind) const {
    switch (kind) {
        case Kind::None:
            return false;
        case Kind::RecoveredWork:
            return !recovered_.empty();
        case Kind::ChangedFile:
            return !changed_file_.empty();
        case Kind::Unsaved:
            return after_unsaved_ && !saving_;
        case Kind::Exports:
            return after_exports_ != nullptr;
        case Kind::FoundExports:
            return !found_exports_.empty();
        case Kind::Confirmation:
            return confirmation_.has_value();
        case Kind::Notice:
            return !notices_.empty();
    }
    return false;
}

void Questions::draw(bool choosing_file) {
    while (auto notice = workspace_.takeNotice()) notices_.push_back(std::move(*notice));
    if (auto file = workspace_.takeChangedFile()) changed_file_ = std::move(*file);
    answerUnsaved(choosing_file);
    if (choosing_file) return;
    // A message stays until it is answered.
    if (!pending(shown_)) {
        shown_ = Kind::None;
        // Consequences of user actions come before messages from start-up.
        for (const Kind kind : {Kind::ChangedFile, Kind::Unsaved, Kind::Exports, Kind::Confirmation,
                                Kind::Notice, Kind::RecoveredWork, Kind::FoundExports}) {
            if (shown_ == Kind::None && pending(kind)) shown_ = kind;
        }
    }
    switch (shown_) {
        case Kind::RecoveredWork:
            return drawRecoveredWork();
        case Kind::ChangedFile:
            return drawChangedFile();
        case Kind::Unsaved:
            return drawUnsaved();
        case Kind::Exports:
            return drawExports();
        case Kind::FoundExports:
            return drawFoundExports();
        case Kind::Confirmation:
            return drawConfirmation();
        case Kind::Notice:
            return drawNotice();
        case Kind::None:
            break;
    }
}

void Questions::answerUnsaved(bool choosing_file) {
    // Waits until saving has finished or was cancelled.
    if (!saving_ || workspace_.saving() || choosing_file || !changed_file_.empty()) return;
    saving_ = false;
    const std::function<void()> then = std::exchange(after_unsaved_, nullptr);
    if (then && !workspace_.unsaved()) then();
}

void Questions::drawRecoveredWork() {
    const RecoveredWork work = recovered_.front();
    ui::MessageBox box;
    box.title = "Unsaved work was found";
    box.text = fmt::format(
        "The editor ended without saving {}.\nThe last backup copy is from {}.",
        work.project.empty() ? "a project of " + work.scene : work.project.string(), work.when);
    box.buttons = {"Restore", "Delete the copy", "Later"};
    const int pressed = ui::drawMessageBox(box);
    if (pressed < 0) return;
    if (pressed == 0) {
        recovered_.clear();  // one per start; the others are offered again next time
        return callbacks_.restore(work);
    }
    if (pressed == 1) Autosave::forget(work);
    recovered_.erase(recovered_.begin());
}

void Questions::drawChangedFile() {
    ui::MessageBox box;
    box.title = changed_file_.filename().string() + " was changed by another program";
    box.text = changed_file_.string() +
               ": Reload loses your changes, Overwrite loses the other program's.";
    // Enter presses the first button, which loses nothing.
    box.buttons = {"Save as…", "Reload", "Overwrite", "Cancel"};
    const int pressed = ui::drawMessageBox(box);
    if (pressed < 0) return;
    const std::filesystem::path file = std::exchange(changed_file_, {});
    if (pressed == 0) callbacks_.save_as();
    if (pressed == 1) workspace_.open(file);
    if (pressed == 2) workspace_.save(file, Workspace::OnConflict::Overwrite);
}

std::string Questions::unsavedQuestion() const {
    const std::filesystem::path& project = workspace_.path();
    if (!project.empty())
        return fmt::format("Save the changes to {}?", project.filename().string());
    return fmt::format("Save the plan of {} as a project?",
                       workspace_.sceneFile().filename().string());
}

void Questions::drawUnsaved() {
    switch (ui::askUnsaved(unsavedQuestion(), what_next_)) {
        case ui::UnsavedAnswer::Save:
            saving_ = true;
            callbacks_.save();
            break;
        case ui::UnsavedAnswer::Discard: {
            const std::function<void()> then = std::exchange(after_unsaved_, nullptr);
            then();
            break;
        }
        case ui::UnsavedAnswer::Cancel:
            after_unsaved_ = nullptr;
            break;
        case ui::UnsavedAnswer::None:
            break;
    }
}

void Questions::drawExports() {
    ui::MessageBox box;
    box.title = stopped_exports_ == 1
                    ? "An export is not finished"
                    : fmt::format("{} exports are not finished", stopped_exports_);
    box.text = fmt::format(
        "Leaving stops {} after the current frame. Finished frames are kept, and the editor offers "
        "to resume at its next start.",
        stopped_exports_ == 1 ? "it" : "them");
    box.buttons = {"Keep exporting", "Stop and quit"};
    box.escape = 0;
    const int pressed = ui::drawMessageBox(box);
    if (pressed < 0) return;
    const std::function<void()> then = std::exchange(after_exports_, nullptr);
    if (pressed == 1) then();
}

void Questions::drawFoundExports() {
    ui::MessageBox box;
    box.title = titleOf(found_exports_);
    box.text = textOf(found_exports_);
    box.buttons = {"Continue", "Later", "Remove from the queue"};
    box.escape = 1;
    const int pressed = ui::drawMessageBox(box);
    if (pressed < 0) return;
    std::vector<int> jobs;
    for (const ExportQueue::Found& found : found_exports_) jobs.push_back(found.job.id);
    found_exports_.clear();
    if (pressed == 0) callbacks_.continue_exports(jobs);
    if (pressed == 2) callbacks_.forget_exports(jobs);
}

void Questions::drawConfirmation() {
    ui::MessageBox box;
    box.title = confirmation_->title;
    box.text = confirmation_->text;
    // Enter presses the first button.
    box.buttons.clear();
    if (confirmation_->enter_cancels) box.buttons.emplace_back("Cancel");
    for (const Confirmation::Answer& answer : confirmation_->answers)
        box.buttons.push_back(answer.label);
    if (!confirmation_->enter_cancels) box.buttons.emplace_back("Cancel");
    if (const auto& number = confirmation_->number; number.text) {
        box.field = [&number] {
            return ui::typedNumberField(*number.text, number.limits, "message.number",
                                        number.label);
        };
    }
    const int first = confirmation_->enter_cancels ? 1 : 0;
    const int last = first + static_cast<int>(confirmation_->answers.size());
    box.escape = confirmation_->enter_cancels ? 0 : last;
    const int pressed = ui::drawMessageBox(box);
    if (pressed < 0) return;
    const Confirmation answered = *std::exchange(confirmation_, std::nullopt);
    if (pressed >= first && pressed < last) {
        answered.answers[pressed - first].then();
    }
}

void Questions::drawNotice() {
    ui::MessageBox box;
    const Workspace::Notice& notice = notices_.front();
    box.is_error = notice.is_error;
    box.title = notice.title;
    box.text = notice.text;
    const bool locate = !notice.missing_scene_of.empty();
    if (locate) box.buttons = {"Find the scene…", "Cancel"};
    const int pressed = ui::drawMessageBox(box);
    if (pressed < 0) return;
    const Workspace::Notice read = std::move(notices_.front());
    notices_.pop_front();
    if (locate && pressed == 0) callbacks_.find_scene(read.missing_scene_of, read.restores);
}

void Questions::addTo(nlohmann::json& state) const {
    state["question"] = after_unsaved_ ? unsavedQuestion() + " " + what_next_ : std::string();
    state["notice"] =
        notices_.empty() ? std::string() : notices_.front().title + ": " + notices_.front().text;
    nlohmann::json& dialogs = state["dialogs"];
    dialogs["unsaved"] = pending(Kind::Unsaved);
    dialogs["recovered_work"] = pending(Kind::RecoveredWork);
    dialogs["changed_file"] = pending(Kind::ChangedFile);
    dialogs["exports"] = pending(Kind::Exports);
    dialogs["found_exports"] = pending(Kind::FoundExports);
    dialogs["confirmation"] = pending(Kind::Confirmation);
    state["asked"] = pending(Kind::Confirmation) ? confirmation_->title + ": " + confirmation_->text
                     : pending(Kind::FoundExports)
                         ? titleOf(found_exports_) + ": " + textOf(found_exports_)
                         : std::string();
}

}  // namespace dollytrack::editor
