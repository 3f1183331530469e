#pragma once

#include "app/cli/compare/sweep.h"
#include "render/plots/figure.h"

#include <string>
#include <vector>

namespace dollytrack::cli {

/// A line for each point: the values, the planner, all metrics, the times of the pipeline's stages.
std::string sweepCsv(const std::vector<SweptParameter>& parameters,
                     const std::vector<SweepPoint>& points);

/// The same for people, with some metrics.
std::string sweepTable(const std::vector<SweptParameter>& parameters,
                       const std::vector<SweepPoint>& points, const std::vector<int>& metrics);

/// Whether a parameter can be the x axis. Error: Usage when its values are no numbers.
Status checkAxis(const SweptParameter& parameter);

/// A chart for each metric over the first parameter, which must pass checkAxis(); a curve for each
/// planner and combination of the others.
render::Figure sweepFigure(const std::string& title, const std::vector<SweptParameter>& parameters,
                           const std::vector<SweepPoint>& points, const std::vector<int>& metrics);

}  // namespace dollytrack::cli
