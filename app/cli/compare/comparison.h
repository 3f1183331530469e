#pragma once

#include "engine/core/result.h"
#include "engine/jobs/job.h"
#include "planning/baselines/judge.h"
#include "planning/baselines/planner.h"

#include <string>
#include <vector>

namespace dollytrack::cli {

/// A trajectory that comes with the scene, to be judged beside the planners.
struct GivenFlight {
    std::string name;
    planning::Flight flight;
};

/// One planner's numbers in one scene: medians over the seeds.
struct ComparedRow {
    std::string planner;
    planning::JudgedRow values;  // in the order of judgedMetrics()
};

struct ComparedScene {
    std::string scene;  // its name in tables; the caller's
    double map_ms = 0.0;
    std::vector<ComparedRow> rows;
    int failures = 0;  // flights that could not be planned; said in the log
};

struct ComparisonOrder {
    std::vector<const planning::Planner*> planners;
    int seeds = 1;  // the parameters' seed and those after it
    bool bound = false;
};

/// Plans with every planner in one map of the scene and judges all flights alike. With `bound` a
/// last row tells what no planner can pass: a dense search, helped by all that the flights found.
/// Errors: Usage for more seeds than there are numbers, those of the map, and Cancelled; a planner
/// that fails is left out with a warning.
Result<ComparedScene> compareIn(std::shared_ptr<const Scene> scene, const PlanEdits& edits,
                                const planning::PlanParams& params, const ComparisonOrder& order,
                                const std::vector<GivenFlight>& given, const JobContext& job);

/// Planner by planner the mean over the scenes that have a row of it.
ComparedScene meanOver(const std::vector<ComparedScene>& scenes);

/// A planner a line, a metric a column; columns without any value are left out.
std::string comparisonTable(const ComparedScene& scene);

/// What scenes are called in tables: their files' names, with the folders' where files of several
/// folders have the same.
std::vector<std::string> sceneNames(const std::vector<std::string>& paths);

/// A text as a field of a CSV file: commas and quotes of file names must not break the table.
std::string csvField(const std::string& text);

/// All metrics, a line for each scene and planner; empty where a metric does not apply.
std::string comparisonCsv(const std::vector<ComparedScene>& scenes);

}  // namespace dollytrack::cli
