#pragma once

#include "app/editor/export/export_note.h"
#include "app/editor/files/owner_mark.h"
#include "engine/core/result.h"
#include "engine/io/settings/project_file.h"
#include "ui/export_job.h"

#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

namespace dollytrack {
class ChildProcess;
}

namespace dollytrack::editor {

/// Runs exports one after another, each as a `dollytrack export` process on a snapshot of the
/// project, so that the output equals that of the command line and a crash ends only that run. All
/// functions return at once, except the destructor, which stops the running export.
class ExportQueue {
  public:
    /// Keeps snapshots and notes in `snapshot_folder` until their job is done or removed. Jobs left
    /// there by editors that no longer run are added as cancelled. The queue's thread calls
    /// `on_change` after each change.
    ExportQueue(std::filesystem::path snapshot_folder, std::filesystem::path program,
                std::function<void()> on_change = {});
    ~ExportQueue();
    ExportQueue(const ExportQueue&) = delete;
    ExportQueue& operator=(const ExportQueue&) = delete;

    /// Adds an export of the project's current state. Returns the job's id.
    int add(ui::ExportRequest request, std::shared_ptr<const ProjectFile> project);
    /// Adds an export of a project file, read when the job starts. Returns the job's id.
    int addFile(ui::ExportRequest request, std::filesystem::path project_file);

    /// While held, the running job continues and no other starts.
    void hold(bool held);
    [[nodiscard]] bool held() const;

    // The following take a job's id and ignore unknown ids and inapplicable states.
    void cancel(int id);
    /// Queues a cancelled or failed job again; it resumes if it had finished frames.
    void resume(int id);
    /// Removes a job, cancelling it if it runs. The dataset stays.
    void remove(int id);
    /// Moves a job earlier (-1) or later (1) in the queue.
    void move(int id, int by);

    [[nodiscard]] std::vector<ui::ExportJob> jobs() const;
    /// An unfinished job of an earlier editor.
    struct Found {
        ui::ExportJob job;
        bool editor_died = false;  // false: the editor was closed and stopped it
    };
    /// Returns the jobs found at start-up, once.
    [[nodiscard]] std::vector<Found> takeFound();
    [[nodiscard]] bool busy() const;
    /// Number of running and waiting jobs.
    [[nodiscard]] int unfinished() const;

  private:
    struct Entry {
        ui::ExportJob job;
        std::shared_ptr<const ProjectFile> project;  // null: the project is a file
        std::filesystem::path project_file;
        bool snapshot_written = false;
        bool stored = false;                    // its note was written, or writing failed
        bool note_due = false;                  // its note is outdated
        bool adopted_snapshot = false;          // the snapshot was written by another editor
        ExportEnd end = ExportEnd::EditorDied;  // recorded in the note: why it is unfinished

        [[nodiscard]] bool noteDue() const { return !stored || note_due; }
        [[nodiscard]] bool ownsSnapshot() const { return project != nullptr || adopted_snapshot; }
        [[nodiscard]] ExportNote noteOf() const;
        bool cancel_asked = false;
        bool remove_asked = false;
    };

    int addEntry(Entry entry);
    Entry* find(int id);
    Entry* nextWaiting();
    void changed() const;
    void loop();
    void adoptLeftJobs();
    void storeNewJobs();
    /// Writes or removes a job's note. Errors are only logged: they must not end the job.
    void keepNote(int id);
    void writeOrRemoveNote(int id);
    void removeIfGone(int id, const std::filesystem::path& file);
    void failEntry(int id, const Error& error);
    void removeFiles(const Entry& entry) const;
    void runEntry(int id);
    Status writeSnapshot(int id);
    void follow(int id, ChildProcess& process);
    /// Changes an entry under the lock.
    void update(int id, const std::function<void(Entry&)>& change);

    std::filesystem::path snapshot_folder_;
    std::filesystem::path program_;
    std::function<void()> on_change_;
    mutable std::mutex mutex_;
    std::condition_variable something_to_do_;
    OwnerMark mark_;
    std::chrono::steady_clock::time_point noted_at_;
    std::list<Entry> entries_;
    std::vector<Found> found_;
    int last_id_ = 0;
    bool held_ = false;
    bool stopping_ = false;
    std::thread thread_;
};

}  // namespace dollytrack::editor
