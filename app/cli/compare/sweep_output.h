#pragma once

#include "app/cli/compare/sweep.h"
#include "render/plots/figure.h"

#include <string>
#include <vector>

namespace dollytrack::cli {

/// CSV with one line per point: values, planner, all metrics, and the times of the pipeline's
/// stages.
std::string sweepCsv(const std::vector<SweptParameter>& parameters,
                     const std::vector<SweepPoint>& points);

/// A text table of the points with the chosen metrics (indices in plannerMetricInfos()).
std::string sweepTable(const std::vector<SweptParameter>& parameters,
                       const std::vector<SweepPoint>& points, const std::vector<int>& metrics);

/// Checks that a parameter can be the x axis. Error: Usage if a value is not a number.
Status checkAxis(const SweptParameter& parameter);

/// One chart per metric over the first parameter, which must pass checkAxis(), with one curve per
/// planner and combination of the other parameters.
render::Figure sweepFigure(const std::string& title, const std::vector<SweptParameter>& parameters,
                           const std::vector<SweepPoint>& points, const std::vector<int>& metrics);

}  // namespace dollytrack::cli
