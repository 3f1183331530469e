#include "app/editor/export/export_queue.h"

#include "app/editor/export/export_folders.h"
#include "app/editor/export/export_program.h"
#include "app/editor/export/export_progress.h"
#include "app/process/child_process.h"
#include "engine/core/log.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <exception>
#include <functional>
#include <utility>

namespace dollytrack::editor {
namespace {

using Clock = std::chrono::steady_clock;
namespace fs = std::filesystem;

constexpr auto kLook = std::chrono::milliseconds(50);
// Time for the program to finish its current frame after a stop request.
constexpr auto kGracePeriod = std::chrono::seconds(10);
constexpr auto kPatienceAtExit = std::chrono::seconds(2);
// Minimum time between two updates of a note.
constexpr auto kNoteInterval = std::chrono::seconds(2);

}  // namespace

ExportQueue::ExportQueue(fs::path snapshot_folder, fs::path program,
                         std::function<void()> on_change)
    : snapshot_folder_(std::move(snapshot_folder)),
      program_(std::move(program)),
      on_change_(std::move(on_change)),
      mark_(snapshot_folder_),
      thread_([this] { loop(); }) {}

ExportQueue::~ExportQueue() {
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
    }
    something_to_do_.notify_all();
    thread_.join();
    // Unfinished jobs can be resumed by the next editor.
    for (Entry& entry : entries_) {
        if (entry.job.state == ui::ExportState::Done || !entry.stored) {
            removeFiles(entry);
            continue;
        }
        const bool waits = entry.job.state == ui::ExportState::Waiting;
        if (waits) entry.end = ExportEnd::EditorLeft;
        if (waits || entry.note_due) keepNote(entry.job.id);
    }
}

void ExportQueue::removeFiles(const Entry& entry) const {
    std::error_code ignored;
    if (entry.ownsSnapshot()) fs::remove(entry.project_file, ignored);
    fs::remove(exportFile(snapshot_folder_, mark_.text(), entry.job.id, ".json"), ignored);
}

ExportNote ExportQueue::Entry::noteOf() const {
    return {job.request, project_file, ownsSnapshot(), job.frames_done, job.frames, end};
}

int ExportQueue::add(ui::ExportRequest request, std::shared_ptr<const ProjectFile> project) {
    Entry entry;
    entry.job.request = std::move(request);
    entry.project = std::move(project);
    return addEntry(std::move(entry));
}

int ExportQueue::addFile(ui::ExportRequest request, fs::path project_file) {
    Entry entry;
    entry.job.request = std::move(request);
    entry.project_file = std::move(project_file);
    return addEntry(std::move(entry));
}

int ExportQueue::addEntry(Entry entry) {
    int id = 0;
    {
        const std::lock_guard lock(mutex_);
        id = ++last_id_;
        entry.job.id = id;
        entry.job.frames = entry.job.request.frames;
        if (entry.project != nullptr) {
            entry.project_file = exportFile(snapshot_folder_, mark_.text(), id, ".dolly");
        }
        entries_.push_back(std::move(entry));
    }
    something_to_do_.notify_all();
    return id;
}

void ExportQueue::hold(bool held) {
    {
        const std::lock_guard lock(mutex_);
        held_ = held;
    }
    something_to_do_.notify_all();
}

bool ExportQueue::held() const {
    const std::lock_guard lock(mutex_);
    return held_;
}

void ExportQueue::cancel(int id) {
    update(id, [](Entry& entry) {
        if (entry.job.state == ui::ExportState::Waiting) {
            entry.job.state = ui::ExportState::Cancelled;
            entry.end = ExportEnd::Settled;
            entry.note_due = true;
        } else if (entry.job.active()) {
            entry.cancel_asked = true;
            entry.job.state = ui::ExportState::Stopping;
        }
    });
    something_to_do_.notify_all();
}

void ExportQueue::resume(int id) {
    update(id, [](Entry& entry) {
        ui::ExportJob& job = entry.job;
        if (job.state != ui::ExportState::Cancelled && job.state != ui::ExportState::Failed) return;
        // A job without finished frames starts as originally requested.
        job.resumes = job.frames_done > 0;
        job.state = ui::ExportState::Waiting;
        job.error = {};
        job.last_words.clear();
        entry.cancel_asked = false;
        entry.end = ExportEnd::EditorDied;
        entry.note_due = true;
    });
    something_to_do_.notify_all();
}

void ExportQueue::remove(int id) {
    {
        const std::lock_guard lock(mutex_);
        Entry* entry = find(id);
        if (entry == nullptr) return;
        if (entry->job.active()) {
            entry->cancel_asked = true;
            entry->remove_asked = true;
            entry->job.state = ui::ExportState::Stopping;
            return;
        }
        removeFiles(*entry);
        entries_.remove_if([&](const Entry& one) { return one.job.id == id; });
    }
    changed();
}

