#pragma once

#include "app/cli/scene_arguments.h"
#include "planning/analysis/plan_comparison.h"

#include <string>
#include <vector>

namespace dollytrack::cli {

/// The metrics of the plans of two projects side by side.
struct ProjectComparison {
    std::string a;  // path of the project
    std::string b;
    std::vector<planning::ComparedMetric> metrics;
};

/// Compares the plans of two projects of one scene. A plan that is stored and valid is used,
/// another one is planned. `each` has the parameters for both. Errors: those of openScene() and
/// planOrReuse(); Usage if the projects have different scenes.
Result<ProjectComparison> compareProjects(const std::vector<std::string>& projects,
                                          const SceneArguments& each, const JobContext& job);

/// A text table with one line per metric: both values, the difference and whether A is better.
std::string comparisonTable(const ProjectComparison& comparison);
std::string comparisonJson(const ProjectComparison& comparison);
std::string comparisonCsv(const ProjectComparison& comparison);

}  // namespace dollytrack::cli
