#pragma once

#include "engine/core/result.h"
#include "engine/jobs/job.h"

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack::outcomes {

/// A judge: a Python program that evaluates datasets by means of another program. README.md
/// describes the protocol.
struct JudgeProgram {
    std::string name;            // file name without ".py"
    std::filesystem::path path;  // absolute
    std::string text;            // first line of its docstring
    bool wants_tests = false;    // it uses sets of test views
    bool wants_surface = false;  // it uses the scenes' reference surfaces
};

/// The folder of the built-in judges. Error: Failed if it is missing.
[[nodiscard]] Result<std::filesystem::path> judgesFolder();

/// The judges in these folders, sorted by name; later folders override earlier ones. Python files
/// without a main program (shared modules) are skipped. Error: BadInput if a folder cannot be read.
[[nodiscard]] Result<std::vector<JudgeProgram>> findJudges(
    const std::vector<std::filesystem::path>& folders);

/// The named judges, in the order of `all`; "all" selects all. Error: Usage, with the closest name.
[[nodiscard]] Result<std::vector<JudgeProgram>> chooseJudges(const std::vector<JudgeProgram>& all,
                                                             const std::vector<std::string>& names);

/// How a judge's process ended.
struct JudgeEnd {
    enum class How { Done, Missing, Failed, TimedOut };
    How how = How::Failed;
    std::string text;  // versions found, what is missing, or the error message
};

/// How to run a judge. Its output is written to files in `folder`, which must exist.
struct JudgeSettings {
    std::filesystem::path folder;
    double timeout_s = 0.0;  // 0: no limit
};

/// Runs a judge's --check: whether its dependencies are installed, including those of the options
/// and programs in the request file (empty path: none). Limited to 120 s. Errors: Cancelled,
/// CannotWrite.
[[nodiscard]] Result<JudgeEnd> checkJudge(const JudgeProgram& judge, const JudgeSettings& settings,
                                          const std::filesystem::path& request,
                                          const JobContext& job);

/// Runs a judge on `request.json` in its folder, where it writes `result.json`; progress counts
/// finished entries. Errors: Cancelled, CannotWrite.
[[nodiscard]] Result<JudgeEnd> runJudge(const JudgeProgram& judge, const JudgeSettings& settings,
                                        int entries, const JobContext& job);

}  // namespace dollytrack::outcomes
