#include "render/pipeline/frame_ledger.h"

#include <algorithm>
#include <mutex>
#include <utility>

namespace dollytrack::render {
namespace {

struct Row {
    JournalEntry entry;
    bool written = false;
    bool counted = false;
    bool finished = false;
};

}  // namespace

struct FrameLedger::Impl {
    DatasetJournal journal;
    std::vector<Row> rows;
    mutable std::mutex mutex;

    Impl(DatasetJournal to, int frame_count)
        : journal(std::move(to)), rows(static_cast<std::size_t>(frame_count)) {}

    [[nodiscard]] Row& row(int index) { return rows[index]; }

    Status finishIfComplete(Row& row) {
        if (!row.written || !row.counted) return {};
        if (Status status = journal.append(row.entry); !status) return status;
        row.finished = true;
        return {};
    }
};

FrameLedger::FrameLedger(DatasetJournal journal, int frame_count,
                         std::map<int, JournalEntry> restored)
    : impl_(std::make_unique<Impl>(std::move(journal), frame_count)) {
    for (int i = 0; i < frame_count; ++i) impl_->row(i).entry.index = i;
    for (auto& [index, entry] : restored) {
        impl_->row(index) = {std::move(entry), true, true, true};
    }
}
FrameLedger::~FrameLedger() = default;
FrameLedger::FrameLedger(FrameLedger&&) noexcept = default;
FrameLedger& FrameLedger::operator=(FrameLedger&&) noexcept = default;

Status FrameLedger::addWritten(int index, std::map<std::string, std::string> sha256s,
                               std::vector<ObjectMask> masks,
                               std::vector<InstanceInFrame> instances) {
    const std::lock_guard lock(impl_->mutex);
    Row& row = impl_->row(index);
    row.entry.sha256s = std::move(sha256s);
    row.entry.masks = std::move(masks);
    row.entry.instances = std::move(instances);
    row.written = true;
    return impl_->finishIfComplete(row);
}

Status FrameLedger::addCounted(int index, std::vector<ObjectView> views,
                               std::vector<int> well_shown, std::optional<PictureQuality> quality) {
    const std::lock_guard lock(impl_->mutex);
    Row& row = impl_->row(index);
    row.entry.views = std::move(views);
    row.entry.well_shown = std::move(well_shown);
    row.entry.quality = quality;
    row.counted = true;
    return impl_->finishIfComplete(row);
}

int FrameLedger::finishedCount(const GuardedFolder& folder) const {
    const std::lock_guard lock(impl_->mutex);
    const auto isThere = [&](const auto& file) { return folder.has(file.first); };
    return static_cast<int>(std::ranges::count_if(impl_->rows, [&](const Row& row) {
        return row.finished && std::ranges::all_of(row.entry.sha256s, isThere);
    }));
}

Status FrameLedger::sync() {
    const std::lock_guard lock(impl_->mutex);
    return impl_->journal.sync();
}

JournalEntry FrameLedger::take(int index) {
    const std::lock_guard lock(impl_->mutex);
    return std::move(impl_->row(index).entry);
}

}  // namespace dollytrack::render
