#pragma once

#include "render/dataset/dataset_journal.h"

#include <memory>
#include <vector>

namespace dollytrack::render {

/// What is known of each frame of a dataset. A frame is finished when its files are written and its
/// captures counted, which two threads report; then it goes into the journal.
class FrameLedger {
  public:
    /// `restored` frames count as finished; the journal has them already.
    FrameLedger(DatasetJournal journal, int frame_count, std::map<int, JournalEntry> restored = {});
    ~FrameLedger();
    FrameLedger(FrameLedger&&) noexcept;
    FrameLedger& operator=(FrameLedger&&) noexcept;

    /// These two from any thread, once a frame each.
    [[nodiscard]] Status addWritten(int index, std::map<std::string, std::string> sha256s,
                                    std::vector<ObjectMask> masks,
                                    std::vector<InstanceInFrame> instances);
    [[nodiscard]] Status addCounted(int index, std::vector<ObjectView> views,
                                    std::vector<int> well_shown,
                                    std::optional<PictureQuality> quality);

    /// Finished frames whose files are still in the folder.
    [[nodiscard]] int finishedCount(const io::GuardedFolder& folder) const;
    [[nodiscard]] Status sync();

    /// Hands out what is known of a frame; the ledger keeps no copy.
    [[nodiscard]] JournalEntry take(int index);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace dollytrack::render
