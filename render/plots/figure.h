#pragma once

#include "engine/core/result.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack::render {

/// A curve of a chart. It is interrupted where y has no value.
struct Curve {
    std::string name;
    std::vector<double> x;
    std::vector<std::optional<double>> y;  // same length as x
};

/// A line chart of curves over a common x axis.
struct Chart {
    std::string title;
    std::string x_label;  // including the unit
    std::string y_label;
    std::vector<Curve> curves;
};

/// Horizontal bars, one per name; no bar where there is no value.
struct BarChart {
    std::string title;  // including the unit
    std::vector<std::string> names;
    std::vector<std::optional<double>> values;
};

/// Charts one below the other, or bar charts side by side, under one title.
struct Figure {
    std::string title;
    std::vector<Chart> charts;
    std::vector<BarChart> bars;
};

/// The figure as SVG text. Names may contain any character; non-finite numbers are left out.
std::string figureSvg(const Figure& figure);

/// Writes the figure as SVG or PNG, by the file's extension. Returns Usage for another extension,
/// CannotWrite if writing fails.
Status writeFigure(const Figure& figure, const std::filesystem::path& path);

/// Checks that writeFigure() supports the extension. Returns Usage if not.
Status checkFigureName(const std::filesystem::path& path);

/// About `count` round numbers (1, 2 or 5 times a power of ten apart) that cover a range: the first
/// is not above `low`, the last not below `high`.
std::vector<double> roundTicks(double low, double high, int count);

}  // namespace dollytrack::render
