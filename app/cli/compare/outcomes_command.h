#pragma once

#include "app/cli/command_line.h"
#include "app/cli/scene_arguments.h"

#include <string>
#include <vector>

namespace dollytrack::cli {

/// The options of `compare --outcomes`.
struct OutcomeArguments {
    std::vector<std::string> judges;  // empty: not asked for
    std::string out;
    std::string resolution = "320x240";
    std::vector<std::string> options;  // JUDGE.NAME=VALUE
    std::vector<std::string> slam;     // NAME=COMMAND
    std::vector<std::string> folders;  // with further judges
    std::vector<std::string> test_scenes;
    double timeout_s = 0.0;
    int test_frames = 60;
    bool controls = false;
};

void addOutcomeArguments(CLI::App& command, OutcomeArguments& arguments);

/// What is compared: scenes by their paths, planners by name.
struct OutcomeSubjects {
    std::vector<std::string> scenes;
    std::vector<std::string> planners;
    int seeds = 1;
    SceneArguments each;  // how to read and plan every scene
    bool as_json = false;
};

/// Exports the planners' frames, has the judges measure them and reports it.
Result<ExitCode> runOutcomes(const OutcomeArguments& arguments, const OutcomeSubjects& subjects,
                             const Session& session);

/// Says of each judge what it measures, and what it needs where that is missing.
Result<ExitCode> listOutcomes(const OutcomeArguments& arguments, const Session& session);

}  // namespace dollytrack::cli
