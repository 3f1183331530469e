#include "app/batch/report.h"

#include "app/batch/markup.h"
#include "app/cli/export/export_metrics.h"
#include "app/cli/plan/baseline_plan.h"
#include "app/cli/requirement.h"
#include "engine/io/files/guarded_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

namespace dollytrack::batch {
namespace {

using Json = nlohmann::ordered_json;

std::string unmetText(const cli::Requirement& wanted, const Json& metrics) {
    const auto found = metrics.find(wanted.metric);
    if (found == metrics.end()) {
        return fmt::format("{} does not apply to it", wanted.metric);
    }
    const auto measured = found->get<double>();
    if (wanted.holds(measured)) return {};
    return fmt::format("{} is {:.4g}, required {} {:.4g}", wanted.metric, measured,
                       wanted.comparison, wanted.value);
}

/// All metric names that a job's result can have, with placeholder values.
nlohmann::json metricsOfJob(const Job& job) {
    return job.command == "export" ? cli::exportMetricsOf(job.planner)
                                   : cli::metricsOf(job.planner);
}

}  // namespace

bool isGood(const ReportRow& row) {
    return row.result.state == JobState::Done && row.unmet.empty();
}

std::string verdictOf(const ReportRow& row) {
    if (row.result.state != JobState::Done) return name(row.result.state);
    return row.unmet.empty() ? "good" : "unmet";
}

std::string complaintOf(const ReportRow& row) {
    if (row.result.state != JobState::Done) return row.result.message;
    std::string text;
    for (const std::string& one : row.unmet) text += (text.empty() ? "" : "; ") + one;
    return text;
}

std::string Report::linkTo(const ReportRow& row, const std::string& file) const {
    // Purely lexical: both paths are below the same folder.
    const auto path = (jobs_folder / row.job.name / file).lexically_relative(folder);
    return asLink(path.generic_string());
}

std::vector<ReportRow> evaluateResults(const std::vector<Job>& jobs, std::vector<JobResult> results,
                                       const std::vector<std::string>& require) {
    std::vector<ReportRow> rows;
    for (std::size_t i = 0; i < jobs.size(); ++i) {
        ReportRow row{jobs[i], std::move(results[i]), {}};
        for (const std::string& text : require) {
            const auto wanted = cli::parseRequirement(text);
            if (!wanted || row.result.state != JobState::Done) continue;
            std::string unmet = unmetText(*wanted, row.result.metrics);
            if (!unmet.empty()) row.unmet.push_back(std::move(unmet));
        }
        if (row.result.state == JobState::NotRun) row.result.message = "it was not run";
        rows.push_back(std::move(row));
    }
    return rows;
}

Status checkRequirements(const std::vector<std::string>& require, const std::vector<Job>& jobs) {
    std::vector<cli::Requirement> wanted;
    for (const std::string& text : require) {
        auto one = cli::parseRequirement(text);
        if (!one) return tl::unexpected(std::move(one.error()));
        wanted.push_back(std::move(*one));
    }
    std::set<std::string> asked;
    for (const Job& job : jobs) {
        if (!asked.insert(job.planner).second) continue;
        if (Status status = cli::checkNames(wanted, metricsOfJob(job)); !status) return status;
    }
    return {};
}

const std::vector<ShownMetric>& shownMetrics() {
    static const std::vector<ShownMetric> metrics = {
        {"frames", "frames", ""},
        {"exported_frames", "exported", ""},
        {"objects", "objects", ""},
        {"capture_rate", "captured", "%"},
        {"well_captured_rate", "well captured", "%"},
        {"counted.capture_rate", "captured, by pixels", "%"},
        {"counted.well_captured_rate", "well, by pixels", "%"},
        {"dark_rate", "dark images", "%"},
        {"white_rate", "white images", "%"},
        {"flat_rate", "flat images", "%"},
        {"area_share_box", "box area", "%"},
        {"repeat_rate", "repeats", "%"},
        {"move_collision_rate", "colliding moves", "%"},
        {"frame_collision_rate", "colliding frames", "%"},
        {"path_length_m", "path", "m"},
    };
    return metrics;
}

std::string shownValue(const ReportRow& row, const ShownMetric& metric) {
    const auto found = row.result.metrics.find(metric.name);
    if (found == row.result.metrics.end() || !found->is_number()) return {};
    const auto value = found->get<double>();
    if (std::string_view(metric.unit) == "%") return fmt::format("{:.1f}", 100.0 * value);
    return fmt::format("{:.6g}", value);
}

Json reportJson(const Report& report) {
    std::map<std::string, int> counts;
    double seconds = 0.0;
    Json jobs = Json::array();
    for (const ReportRow& row : report.rows) {
        const JobResult& result = row.result;
        ++counts[verdictOf(row)];
        seconds += result.seconds;
        Json one = toJson(row.job);
        one["verdict"] = verdictOf(row);
        one["message"] = complaintOf(row);
        one["exit_code"] = result.exit_code;
        one["signal"] = result.signal;
        one["seconds"] = result.seconds;
        one["peak_mb"] = static_cast<double>(result.peak_bytes) / 1e6;
        one["ran_now"] = result.ran_now;
        one["metrics"] = result.metrics;
        one["datasets"] = Json::array();
        for (const WrittenDataset& dataset : result.datasets) {
            one["datasets"].push_back(
                {{"folder", row.job.name + "/" + dataset.folder}, {"frames", dataset.frames}});
            if (!dataset.unusable.empty()) one["datasets"].back()["unusable"] = dataset.unusable;
        }
        jobs.push_back(std::move(one));
    }
    return {{"title", report.title},
            {"require", report.require},
            {"verdicts", counts},
            {"seconds", seconds},
            {"jobs", std::move(jobs)}};
}

std::string reportText(const Report& report) {
    std::map<std::string, int> counts;
    for (const ReportRow& row : report.rows) ++counts[verdictOf(row)];
    std::string tally;
    for (const auto& [verdict, count] : counts) {
        tally += fmt::format("{}{} {}", tally.empty() ? "" : ", ", count, verdict);
    }
    std::string text =
        fmt::format("{} jobs: {}\n", report.rows.size(), tally.empty() ? "nothing to do" : tally);
    for (const ReportRow& row : report.rows) {
        if (isGood(row)) continue;
        text += fmt::format("  {:<4} {}: {}: {}\n", row.job.number, row.job.name, verdictOf(row),
                            complaintOf(row));
    }
    return text + fmt::format("{}\n", (report.folder / "index.html").string());
}

Status writeReport(const Report& report) {
    const Result<GuardedFolder> folder =
        GuardedFolder::makeBelow(report.folder, report.jobs_folder);
    if (!folder) return tl::unexpected(folder.error());
    const std::string json =
        reportJson(report).dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
    Status status = folder->write("summary.json", json);
    if (status) status = folder->write("junit.xml", reportJunit(report));
    if (status) status = folder->write("index.html", reportHtml(report));
    return status;
}

}  // namespace dollytrack::batch
