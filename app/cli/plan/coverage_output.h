#pragma once

#include "planning/metrics/coverage_curve.h"
#include "render/plots/figure.h"

#include <string>
#include <vector>

namespace dollytrack::cli {

/// A line for each budget: which it is, and what a plan within it has and captures.
std::string coverageCsv(const planning::CoverageCurves& curves);

/// Two diagrams: the share of objects captured, and captured well, over frames and over metres.
render::Figure coverageFigure(const std::string& title, const planning::CoverageCurves& curves);

/// Whether writeCoverage() knows every file's extension and can write it. Errors: Usage,
/// CannotWrite.
Status checkCoverageFiles(const std::vector<std::string>& paths);

/// A table (.csv) or a picture (.svg, .png). Errors: Usage, CannotWrite.
Status writeCoverage(const std::string& title, const planning::CoverageCurves& curves,
                     const std::string& path);

}  // namespace dollytrack::cli
