#pragma once

#include "engine/core/result.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack::render {

/// A line of a diagram. Where y has no value the line is interrupted.
struct Curve {
    std::string name;
    std::vector<double> x;
    std::vector<std::optional<double>> y;  // one for each x
};

/// A diagram of curves over a common x axis.
struct Chart {
    std::string title;
    std::string x_label;  // with the unit
    std::string y_label;
    std::vector<Curve> curves;
};

/// Horizontal bars, one for each name; no bar where there is no value.
struct BarChart {
    std::string title;  // with the unit
    std::vector<std::string> names;
    std::vector<std::optional<double>> values;
};

/// Diagrams below one another, or bars side by side, under one heading.
struct Figure {
    std::string title;
    std::vector<Chart> charts;
    std::vector<BarChart> bars;
};

/// Text of an SVG picture. Names may hold anything; numbers that are not finite are left out.
std::string figureSvg(const Figure& figure);

/// Draws it into a file, SVG or PNG by its extension. Errors: Usage for another one, CannotWrite.
Status writeFigure(const Figure& figure, const std::filesystem::path& path);

/// Whether writeFigure() knows the extension. Error: Usage.
Status checkFigureName(const std::filesystem::path& path);

/// Round numbers (1, 2 or 5 times a power of ten apart) that span a range, about `count` of them;
/// the first is not above `low`, the last not below `high`.
std::vector<double> roundTicks(double low, double high, int count);

}  // namespace dollytrack::render
