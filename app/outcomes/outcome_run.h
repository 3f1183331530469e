#pragma once

#include "app/cli/scene_arguments.h"
#include "app/outcomes/judge_program.h"
#include "app/outcomes/outcome_report.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace dollytrack::outcomes {

struct ComparedFile {
    std::string name;  // name in tables and folders
    std::filesystem::path path;
};

/// The planners, scenes and judges of a downstream evaluation.
struct OutcomeOrder {
    std::filesystem::path folder;  // folder for frames, scratch files and results
    std::vector<ComparedFile> scenes;
    std::vector<ComparedFile> test_scenes;  // scenes used for test views only
    std::vector<std::string> planners;
    int first_seed = 1;
    int seeds = 1;
    int frames = 300;          // frames per planner
    int test_frames = 60;      // frames per set of test views
    bool controls = false;     // controls: the first planner again, a camera facing a wall
    cli::SceneArguments each;  // import and planning options of every scene
    std::vector<std::string> export_arguments;  // the same as arguments of 'dollytrack export'
    std::vector<JudgeProgram> judges;
    nlohmann::ordered_json options;   // options by judge and name
    nlohmann::ordered_json programs;  // the user's programs by judge, each with name and command
    double timeout_s = 0.0;           // time limit per judge; 0: none
    int threads = 1;                  // threads per export
    std::string version;              // program version
};

/// Checks the judges, exports the missing frames, and runs the available judges on all frames;
/// without any judge, nothing is exported. A failing judge or export leaves rows without values and
/// a note. After cancellation, a run with the same settings reuses what is finished. Errors:
/// Cancelled, CannotWrite; Failed if no frames could be exported.
Result<OutcomeReport> measureOutcomes(const OutcomeOrder& order, const JobContext& job);

/// Names of the controls in reports: the repeated planner and the camera facing a wall.
std::string againName(const OutcomeOrder& order);
inline constexpr const char* kStareName = "wall-stare";

/// Writes the reference surface of a scene, samples of the surface that a camera can see from
/// reachable positions: an NPY array of float32 with rows x, y, z (m) and unit normal, 4 cm apart.
/// Errors: those of opening and mapping the scene, CannotWrite and Cancelled.
Status writeReferenceSurface(const cli::SceneArguments& scene, const std::filesystem::path& file,
                             const JobContext& job);

}  // namespace dollytrack::outcomes
