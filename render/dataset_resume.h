#pragma once

#include "engine/jobs/job.h"
#include "render/dataset_folder.h"
#include "render/dataset_journal.h"
#include "render/formats/dataset_card.h"

#include <map>
#include <set>
#include <string>

namespace dollytrack::render {

/// Those of the journal's frames whose files of all modalities are there and whole. Reads every
/// file. Fewer when cancelled.
[[nodiscard]] std::map<int, JournalEntry> wholeFrames(const DatasetFolder& folder,
                                                      std::map<int, JournalEntry> entries,
                                                      const ModalitySet& modalities,
                                                      const JobContext& job);

/// The relative paths of their files.
[[nodiscard]] std::set<std::string> filesOf(const std::map<int, JournalEntry>& entries);

/// Whether the complete dataset in the folder is the one wanted, as far as can be said before it is
/// rendered, and all its files are whole; what was counted then. Errors: Usage when it is another,
/// saying what differs; BadInput for a missing or damaged file.
[[nodiscard]] Result<CaptureMetrics> checkComplete(const DatasetFolder& folder,
                                                   const DatasetContents& wanted,
                                                   const DatasetCard& card, const JobContext& job);

}  // namespace dollytrack::render
