#pragma once

#include "app/batch/job_result.h"
#include "engine/jobs/job.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace dollytrack::batch {

struct RunSettings {
    std::filesystem::path program;  // ourselves
    std::string version;
    std::filesystem::path folder;  // of the batch
    int parallel = 1;              // jobs at a time
    int threads = 1;               // of each
    double timeout_s = 0.0;        // of each; 0: none
    std::uint64_t memory_mb = 0;   // likewise
};

/// The file of the running program, which does the jobs. Error: Failed.
[[nodiscard]] Result<std::filesystem::path> ownProgram();

/// What is to be done for a job, from what its folder holds.
struct Standing {
    enum class Step { Nothing, GoOn, Begin };
    Step step = Step::Begin;
    JobResult found;
    SceneStamp scene;  // as it is now
    std::string why;   // of beginning anew, where something was there
};

/// Error: BadInput when the scene cannot be read.
[[nodiscard]] Result<Standing> standingOf(const Job& job, const RunSettings& settings);

/// The command that does a job.
[[nodiscard]] std::vector<std::string> commandOf(const Job& job, const RunSettings& settings,
                                                 bool resumes);

/// Does what is not done yet, each job by a child process, so that none of them can stop the others
/// by crashing, hanging or taking all memory. Results come in the order of the jobs, and are kept
/// in their folders as soon as each ends. Cancelled: what runs is stopped in a way that it can be
/// continued, and the rest is left. What another batch is at is looked at once more at the end, and
/// is Busy when it is still at it.
[[nodiscard]] std::vector<JobResult> runJobs(const std::vector<Job>& jobs,
                                             const RunSettings& settings, const JobContext& job);

}  // namespace dollytrack::batch
