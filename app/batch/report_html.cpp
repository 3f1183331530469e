#include "app/batch/html_page.h"
#include "app/batch/log_end.h"
#include "app/batch/markup.h"
#include "app/batch/report.h"

#include <fmt/format.h>

#include <deque>
#include <map>
#include <sstream>
#include <string_view>

namespace dollytrack::batch {
namespace {

constexpr std::size_t kLogLines = 20;

const char* classOf(const ReportRow& row) {
    if (isGood(row)) return "good";
    const bool open =
        row.result.state == JobState::NotRun || row.result.state == JobState::Interrupted;
    return open ? "open" : "bad";
}

/// The metrics that at least one job has, so that no column is empty.
std::vector<ShownMetric> columnsOf(const std::vector<ReportRow>& rows) {
    std::vector<ShownMetric> columns;
    for (const ShownMetric& metric : shownMetrics()) {
        for (const ReportRow& row : rows) {
            if (shownValue(row, metric).empty()) continue;
            columns.push_back(metric);
            break;
        }
    }
    return columns;
}

std::string headOf(const ShownMetric& metric) {
    const std::string_view unit = metric.unit;
    return fmt::format("<th>{}{}</th>", asMarkup(metric.title),
                       unit.empty() ? "" : fmt::format(", {}", unit));
}

std::string jobTable(const Report& report) {
    const std::vector<ShownMetric> columns = columnsOf(report.rows);
    std::string text = "<table class=\"sorted\"><thead><tr><th>no.</th><th>job</th><th></th>";
    for (const ShownMetric& metric : columns) text += headOf(metric);
    text += "<th>time, s</th><th>memory, MB</th></tr></thead><tbody>\n";
    for (const ReportRow& row : report.rows) {
        const JobResult& result = row.result;
        const std::string link = result.datasets.empty()
                                     ? asMarkup(row.job.name)
                                     : fmt::format("<a href=\"{}\">{}</a>",
                                                   report.linkTo(row, result.datasets[0].folder),
                                                   asMarkup(row.job.name));
        text += fmt::format("<tr><td>{}</td><td>{}</td><td class=\"{}\">{}</td>", row.job.number,
                            link, classOf(row), asMarkup(verdictOf(row)));
        for (const ShownMetric& metric : columns) {
            text += fmt::format("<td>{}</td>", shownValue(row, metric));
        }
        text += fmt::format("<td>{:.1f}</td><td>{:.0f}</td></tr>\n", result.seconds,
                            static_cast<double>(result.peak_bytes) / 1e6);
    }
    return text + "</tbody></table>\n";
}

/// Means over the scenes and seeds, by set and planner; empty if there is only one combination.
std::string meanTable(const Report& report) {
    std::map<std::pair<std::string, std::string>, std::vector<const ReportRow*>> groups;
    for (const ReportRow& row : report.rows) {
        if (row.result.state != JobState::Done) continue;
        groups[{row.job.set, row.job.planner}].push_back(&row);
    }
    if (groups.size() < 2) return {};
    const std::vector<ShownMetric> columns = columnsOf(report.rows);
    std::string text =
        "<h2>Means</h2>\n<table><thead><tr><th>jobs</th><th>set</th><th>planner</th>";
    for (const ShownMetric& metric : columns) text += headOf(metric);
    text += "</tr></thead><tbody>\n";
    for (const auto& [key, rows] : groups) {
        text += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td>", rows.size(),
                            asMarkup(key.first), asMarkup(key.second));
        for (const ShownMetric& metric : columns) {
            ReportRow mean;
            double sum = 0.0;
            int count = 0;
            for (const ReportRow* row : rows) {
                const auto found = row->result.metrics.find(metric.name);
                if (found == row->result.metrics.end()) continue;
                sum += found->get<double>();
                ++count;
            }
            if (count > 0) mean.result.metrics[metric.name] = sum / count;
            text += fmt::format("<td>{}</td>", shownValue(mean, metric));
        }
        text += "</tr>\n";
    }
    return text + "</tbody></table>\n";
}

/// Whether a log line is only progress (" 41 %  frames, 0:12 left"), which would fill the log of a
/// long run.
bool isProgress(std::string_view line) {
    const std::size_t digit = line.find_first_not_of(' ');
    if (digit == std::string_view::npos) return false;
    const std::size_t after = line.find_first_not_of("0123456789", digit);
    return after != std::string_view::npos && after > digit && line.substr(after, 4) == " %  ";
}

std::string endOfLog(const std::filesystem::path& path) {
    constexpr std::size_t kEnough = std::size_t{1} << 20U;  // bytes of the log that are searched
    std::istringstream file(endOf(path, kEnough));
    std::deque<std::string> lines;
    for (std::string line; std::getline(file, line);) {
        if (isProgress(line)) continue;
        lines.push_back(std::move(line));
        if (lines.size() > kLogLines) lines.pop_front();
    }
    std::string text = lines.empty() ? "The log contains only progress lines.\n" : "";
    for (const std::string& line : lines) text += asMarkup(line) + "\n";
    return text;
}

std::string failures(const Report& report) {
    std::string text;
    for (const ReportRow& row : report.rows) {
        if (isGood(row) || row.result.state == JobState::NotRun) continue;
        text += fmt::format(
            "<h3 id=\"job{}\">{} <span class=\"{}\">{}</span></h3>\n<p>{}</p>\n"
            "<details><summary>the end of its <a href=\"{}\">log</a></summary><pre>{}</pre>"
            "</details>\n",
            row.job.number, asMarkup(row.job.name), classOf(row), asMarkup(verdictOf(row)),
            asMarkup(complaintOf(row)), report.linkTo(row, "log.txt"),
            endOfLog(report.jobs_folder / row.job.name / "log.txt"));
    }
    return text.empty() ? text : "<h2>Errors</h2>\n" + text;
}

std::string sheets(const Report& report) {
    std::string text;
    for (const ReportRow& row : report.rows) {
        for (const WrittenDataset& dataset : row.result.datasets) {
            const auto place = report.jobs_folder / row.job.name / dataset.folder;
            std::error_code error;  // datasets without images have no contact sheet
            if (!std::filesystem::exists(place / "contact_sheet.jpg", error)) continue;
            const std::string link = report.linkTo(row, dataset.folder + "/contact_sheet.jpg");
            text += fmt::format(
                "<figure><a href=\"{}\"><img loading=\"lazy\" src=\"{}\" alt=\"\"></a>"
                "<figcaption>{}{}{}</figcaption></figure>\n",
                link, link, asMarkup(row.job.name),
                row.result.datasets.size() > 1 ? ", " + asMarkup(dataset.folder) : "",
                dataset.unusable.empty() ? "" : "; " + asMarkup(dataset.unusable));
        }
    }
    return text.empty() ? text : "<h2>Contact sheets</h2>\n" + text;
}

}  // namespace

std::string reportHtml(const Report& report) {
    std::map<std::string, int> counts;
    for (const ReportRow& row : report.rows) ++counts[verdictOf(row)];
    std::string tally;
    for (const auto& [verdict, count] : counts) {
        tally += fmt::format("{}{} {}", tally.empty() ? "" : ", ", count, asMarkup(verdict));
    }
    std::string required;
    for (const std::string& one : report.require) {
        required += fmt::format("{}<code>{}</code>", required.empty() ? "" : ", ", asMarkup(one));
    }
    std::string text = fmt::format("<h1>{}</h1>\n<p>{} jobs: {}</p>\n", asMarkup(report.title),
                                   report.rows.size(), tally);
    if (!required.empty()) text += "<p>Required: " + required + "</p>\n";
    text += failures(report) + "<h2>Jobs</h2>\n" + jobTable(report) + meanTable(report) +
            sheets(report);
    return htmlPage(report.title, text);
}

}  // namespace dollytrack::batch