void ExportQueue::move(int id, int by) {
    const std::lock_guard lock(mutex_);
    const auto at =
        std::ranges::find(entries_, id, [](const Entry& entry) { return entry.job.id; });
    if (at == entries_.end()) return;
    if (by < 0 && at != entries_.begin()) entries_.splice(std::prev(at), entries_, at);
    if (by > 0 && std::next(at) != entries_.end()) entries_.splice(at, entries_, std::next(at));
}

std::vector<ui::ExportJob> ExportQueue::jobs() const {
    const std::lock_guard lock(mutex_);
    std::vector<ui::ExportJob> jobs;
    for (const Entry& entry : entries_) jobs.push_back(entry.job);
    return jobs;
}

std::vector<ExportQueue::Found> ExportQueue::takeFound() {
    const std::lock_guard lock(mutex_);
    return std::exchange(found_, {});
}

bool ExportQueue::busy() const {
    const std::lock_guard lock(mutex_);
    return std::ranges::any_of(entries_, [](const Entry& entry) { return entry.job.active(); });
}

int ExportQueue::unfinished() const {
    const std::lock_guard lock(mutex_);
    return static_cast<int>(std::ranges::count_if(entries_, [](const Entry& entry) {
        return entry.job.active() || entry.job.state == ui::ExportState::Waiting;
    }));
}

ExportQueue::Entry* ExportQueue::find(int id) {
    const auto at =
        std::ranges::find(entries_, id, [](const Entry& entry) { return entry.job.id; });
    return at == entries_.end() ? nullptr : &*at;
}

ExportQueue::Entry* ExportQueue::nextWaiting() {
    if (held_) return nullptr;
    const auto at = std::ranges::find(entries_, ui::ExportState::Waiting,
                                      [](const Entry& entry) { return entry.job.state; });
    return at == entries_.end() ? nullptr : &*at;
}

void ExportQueue::changed() const {
    if (on_change_) on_change_();
}

void ExportQueue::update(int id, const std::function<void(Entry&)>& change) {
    {
        const std::lock_guard lock(mutex_);
        if (Entry* entry = find(id)) change(*entry);
    }
    changed();
}

/// Starts all programs on this thread, which lives as long as the queue: the system ends a child
/// process when the thread that started it ends.
void ExportQueue::loop() {
    try {
        adoptLeftJobs();
    } catch (const std::exception& e) {
        log::warn("export", std::string("Unfinished exports cannot be searched for: ") + e.what());
    }
    while (true) {
        storeNewJobs();
        int id = 0;
        {
            std::unique_lock lock(mutex_);
            something_to_do_.wait(lock, [this] {
                return stopping_ || nextWaiting() != nullptr ||
                       std::ranges::any_of(entries_, &Entry::noteDue);
            });
            if (stopping_) return;
            if (nextWaiting() == nullptr) continue;
            ui::ExportJob& job = nextWaiting()->job;
            job.state = ui::ExportState::Running;
            job.stage = "starting";
            job.fraction = 0.0;
            job.reported_end = false;
            id = job.id;
        }
        changed();
        try {
            runEntry(id);
        } catch (const std::exception& e) {
            failEntry(id, {ErrorCode::Failed, e.what(), {}});
        }
        bool gone = false;
        update(id, [&](Entry& entry) { gone = entry.remove_asked; });
        keepNote(id);
        if (gone) remove(id);
    }
}

/// Takes over the jobs of editors that no longer run.
void ExportQueue::adoptLeftJobs() {
    const FolderLock alone(snapshot_folder_);
    for (const fs::path& left : findLeftNotes(snapshot_folder_)) {
        mark_.hold();
        Entry entry;
        {
            const std::lock_guard lock(mutex_);
            entry.job.id = ++last_id_;
        }
        const Result<ExportNote> note =
            takeOverNote(left, snapshot_folder_, mark_.text(), entry.job.id);
        if (!note) {
            log::warn("export", describe(note.error()));
            continue;
        }
        entry.project_file = note->project_file;
        entry.adopted_snapshot = note->snapshot;
        entry.snapshot_written = true;
        entry.stored = true;
        entry.job.request = note->request;
        entry.job.state = ui::ExportState::Cancelled;
        entry.job.frames_done = note->frames_done;
        entry.job.frames = note->frames;
        entry.end = note->end;
        {
            const std::lock_guard lock(mutex_);
            // Jobs that the user cancelled, or whose failure was reported, are not announced again.
            if (entry.end != ExportEnd::Settled) {
                found_.push_back({entry.job, entry.end == ExportEnd::EditorDied});
            }
            entries_.push_back(std::move(entry));
        }
    }
    OwnerMark::tidy(snapshot_folder_);
    changed();
}

/// Writes snapshots and notes of new jobs, so that waiting jobs survive a crash. Write errors are
/// reported when the job starts.
void ExportQueue::storeNewJobs() {
    while (true) {
        int id = 0;
        {
            const std::lock_guard lock(mutex_);
            const auto at = std::ranges::find_if(entries_, &Entry::noteDue);
            if (at == entries_.end()) return;
            at->stored = true;
            at->note_due = false;
            id = at->job.id;
        }
        // Errors here must not affect a running job.
        try {
            mark_.hold();
            if (writeSnapshot(id)) keepNote(id);
        } catch (const std::exception& e) {
            log::debug("export", std::string("An export cannot be saved for later: ") + e.what());
        }
    }
}

