#pragma once

#include "app/batch/job.h"
#include "engine/core/result.h"
#include "engine/io/files/guarded_folder.h"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace dollytrack::batch {

/// Content of jobs.json in a batch's folder, from which any machine can merge the results.
struct BatchList {
    std::vector<Job> jobs;
    std::vector<std::string> require;
};

/// Creates the folder of a batch if needed and writes jobs.json into it, which marks it as a batch
/// folder. Several machines may do so concurrently for shards of the same batch. Error:
/// CannotWrite, also if the folder contains files that are not of a batch.
[[nodiscard]] Status claimBatchFolder(const std::filesystem::path& folder, const BatchList& list);

/// Reads jobs.json. Error: BadInput if it is missing or damaged.
[[nodiscard]] Result<BatchList> readBatchList(const std::filesystem::path& folder);

/// An exclusive lock (flock) on a job's folder, so that only one of several batch processes runs
/// the job. On file systems without locks every process gets it; then only the export's own checks
/// prevent conflicts.
class JobLock {
  public:
    /// Creates the folder `job` within the batch's folder and tries to lock it without waiting;
    /// isOurs() tells whether it succeeded. Error: CannotWrite.
    [[nodiscard]] static Result<JobLock> take(const GuardedFolder& batch, const std::string& job);

    [[nodiscard]] const GuardedFolder& folder() const { return folder_; }

    [[nodiscard]] bool isOurs() const { return ours_; }

  private:
    JobLock(GuardedFolder folder, FileDescriptor file)
        : folder_(std::move(folder)), file_(std::move(file)) {}

    GuardedFolder folder_;
    FileDescriptor file_;
    bool ours_ = false;
};

}  // namespace dollytrack::batch
