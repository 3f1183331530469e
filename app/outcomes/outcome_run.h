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
    std::string name;  // in tables and folders
    std::filesystem::path path;
};

/// Which frames are measured by whom.
struct OutcomeOrder {
    std::filesystem::path folder;  // for frames, scratch files and results
    std::vector<ComparedFile> scenes;
    std::vector<ComparedFile> test_scenes;  // no planner's frames are of these, only test sets
    std::vector<std::string> planners;
    int first_seed = 1;
    int seeds = 1;
    int frames = 300;          // of each planner
    int test_frames = 60;      // of each test set
    bool controls = false;     // also the first planner again, and a camera that stares at a wall
    cli::SceneArguments each;  // how to read and plan every scene
    std::vector<std::string> export_arguments;  // the same for 'dollytrack export'
    std::vector<JudgeProgram> judges;
    nlohmann::ordered_json options;   // by judge: options by name
    nlohmann::ordered_json programs;  // by judge: the user's programs, each with name and command
    double timeout_s = 0.0;           // of each judge; 0: without limit
    int threads = 1;                  // of each export
    std::string version;              // of the program
};

/// Checks the judges, exports the frames that are not there yet, and runs the judges that are
/// installed on all of them; without any, nothing is exported. A judge or an export that fails
/// leaves rows without values and a note. What is finished when it is cancelled is used by the next
/// run with the same order. Errors: Cancelled, CannotWrite, and Failed when there are no frames at
/// all.
Result<OutcomeReport> measureOutcomes(const OutcomeOrder& order, const JobContext& job);

/// Names of the controls in reports.
std::string againName(const OutcomeOrder& order);
inline constexpr const char* kStareName = "wall-stare";

/// Writes what a camera can see of a scene from where it can be: an NPY array of float32 with a row
/// x, y, z and unit normal for every sample. Errors: those of opening and mapping the scene,
/// CannotWrite and Cancelled.
Status writeReferenceSurface(const cli::SceneArguments& scene, const std::filesystem::path& file,
                             const JobContext& job);

}  // namespace dollytrack::outcomes
