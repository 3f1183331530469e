#pragma once

#include "app/cli/command_line.h"
#include "app/cli/scene_arguments.h"

#include <string>
#include <vector>

namespace dollytrack::cli {

/// Options of `compare --outcomes`, the downstream evaluation.
struct OutcomeArguments {
    std::vector<std::string> judges;  // empty: --outcomes is not given
    std::string out;
    std::string resolution = "320x240";
    std::vector<std::string> options;  // JUDGE.NAME=VALUE
    std::vector<std::string> slam;     // NAME=COMMAND
    std::vector<std::string> folders;  // folders with additional judges
    std::vector<std::string> test_scenes;
    double timeout_s = 0.0;
    int test_frames = 60;
    bool controls = false;
};

void addOutcomeArguments(CLI::App& command, OutcomeArguments& arguments);

/// What to compare: scenes by path, planners by name.
struct OutcomeSubjects {
    std::vector<std::string> scenes;
    std::vector<std::string> planners;
    int seeds = 1;
    SceneArguments each;  // import and planning options of every scene
    bool as_json = false;
};

/// Exports frames of every planner, runs the judges on them and reports the results.
Result<ExitCode> runOutcomes(const OutcomeArguments& arguments, const OutcomeSubjects& subjects,
                             const Session& session);

/// Prints for each judge what it measures and whether its dependencies are installed.
Result<ExitCode> listOutcomes(const OutcomeArguments& arguments, const Session& session);

}  // namespace dollytrack::cli
