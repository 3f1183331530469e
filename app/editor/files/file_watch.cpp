#include "app/editor/files/file_watch.h"

#include <system_error>
#include <utility>

namespace dollytrack::editor {

FileWatch::FileWatch(std::shared_ptr<const KnownFiles> known, std::function<void()> wake)
    : known_(std::move(known)), wake_(std::move(wake)) {}

void FileWatch::beginAnew() {
    ++round_;
    stamp_.reset();
    changed_ = false;
    dismissed_ = false;
}

void FileWatch::look(const std::filesystem::path& file) {
    if (const std::optional<Seen> seen = seen_->take(); seen && seen->round == round_) {
        // A further change is reported again.
        if (stamp_ && !(*stamp_ == seen->stamp)) dismissed_ = false;
        stamp_ = seen->stamp;
        changed_ = seen->changed;
    }
    const auto now = std::chrono::steady_clock::now();
    if (file.empty() || worker_.state().busy || now - last_look_ < kInterval) return;
    last_look_ = now;
    worker_.start([file, known = known_, round = round_, before = stamp_, was_changed = changed_,
                   latest = seen_, wake = wake_](const JobContext&) {
        std::error_code error;
        Stamp stamp;
        stamp.written = std::filesystem::last_write_time(file, error);
        if (!error) stamp.bytes = std::filesystem::file_size(file, error);
        if (error) return;  // missing, or being replaced
        const bool same = before && *before == stamp;
        const bool changed = same ? was_changed : known->changedElsewhere(file);
        latest->put({round, stamp, changed});
        if (changed && !same) wake();  // otherwise the window can keep sleeping
    });
}

}  // namespace dollytrack::editor
