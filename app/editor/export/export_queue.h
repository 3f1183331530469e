#pragma once

#include "app/editor/export/export_note.h"
#include "app/editor/export/owner_mark.h"
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

/// Exports one dataset after another, each by a `dollytrack export` of its own on a snapshot of the
/// project, so that the bytes are those of the command line and a crash costs no more than that
/// run. All functions return at once, but the destructor, which stops what runs.
class ExportQueue {
  public:
    /// Snapshots and notes are kept in `snapshot_folder` until their job is done or removed. Jobs
    /// that an editor left there which no longer runs join the queue as cancelled ones. `on_change`
    /// is called from a thread of the queue when there is news.
    ExportQueue(std::filesystem::path snapshot_folder, std::filesystem::path program,
                std::function<void()> on_change = {});
    ~ExportQueue();
    ExportQueue(const ExportQueue&) = delete;
    ExportQueue& operator=(const ExportQueue&) = delete;

    /// The project as it is now. Returns the job's number.
    int add(ui::ExportRequest request, std::shared_ptr<const io::ProjectFile> project);
    /// A project file as it will be when its turn comes.
    int addFile(ui::ExportRequest request, std::filesystem::path project_file);

    /// While held, what runs goes on and nothing new begins.
    void hold(bool held);
    [[nodiscard]] bool held() const;

    // Of the jobs by number; nothing happens where that makes no sense.
    void cancel(int id);
    /// Puts a cancelled or failed job back in the queue, to go on where it ended.
    void resume(int id);
    /// Also cancels it. The dataset stays as it is.
    void remove(int id);
    /// Earlier (-1) or later (1) in the queue.
    void move(int id, int by);

    [[nodiscard]] std::vector<ui::ExportJob> jobs() const;
    /// A job that another editor left because that editor ended.
    struct Found {
        ui::ExportJob job;
        bool editor_died = false;  // else it was stopped when that editor was left
    };
    /// Returns what was found, and forgets it: a second call returns nothing.
    [[nodiscard]] std::vector<Found> takeFound();
    [[nodiscard]] bool busy() const;
    /// How many run or wait.
    [[nodiscard]] int unfinished() const;

  private:
    struct Entry {
        ui::ExportJob job;
        std::shared_ptr<const io::ProjectFile> project;  // null: it is a file already
        std::filesystem::path project_file;
        bool snapshot_written = false;
        bool stored = false;                    // its note was written, or could not be
        bool note_due = false;                  // the note says what is no longer so
        bool adopted_snapshot = false;          // another editor wrote it
        ExportEnd end = ExportEnd::EditorDied;  // what its note says

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
    /// Nothing that happens to a job's note may end the job: what goes wrong is only logged.
    void keepNote(int id);
    void writeOrRemoveNote(int id);
    void removeIfGone(int id, const std::filesystem::path& file);
    void failEntry(int id, const Error& error);
    void removeFiles(const Entry& entry) const;
    void runEntry(int id);
    Status writeSnapshot(int id);
    void follow(int id, ChildProcess& process);
    /// Changes the job under the lock.
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
