#pragma once

#include "app/batch/job.h"
#include "engine/core/result.h"
#include "engine/io/files/guarded_folder.h"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace dollytrack::batch {

/// What jobs.json in a batch's folder says, so that any machine can put the results together.
struct BatchList {
    std::vector<Job> jobs;
    std::vector<std::string> require;
};

/// The folder of a batch, which holds a folder for each job. Made if missing, and marked as ours
/// by jobs.json; several machines may do so at once for parts of one batch. Error: CannotWrite,
/// also for a folder of other files.
[[nodiscard]] Status claimBatchFolder(const std::filesystem::path& folder, const BatchList& list);

/// The list in a batch's folder. Error: BadInput.
[[nodiscard]] Result<BatchList> readBatchList(const std::filesystem::path& folder);

/// The right to work on a job: of several batches on one folder only one has it. File systems
/// without locks give it to all; there, the export's own checks are what is left.
class JobLock {
  public:
    /// Makes the job's folder, which is called `job`, in that of its batch. Error: CannotWrite.
    [[nodiscard]] static Result<JobLock> take(const io::GuardedFolder& batch,
                                              const std::string& job);

    [[nodiscard]] const io::GuardedFolder& folder() const { return folder_; }

    [[nodiscard]] bool isOurs() const { return ours_; }

  private:
    JobLock(io::GuardedFolder folder, io::FileDescriptor file)
        : folder_(std::move(folder)), file_(std::move(file)) {}

    io::GuardedFolder folder_;
    io::FileDescriptor file_;
    bool ours_ = false;
};

}  // namespace dollytrack::batch
