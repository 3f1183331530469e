#pragma once

#include "engine/jobs/job.h"
#include "render/dataset/dataset_folder.h"
#include "render/dataset/dataset_journal.h"
#include "render/dataset/dataset_order.h"

#include <map>
#include <optional>
#include <set>
#include <string>

namespace dollytrack::render {

/// What dataset.json says was counted.
struct Counted {
    CaptureMetrics captures;
    PictureTally pictures;
};

/// What an export that is to be continued finds in its folder.
struct Earlier {
    JournalContents journal;          // entries only of frames whose files are whole
    std::optional<Counted> complete;  // the complete dataset is there
};

/// Looks for a dataset to continue; reads each of its files. Errors: Usage when it is of something
/// else, saying what differs; BadInput when a complete one misses a file or has a damaged one;
/// Cancelled.
[[nodiscard]] Result<Earlier> findEarlier(const DatasetFolder& folder, const DatasetOrder& order,
                                          const DatasetIdentity& identity, const JobContext& job);

/// The relative paths of the frames' files.
[[nodiscard]] std::set<std::string> filesOf(const std::map<int, JournalEntry>& entries);

}  // namespace dollytrack::render
