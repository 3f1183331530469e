#pragma once

#include "render/dataset/folder/dataset_journal.h"

#include <memory>
#include <vector>

namespace dollytrack::render {

/// Collects the results of each frame of a dataset. A frame is finished when its files are written
/// and its captures counted, which two threads report; then it is entered in the journal.
class FrameLedger {
  public:
    /// `restored` frames count as finished and are in the journal already.
    FrameLedger(DatasetJournal journal, int frame_count, std::map<int, JournalEntry> restored = {});
    ~FrameLedger();
    FrameLedger(FrameLedger&&) noexcept;
    FrameLedger& operator=(FrameLedger&&) noexcept;

    /// Each is called once per frame, from any thread. Returns an error if the journal cannot be
    /// written.
    [[nodiscard]] Status addWritten(int index, std::map<std::string, std::string> sha256s,
                                    std::vector<ObjectMask> masks,
                                    std::vector<InstanceInFrame> instances);
    [[nodiscard]] Status addCounted(int index, std::vector<ObjectView> views,
                                    std::vector<int> well_shown,
                                    std::optional<PictureQuality> quality);

    /// Number of finished frames whose files still exist in the folder.
    [[nodiscard]] int finishedCount(const GuardedFolder& folder) const;
    [[nodiscard]] Status sync();

    /// Moves a frame's entry out of the ledger.
    [[nodiscard]] JournalEntry take(int index);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace dollytrack::render
