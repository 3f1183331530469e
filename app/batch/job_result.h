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
    NotRun,       // not run, or only with other settings
    Begun,        // started, without a recorded end
    Done,         // completed, whether or not it meets the requirements
    Failed,       // ended with an error message
    Crashed,      // ended by a signal that the batch did not send
    TimedOut,     // stopped for exceeding the time limit
    Interrupted,  // stopped because the batch was stopped
    Busy,         // another batch process holds it
};

/// The name in reports and result.json: "done", "timed out".
[[nodiscard]] const char* name(JobState state);

/// A dataset that a job wrote.
struct WrittenDataset {
    std::string folder;  // relative to the job's folder
    int frames = 0;
    std::string unusable;  // which images are dark, white or flat; empty if none are
};

/// Fingerprint of a job's input files: the scene, for a project also its scene file, and the label
/// table. Files referenced by the scene (textures, models) are not included.
struct SceneStamp {
    std::uint64_t size = 0;       // total bytes of the files
    std::int64_t changed_ns = 0;  // sum of the modification times
    std::string sha256;
    bool operator==(const SceneStamp&) const = default;
};

/// Computes the job's stamp. The files are not hashed if their size and times equal those of
/// `known`. Error: BadInput if a file cannot be read.
[[nodiscard]] Result<SceneStamp> stampOf(const Job& job, const SceneStamp& known);

/// The result of a job, stored as result.json in its folder, so that any machine can continue from
/// it.
struct JobResult {
    JobState state = JobState::NotRun;
    int exit_code = 0;
    int signal = 0;
    std::string message;  // error message; empty if there was none
    double seconds = 0.0;
    std::uint64_t peak_bytes = 0;
    SceneStamp scene;
    std::string command;                                                // "export" or "plan"
    std::vector<std::string> arguments;                                 // arguments of the run
    std::string version;                                                // program version
    nlohmann::ordered_json metrics = nlohmann::ordered_json::object();  // metrics by name
    std::vector<WrittenDataset> datasets;
    bool ran_now = false;  // ran in the current batch run; not stored
};

/// Whether the result was made with the job's current command and arguments; the scene's content is
/// not compared.
[[nodiscard]] bool isOf(const JobResult& result, const Job& job);

/// Reads result.json of a job's folder; returns a default result (NotRun) if it is missing or
/// damaged.
[[nodiscard]] JobResult readResult(const std::filesystem::path& folder);
/// The stored result of a job if it was made with the current arguments; otherwise a default
/// result.
[[nodiscard]] JobResult resultOf(const Job& job, const std::filesystem::path& batch_folder);
[[nodiscard]] Status writeResult(const GuardedFolder& folder, const JobResult& result);

/// Takes metrics and dataset folders from the program's --json output; leaves `result` unchanged if
/// that is not valid JSON.
void readOutput(const std::filesystem::path& output, const std::filesystem::path& folder,
                JobResult& result);

}  // namespace dollytrack::batch
