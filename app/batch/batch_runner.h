#pragma once

#include "app/batch/job_result.h"
#include "engine/jobs/job.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace dollytrack::batch {

struct RunSettings {
    std::filesystem::path program;  // path of this program
    std::string version;
    std::filesystem::path folder;  // folder of the batch
    int parallel = 1;              // number of concurrent jobs
    int threads = 1;               // threads per job
    double timeout_s = 0.0;        // time limit per job; 0: none
    std::uint64_t memory_mb = 0;   // memory limit per job, MB; 0: none
};

/// Path of the running program, which is started again for each job. Error: Failed if it cannot be
/// found.
[[nodiscard]] Result<std::filesystem::path> ownProgram();

/// What remains to be done for a job, according to its folder.
struct ResumeState {
    enum class Action { None, Resume, Start };
    Action action = Action::Start;
    JobResult found;
    SceneStamp scene;  // current stamp of the scene
    std::string why;   // why existing results cannot be used; empty if there are none
};

/// Compares the job's folder with the job's settings, scene stamp and program version. Error:
/// BadInput if the scene cannot be read.
[[nodiscard]] Result<ResumeState> resumeStateOf(const Job& job, const RunSettings& settings);

/// The command line that runs a job.
[[nodiscard]] std::vector<std::string> commandOf(const Job& job, const RunSettings& settings,
                                                 bool resumes);

/// Runs the unfinished jobs, each in a child process, so that a crash, hang or memory exhaustion
/// affects only that job. The results are in the order of the jobs; each is written to its job's
/// folder as soon as the job ends. On cancellation, running jobs are stopped such that they can be
/// resumed, and the rest is not started. Jobs that another batch process holds are tried again at
/// the end, and are Busy if it still holds them.
[[nodiscard]] std::vector<JobResult> runJobs(const std::vector<Job>& jobs,
                                             const RunSettings& settings, const JobContext& job);

}  // namespace dollytrack::batch
