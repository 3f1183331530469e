#include "app/batch/html_page.h"
#include "app/batch/markup.h"
#include "app/outcomes/outcome_report.h"

#include <fmt/format.h>

#include <algorithm>

namespace dollytrack::outcomes {
namespace {

using batch::asMarkup;

std::string headCells(const JudgeOutcome& outcome) {
    std::string text;
    for (const Metric& metric : outcome.metrics) {
        text += fmt::format("<th>{}{}</th>", asMarkup(metric.name),
                            metric.unit.empty() ? "" : fmt::format(", {}", asMarkup(metric.unit)));
    }
    return text + "</tr></thead><tbody>\n";
}

std::string valueCells(const JudgeOutcome& outcome, const Row& row) {
    std::string text;
    for (std::size_t i = 0; i < outcome.metrics.size(); ++i) {
        text += fmt::format("<td>{}</td>", shown(outcome.metrics[i], row.values[i]));
    }
    return text + "</tr>\n";
}

std::string judgeSection(const JudgeOutcome& outcome) {
    std::string text =
        fmt::format("<h2>{}</h2>\n<p>{}<br><small>{}</small></p>\n", asMarkup(outcome.judge),
                    asMarkup(outcome.text),
                    asMarkup(outcome.versions.empty() ? outcome.state : outcome.versions));
    for (const std::string& note : outcome.notes) {
        text += "<p class=\"open\">" + asMarkup(note) + "</p>\n";
    }
    if (outcome.metrics.empty()) return text;
    text += "<table class=\"sorted\"><thead><tr><th>runs</th><th>planner</th><th></th>" +
            headCells(outcome);
    for (const Row& row : meanRows(outcome)) {
        const auto runs = std::count_if(outcome.rows.begin(), outcome.rows.end(),
                                        [&](const Row& one) { return one.planner == row.planner; });
        text +=
            fmt::format("<tr><td>{}</td><td>{}</td><td>mean</td>", runs, asMarkup(row.planner)) +
            valueCells(outcome, row);
    }
    text +=
        "</tbody></table>\n<details><summary>every scene and seed</summary>\n"
        "<table class=\"sorted\"><thead><tr><th>seed</th><th>planner</th><th>scene</th>" +
        headCells(outcome);
    for (const Row& row : outcome.rows) {
        text += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td>", row.seed,
                            asMarkup(row.planner), asMarkup(row.scene)) +
                valueCells(outcome, row);
    }
    return text + "</tbody></table></details>\n";
}

}  // namespace

std::string outcomeHtml(const OutcomeReport& report) {
    std::string body = "<h1>Downstream evaluation of the frames</h1>\n";
    for (const std::string& note : report.notes) body += "<p>" + asMarkup(note) + "</p>\n";
    for (const JudgeOutcome& outcome : report.judges) body += judgeSection(outcome);
    return batch::htmlPage("Outcomes", body);
}

}  // namespace dollytrack::outcomes
