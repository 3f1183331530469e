#pragma once

#include "engine/core/result.h"
#include "engine/jobs/job.h"

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack::outcomes {

/// A Python program that evaluates datasets with another program; README.md has its protocol.
struct JudgeProgram {
    std::string name;            // of its file, without ".py"
    std::filesystem::path path;  // absolute
    std::string text;            // the first line of its docstring
    bool wants_tests = false;    // it reads the request's test sets
    bool wants_surface = false;  // it reads the scenes' reference surfaces
};

/// The folder of the judges that come with the program. Error: Failed when it is not there.
[[nodiscard]] Result<std::filesystem::path> judgesFolder();

/// The judges of these folders by name, those of later folders in the place of earlier ones. Other
/// Python files, which judges share, are left out. Error: BadInput when a folder cannot be read.
[[nodiscard]] Result<std::vector<JudgeProgram>> findJudges(
    const std::vector<std::filesystem::path>& folders);

/// Those named, in the order of `all`; all for "all". Error: Usage, with the closest name.
[[nodiscard]] Result<std::vector<JudgeProgram>> chooseJudges(const std::vector<JudgeProgram>& all,
                                                             const std::vector<std::string>& names);

/// How a judge's process ended.
struct JudgeEnd {
    enum class How { Done, Missing, Failed, TimedOut };
    How how = How::Failed;
    std::string text;  // what it said: versions, what is missing, or why it failed
};

/// How a judge is run: whatever it says goes to files in this folder, which must exist.
struct JudgeSettings {
    std::filesystem::path folder;
    double timeout_s = 0.0;  // 0: without limit
};

/// Asks a judge whether all that it needs is installed, also for the options and programs of the
/// request, a file; an empty path: none. Errors: Cancelled, CannotWrite.
[[nodiscard]] Result<JudgeEnd> checkJudge(const JudgeProgram& judge, const JudgeSettings& settings,
                                          const std::filesystem::path& request,
                                          const JobContext& job);

/// Runs a judge on `request.json` in its folder, where it writes `result.json`; progress counts its
/// entries. Errors: Cancelled, CannotWrite.
[[nodiscard]] Result<JudgeEnd> runJudge(const JudgeProgram& judge, const JudgeSettings& settings,
                                        int entries, const JobContext& job);

}  // namespace dollytrack::outcomes
