#pragma once

#include "app/batch/job.h"
#include "engine/core/result.h"
#include "engine/io/files/guarded_folder.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack::batch {

enum class JobState {
    NotRun,       // not yet, or with other settings
    Begun,        // a run that nobody saw the end of
    Done,         // complete, whatever is required of it
    Failed,       // it said why
    Crashed,      // ended by a signal of its own
    TimedOut,     // stopped for taking too long
    Interrupted,  // stopped with the batch
    Busy,         // another batch is at it
};

/// "done", "timed out": as reports and result.json say it.
[[nodiscard]] const char* name(JobState state);

/// A dataset that a job wrote.
struct WrittenDataset {
    std::string folder;  // from the job's folder on
    int frames = 0;
    std::string unusable;  // which pictures are dark, white or flat; empty if none is
};

/// Tells whether a job's files are still those that were used: its scene, for a project also that
/// one's scene, and its table of labels. Not what the scene file names (textures, models).
struct SceneStamp {
    std::uint64_t size = 0;       // of all together
    std::int64_t changed_ns = 0;  // summed up; spares hashing files that nobody touched
    std::string sha256;
    bool operator==(const SceneStamp&) const = default;
};

/// The job's stamp, without reading its files where sizes and times are those of `known`. Error:
/// BadInput.
[[nodiscard]] Result<SceneStamp> stampOf(const Job& job, const SceneStamp& known);

/// What is known of a job: kept in its folder, so that any machine can go on from there.
struct JobResult {
    JobState state = JobState::NotRun;
    int exit_code = 0;
    int signal = 0;
    std::string message;  // what went wrong
    double seconds = 0.0;
    std::uint64_t peak_bytes = 0;
    SceneStamp scene;
    std::string command;                                                // "export" or "plan", and
    std::vector<std::string> arguments;                                 // what it ran with
    std::string version;                                                // of the program
    nlohmann::ordered_json metrics = nlohmann::ordered_json::object();  // numbers by name
    std::vector<WrittenDataset> datasets;
    bool ran_now = false;  // in this run of the batch; not kept
};

/// Whether the result is of the job as it is asked for now, but for its scene's content.
[[nodiscard]] bool isOf(const JobResult& result, const Job& job);

/// Reads result.json of a job's folder; a fresh one where there is none, or it is damaged.
[[nodiscard]] JobResult readResult(const std::filesystem::path& folder);
/// The result in a batch's folder, where it is of the job as it is asked for now; else a fresh one.
[[nodiscard]] JobResult resultOf(const Job& job, const std::filesystem::path& batch_folder);
[[nodiscard]] Status writeResult(const io::GuardedFolder& folder, const JobResult& result);

/// Takes the numbers and folders over from what the program printed with --json.
void readOutput(const std::filesystem::path& output, const std::filesystem::path& folder,
                JobResult& result);

}  // namespace dollytrack::batch
