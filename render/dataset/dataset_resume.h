#pragma once

#include "engine/jobs/job.h"
#include "render/dataset/dataset_order.h"
#include "render/dataset/folder/dataset_folder.h"
#include "render/dataset/folder/dataset_journal.h"

#include <map>
#include <optional>
#include <set>
#include <string>

namespace dollytrack::render {

/// Results recorded in a complete dataset's dataset.json.
struct RecordedResults {
    CaptureMetrics captures;
    PictureTally pictures;
};

/// State of the folder in which an export is to be resumed.
struct EarlierExport {
    JournalContents journal;                  // only entries of frames whose files are intact
    std::optional<RecordedResults> complete;  // set if the dataset is complete already
};

/// Looks for a dataset to resume, verifying the hash of each file. Returns Usage, naming the
/// differences, if the folder holds another dataset; BadInput if a complete dataset has missing or
/// damaged files; Cancelled.
[[nodiscard]] Result<EarlierExport> findEarlierExport(const DatasetFolder& folder,
                                                      const DatasetOrder& order,
                                                      const DatasetIdentity& identity,
                                                      const JobContext& job);

/// Relative paths of the frames' files.
[[nodiscard]] std::set<std::string> filesOf(const std::map<int, JournalEntry>& entries);

}  // namespace dollytrack::render
