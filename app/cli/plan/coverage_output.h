#pragma once

#include "planning/analysis/coverage_curve.h"
#include "render/plots/figure.h"

#include <string>
#include <vector>

namespace dollytrack::cli {

/// CSV with one line per budget: its kind and limits, and the frames, length and captured objects
/// of a plan within it; with the shares of surface if the objective includes surface.
std::string coverageCsv(const planning::CoverageCurves& curves);

/// Two charts: the fractions of objects captured and well captured, and of surface seen and covered
/// if the objective includes surface, over frames and over path length.
render::Figure coverageFigure(const std::string& title, const planning::CoverageCurves& curves);

/// Checks that writeCoverage() supports every file's extension and can write there. Errors: Usage,
/// CannotWrite.
Status checkCoverageFiles(const std::vector<std::string>& paths);

/// Writes the curves as a table (.csv) or chart (.svg, .png). Errors: Usage, CannotWrite.
Status writeCoverage(const std::string& title, const planning::CoverageCurves& curves,
                     const std::string& path);

}  // namespace dollytrack::cli
