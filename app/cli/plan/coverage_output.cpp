#include "app/cli/plan/coverage_output.h"

#include "app/cli/terminal/output_file.h"
#include "engine/io/files/durable_file.h"

#include <fmt/format.h>

#include <filesystem>

namespace dollytrack::cli {
namespace {

bool isTable(const std::string& path) {
    return std::filesystem::path(path).extension() == ".csv";
}

/// Whether the plans' objective includes surface.
bool showsSurface(const std::vector<planning::CoveragePoint>& points) {
    return !points.empty() && points.front().surface_covered_rate.has_value();
}

/// Adds the shares of surface, over the x values of the first curve.
void addSurfaceCurves(render::Chart& chart, const std::vector<planning::CoveragePoint>& points) {
    chart.y_label = "objects, surface (%)";
    const std::vector<double>& x = chart.curves.front().x;
    render::Curve seen{"surface seen", x, {}};
    render::Curve covered{"surface covered", x, {}};
    for (const planning::CoveragePoint& point : points) {
        seen.y.push_back(100.0 * point.surface_seen_rate.value_or(0.0));
        covered.y.push_back(100.0 * point.surface_covered_rate.value_or(0.0));
    }
    chart.curves.push_back(std::move(seen));
    chart.curves.push_back(std::move(covered));
}

render::Chart chartOf(const std::vector<planning::CoveragePoint>& points, std::string title,
                      std::string x_label, bool by_frames) {
    render::Chart chart;
    chart.title = std::move(title);
    chart.x_label = std::move(x_label);
    chart.y_label = "objects (%)";
    render::Curve captured{"captured", {}, {}};
    render::Curve well{"well captured", {}, {}};
    for (const planning::CoveragePoint& point : points) {
        // Over the used frames or length, which may be less than the budget.
        const double x = by_frames ? point.frames : point.path_length_m;
        captured.x.push_back(x);
        captured.y.push_back(100.0 * point.capture_rate);
        well.x.push_back(x);
        well.y.push_back(100.0 * point.well_captured_rate);
    }
    chart.curves = {std::move(captured), std::move(well)};
    if (showsSurface(points)) addSurfaceCurves(chart, points);
    return chart;
}

}  // namespace

std::string coverageCsv(const planning::CoverageCurves& curves) {
    const bool surface = showsSurface(curves.by_frames);
    std::string text =
        "budget,max_frames,max_length_m,frames,path_length_m,captured,well_captured,capture_rate,"
        "well_captured_rate";
    text += surface ? ",surface_seen_rate,surface_covered_rate\n" : "\n";
    const auto limit = [](double value) {
        return value > 0.0 ? fmt::format("{:.9g}", value) : std::string();
    };
    const auto add = [&](const char* budget, const planning::CoveragePoint& point) {
        text += fmt::format("{},{},{},{},{:.9g},{},{},{:.9g},{:.9g}", budget,
                            limit(point.max_frames), limit(point.max_length_m), point.frames,
                            point.path_length_m, point.captured, point.well_captured,
                            point.capture_rate, point.well_captured_rate);
        if (surface) {
            text += fmt::format(",{:.9g},{:.9g}", point.surface_seen_rate.value_or(0.0),
                                point.surface_covered_rate.value_or(0.0));
        }
        text += '\n';
    };
    for (const auto& point : curves.by_frames) add("frames", point);
    for (const auto& point : curves.by_length) add("length", point);
    return text;
}

render::Figure coverageFigure(const std::string& title, const planning::CoverageCurves& curves) {
    render::Figure figure;
    figure.title = title;
    figure.charts = {
        chartOf(curves.by_frames, "Within a budget of frames", "frames", true),
        chartOf(curves.by_length, "Within a budget of path length", "path (m)", false)};
    return figure;
}

Status checkCoverageFiles(const std::vector<std::string>& paths) {
    for (const std::string& path : paths) {
        if (!isTable(path) && !render::checkFigureName(path)) {
            return fail(ErrorCode::Usage, "The file's name must end in .csv, .svg or .png.", path);
        }
        if (Status status = checkWritable(path); !status) return status;
    }
    return {};
}

Status writeCoverage(const std::string& title, const planning::CoverageCurves& curves,
                     const std::string& path) {
    if (isTable(path)) return writeWhole(path, coverageCsv(curves));
    return render::writeFigure(coverageFigure(title, curves), path);
}

}  // namespace dollytrack::cli