void ExportQueue::keepNote(int id) {
    try {
        writeOrRemoveNote(id);
    } catch (const std::exception& e) {
        log::debug("export", std::string("An export cannot be recorded for later: ") + e.what());
    }
}

void ExportQueue::writeOrRemoveNote(int id) {
    noted_at_ = Clock::now();
    ExportNote note;
    bool done = false;
    {
        const std::lock_guard lock(mutex_);
        const Entry* entry = find(id);
        if (entry == nullptr) return;
        note = entry->noteOf();
        done = entry->job.state == ui::ExportState::Done;
    }
    const fs::path file = exportFile(snapshot_folder_, mark_.text(), id, ".json");
    std::error_code ignored;
    if (done) {
        fs::remove(file, ignored);
    } else if (const Status written = writeNote(file, note); !written) {
        log::debug("export", describe(written.error()));
    }
    removeIfGone(id, file);
}

/// Removes a file that was written while its job was removed.
void ExportQueue::removeIfGone(int id, const fs::path& file) {
    const std::lock_guard lock(mutex_);
    std::error_code ignored;
    if (find(id) == nullptr) fs::remove(file, ignored);
}

Status ExportQueue::writeSnapshot(int id) {
    std::shared_ptr<const ProjectFile> project;
    fs::path file;
    // Uses the entry's flag rather than the disk, where a file of that name could belong to another
    // program.
    update(id, [&](Entry& entry) {
        if (!entry.snapshot_written) project = entry.project;
        file = entry.project_file;
    });
    if (project == nullptr) return {};
    std::error_code error;
    fs::create_directories(file.parent_path(), error);
    if (error) {
        return fail(ErrorCode::CannotWrite,
                    "The folder for snapshots cannot be created: " + error.message() + ".",
                    file.parent_path().string());
    }
    if (Status saved = saveProject(*project, file); !saved) return saved;
    removeIfGone(id, file);
    update(id, [](Entry& entry) { entry.snapshot_written = true; });
    return {};
}

void ExportQueue::failEntry(int id, const Error& error) {
    update(id, [&](Entry& entry) {
        entry.end = ExportEnd::Settled;
        entry.job.state = ui::ExportState::Failed;
        entry.job.error = error;
    });
}

void ExportQueue::runEntry(int id) {
    const auto failed = [&](const Error& error) { failEntry(id, error); };
    if (const Status written = writeSnapshot(id); !written) return failed(written.error());
    std::vector<std::string> command;
    update(id,
           [&](Entry& entry) { command = exportCommand(program_, entry.project_file, entry.job); });
    Result<ChildProcess> process = ChildProcess::start(command);
    if (!process) return failed(process.error());
    follow(id, *process);
}

void ExportQueue::follow(int id, ChildProcess& process) {
    LineSplitter lines;
    std::optional<Clock::time_point> asked_at;
    bool closing = false;
    const auto listen = [&](std::chrono::milliseconds wait) {
        const std::string text = process.read(wait);
        if (text.empty()) return false;
        lines.add(text);
        update(id, [&](Entry& entry) {
            for (std::string line; lines.take(line);) readProgressLine(line, entry.job);
        });
        return true;
    };
    int noted = 0;
    while (!process.end()) {
        listen(kLook);
        storeNewJobs();
        int done = 0;
        {
            const std::lock_guard lock(mutex_);
            done = find(id)->job.frames_done;
        }
        if (done != noted && (noted == 0 || Clock::now() - noted_at_ > kNoteInterval)) {
            noted = done;
            keepNote(id);
        }
        bool stop = false;
        {
            const std::lock_guard lock(mutex_);
            closing = stopping_;
            stop = closing || find(id)->cancel_asked;
        }
        if (stop && !asked_at) {
            asked_at = Clock::now();
            process.send(SIGTERM);
        }
        if (asked_at && Clock::now() - *asked_at > (closing ? kPatienceAtExit : kGracePeriod)) {
            process.send(SIGKILL);
        }
    }
    // Reads the last output; bounded, because processes left behind might write forever.
    for (int i = 0; i < 100 && listen(std::chrono::milliseconds(0)); ++i) {
    }
    fs::path folder;
    update(id, [&](Entry& entry) { folder = entry.job.request.folder; });
    std::error_code error;
    const bool dataset =
        fs::exists(folder / "dataset.json", error) || fs::exists(folder / "rooms.json", error);
    const fs::path sheet = contactSheetIn(folder);
    update(id, [&](Entry& entry) {
        readProgressLine(lines.rest(), entry.job);
        concludeJob({*process.end(), asked_at.has_value(), dataset}, entry.job);
        const bool by_leaving = closing && !entry.cancel_asked;
        entry.end = by_leaving ? ExportEnd::EditorLeft : ExportEnd::Settled;
        if (entry.job.state == ui::ExportState::Done && !sheet.empty()) {
            entry.job.contact_sheet = sheet;
        }
    });
}

}  // namespace dollytrack::editor
