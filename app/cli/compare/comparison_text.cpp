#include "app/cli/compare/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace dollytrack::cli {

std::vector<std::string> sceneNames(const std::vector<std::string>& paths) {
    std::vector<std::string> names;
    for (const std::string& path : paths) {
        const std::filesystem::path file = std::filesystem::absolute(path);
        const auto same = std::count_if(paths.begin(), paths.end(), [&](const std::string& other) {
            return std::filesystem::path(other).stem() == file.stem();
        });
        const std::string name = file.stem().string();
        names.push_back(same > 1 ? (file.parent_path().filename() / name).string() : name);
    }
    return names;
}

std::string csvField(const std::string& text) {
    if (text.find_first_of(",\"\n") == std::string::npos) return text;
    std::string result = "\"";
    for (const char c : text) result += c == '"' ? std::string("\"\"") : std::string(1, c);
    return result + "\"";
}

std::string comparisonTable(const ComparedScene& scene) {
    const auto& metrics = planning::plannerMetricInfos();
    std::vector<std::string> lines(scene.rows.size() + 2);
    std::size_t widest = 7;
    for (const ComparedRow& row : scene.rows) widest = std::max(widest, row.planner.size());
    lines[0] = fmt::format("  {:<{}}", "", widest);
    lines[1] = fmt::format("  {:<{}}", "planner", widest);
    for (std::size_t i = 0; i < scene.rows.size(); ++i) {
        lines[i + 2] = fmt::format("  {:<{}}", scene.rows[i].planner, widest);
    }
    for (std::size_t m = 0; m < metrics.size(); ++m) {
        const bool used = std::any_of(scene.rows.begin(), scene.rows.end(),
                                      [&](const ComparedRow& row) { return row.values[m]; });
        if (!used || metrics[m].name == "objects") continue;
        std::size_t width = std::max(metrics[m].title.size(), metrics[m].unit.size());
        std::vector<std::string> cells;
        for (const ComparedRow& row : scene.rows) {
            cells.push_back(planning::metricNumber(metrics[m], row.values[m]));
            width = std::max(width, cells.back().size());
        }
        lines[0] += fmt::format("  {:>{}}", metrics[m].title, width);
        lines[1] += fmt::format("  {:>{}}", metrics[m].unit, width);
        for (std::size_t i = 0; i < cells.size(); ++i) {
            lines[i + 2] += fmt::format("  {:>{}}", cells[i], width);
        }
    }
    double objects = 0.0;
    for (const ComparedRow& row : scene.rows)
        objects = std::max(objects, row.values[0].value_or(0));
    std::string text =
        fmt::format("{}: {:.3g} objects, {:.0f} ms map\n", scene.scene, objects, scene.map_ms);
    for (const std::string& line : lines) text += line + "\n";
    return text;
}

std::string comparisonCsv(const std::vector<ComparedScene>& scenes) {
    const auto& metrics = planning::plannerMetricInfos();
    std::string text = "scene,planner";
    for (const planning::MetricInfo& metric : metrics) text += fmt::format(",{}", metric.name);
    text += "\n";
    for (const ComparedScene& scene : scenes) {
        for (const ComparedRow& row : scene.rows) {
            text += csvField(scene.scene) + "," + csvField(row.planner);
            for (const auto& value : row.values) {
                text += value ? fmt::format(",{:.9g}", *value) : ",";
            }
            text += "\n";
        }
    }
    return text;
}

}  // namespace dollytrack::cli
