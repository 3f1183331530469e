#include "app/statistics/page_tables.h"

#include "app/batch/markup.h"
#include "app/statistics/page_text.h"
#include "app/statistics/plot_frame.h"

#include <fmt/format.h>

#include <algorithm>

namespace dollytrack::statistics {
namespace {

constexpr std::size_t kMostRows = 100;

/// The cells of a row; those after the first with the difference from the first.
std::string cells(const std::vector<std::optional<double>>& values, double factor) {
    std::string text;
    for (std::size_t i = 0; i < values.size(); ++i) {
        std::string cell = values[i] ? numberText(*values[i] * factor) : "–";
        if (i > 0 && values[i] && values[0]) {
            cell += fmt::format(" <small>{}</small>",
                                differenceText((*values[i] - *values[0]) * factor));
        }
        text += fmt::format("<td{}>{}</td>", i == 0 ? " class=\"first\"" : "", cell);
    }
    return text;
}

std::string datasetHeads(std::span<const DatasetStatistics> datasets, std::size_t name_bytes) {
    std::string text;
    for (std::size_t i = 0; i < datasets.size(); ++i) {
        text += fmt::format("<th{}><span class=\"key s{}\">{}</span></th>",
                            i == 0 ? " class=\"first\"" : "", i,
                            shownName(datasets[i].name, name_bytes));
    }
    return text;
}

struct ClassColumn {
    const char* head;
    std::size_t ClassStatistics::*field;
    bool of_boxes;  // unknown without annotations.json
};
constexpr ClassColumn kClassColumns[] = {{"boxes", &ClassStatistics::boxes, true},
                                         {"frames", &ClassStatistics::frames, true},
                                         {"objects with boxes", &ClassStatistics::objects, true},
                                         {"target objects", &ClassStatistics::targets, false},
                                         {"captured", &ClassStatistics::captured, false},
                                         {"well captured", &ClassStatistics::well_captured, false}};

std::string classCells(const ClassRow& row, std::span<const DatasetStatistics> datasets) {
    std::string text;
    for (const ClassColumn& column : kClassColumns) {
        std::vector<std::optional<double>> values;
        for (std::size_t i = 0; i < datasets.size(); ++i) {
            const ClassStatistics* counted = row.datasets[i];
            values.emplace_back(counted != nullptr ? static_cast<double>(counted->*column.field)
                                                   : 0.0);
            if (column.of_boxes && !datasets[i].has_boxes) values.back().reset();
        }
        text += cells(values, 1.0);
    }
    return text;
}

}  // namespace

std::string overviewTable(std::span<const DatasetStatistics> datasets) {
    std::string text = "<div class=\"table\"><table class=\"overview\"><thead><tr><th></th>" +
                       datasetHeads(datasets, 40) + "</tr></thead><tbody>\n";
    for (const OverviewRow& row : overview()) {
        std::vector<std::optional<double>> values;
        for (const DatasetStatistics& dataset : datasets) values.push_back(row.value(dataset));
        if (std::ranges::none_of(values, [](const auto& value) { return value.has_value(); })) {
            continue;
        }
        text += fmt::format("<tr><th>{}</th>{}</tr>\n", batch::asMarkup(row.label),
                            cells(values, row.factor));
    }
    return text + "</tbody></table></div>\n";
}

std::string classTable(std::span<const ClassRow> rows,
                       std::span<const DatasetStatistics> datasets) {
    std::string text = "<div class=\"table\"><table class=\"classes\"><thead><tr><th>class</th>";
    for (const ClassColumn& column : kClassColumns) {
        text +=
            fmt::format("<th colspan=\"{}\" class=\"first\">{}</th>", datasets.size(), column.head);
    }
    text += "</tr>";
    if (datasets.size() > 1) {
        text += "<tr><th></th>";
        for (std::size_t i = 0; i < std::size(kClassColumns); ++i)
            text += datasetHeads(datasets, 12);
        text += "</tr>";
    }
    text += "</thead><tbody>\n";
    for (const ClassRow& row : rows.first(std::min(rows.size(), kMostRows))) {
        text +=
            fmt::format("<tr><th>{}</th>{}</tr>\n", shownName(row.name), classCells(row, datasets));
    }
    text += "</tbody></table></div>\n";
    if (rows.size() > kMostRows) {
        text += fmt::format("<p class=\"note\">{} more classes are left out; --json has all.</p>\n",
                            rows.size() - kMostRows);
    }
    return text;
}

}  // namespace dollytrack::statistics
