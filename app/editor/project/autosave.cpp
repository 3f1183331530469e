#include "app/editor/project/autosave.h"

#include "app/editor/files/folder_entries.h"
#include "app/editor/files/local_time.h"
#include "app/editor/shell/settings.h"
#include "engine/core/log.h"
#include "engine/document/history_json.h"

#include <algorithm>
#include <exception>
#include <optional>
#include <utility>

namespace dollytrack::editor {
namespace {

constexpr const char* kSection = "autosave";

std::filesystem::path folder() {
    return stateFolder() / "autosave";
}

std::vector<RecoveredWork> findRecoveredWork() {
    std::vector<std::pair<std::filesystem::file_time_type, RecoveredWork>> found;
    for (const auto& entry : entriesOf(folder())) {
        if (entry.path().extension() != ".dolly" ||
            OwnerMark::isHeld(folder(), entry.path().stem().string())) {
            continue;
        }
        const Result<ProjectFile> file = loadProject(entry.path());
        if (!file) continue;
        RecoveredWork work;
        work.file = entry.path();
        nlohmann::json others = file->others;
        work.project = Autosave::takeOrigin(others).project;
        work.scene = file->scene.string();
        std::error_code ignored;
        const auto written = std::filesystem::last_write_time(entry.path(), ignored);
        work.when = localTime(written);
        found.emplace_back(written, std::move(work));
    }
    OwnerMark::tidy(folder());
    std::ranges::sort(found, [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<RecoveredWork> recovered;
    for (auto& [written, work] : found) recovered.push_back(std::move(work));
    return recovered;
}

}  // namespace

Autosave::Autosave(std::function<void()> wake)
    : mark_(std::make_shared<OwnerMark>(folder())),
      file_(folder() / (mark_->text() + ".dolly")),
      finder_(std::move(wake)) {}

Autosave::~Autosave() {
    writer_.finish();
}

void Autosave::hearOfCopies() {
    const std::optional<Written> news = written_->take();
    if (!news) return;
    if (news->status) {
        if (std::exchange(failing_, false))
            log::info("autosave", "backup copies are written again");
        if (restored_from_ == news->replaced) restored_from_.clear();
    } else if (!std::exchange(failing_, true)) {
        // Reported once, since a full disk stays full for a while.
        log::warn("autosave",
                  "the unsaved work cannot be backed up: " + describe(news->status.error()) +
                      " The next attempts follow every " + std::to_string(kRetry.count()) + " s.");
    }
}

bool Autosave::isDue(const CommandStack::State& state) {
    hearOfCopies();
    if (writer_.state().busy || (stored_ == state && !failing_)) return false;
    return std::chrono::steady_clock::now() - last_ >= (failing_ ? kRetry : kInterval);
}

void Autosave::store(const CommandStack::History& history, ProjectFile snapshot,
                     const Origin& origin) {
    last_ = std::chrono::steady_clock::now();
    stored_ = history.steps[history.position].state;
    ++count_;
    snapshot.result = nullptr;  // omitted: it can be planned again, and the copy stays small
    snapshot.others[kSection] = {{"project", origin.project.string()},
                                 {"project_sha256", origin.sha256}};
    writer_.start([snapshot = std::move(snapshot), history, file = file_, old = restored_from_,
                   mark = mark_, latest = written_](const JobContext&) {
        std::error_code ignored;
        std::filesystem::create_directories(file.parent_path(), ignored);
        mark->hold();
        Status status;
        try {
            ProjectFile whole = snapshot;
            whole.others[kSection]["history"] = historyJson(history);
            status = saveProject(whole, file);
        } catch (const std::exception& failure) {
            status = fail(ErrorCode::Failed, failure.what(), file.string());
        }
        if (status && !old.empty()) std::filesystem::remove(old, ignored);
        latest->put({old, status});
    });
}

void Autosave::discard() {
    if (!stored_ && restored_from_.empty()) return;
    stored_.reset();
    failing_ = false;
    // Queued after a copy that is being written.
    writer_.start([file = file_, old = std::exchange(restored_from_, {})](const JobContext&) {
        std::error_code ignored;
        std::filesystem::remove(file, ignored);
        if (!old.empty()) std::filesystem::remove(old, ignored);
    });
}

void Autosave::searchForRecoveredWork() {
    finder_.start([latest = found_](const JobContext&) { latest->put(findRecoveredWork()); });
}

std::vector<RecoveredWork> Autosave::takeRecoveredWork() {
    return found_->take().value_or(std::vector<RecoveredWork>());
}

void Autosave::forget(const RecoveredWork& work) {
    std::error_code ignored;
    std::filesystem::remove(work.file, ignored);
}

Autosave::Origin Autosave::takeOrigin(nlohmann::json& others) {
    if (!others.is_object() || !others.contains(kSection)) return {};
    nlohmann::json notes = others[kSection];
    others.erase(kSection);
    const auto text = [&](const char* name) {
        const bool there = notes.is_object() && notes.contains(name) && notes[name].is_string();
        return there ? notes[name].get<std::string>() : std::string();
    };
    Origin origin{text("project"), text("project_sha256")};
    if (notes.is_object() && notes.contains("history")) origin.history = notes["history"];
    return origin;
}

}  // namespace dollytrack::editor
