#pragma once

#include "app/batch/batch_folder.h"
#include "app/batch/job_result.h"
#include "engine/core/result.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace dollytrack::batch {

/// A job with its result.
struct ReportRow {
    Job job;
    JobResult result;
    std::vector<std::string> unmet;  // unmet requirements, with the measured values
};

/// Whether the job is done and meets all requirements.
[[nodiscard]] bool isGood(const ReportRow& row);
/// "good", "unmet" (done, but not all requirements are met), or the state's name.
[[nodiscard]] std::string verdictOf(const ReportRow& row);
/// The error or the unmet requirements in one sentence; empty if the job is good.
[[nodiscard]] std::string complaintOf(const ReportRow& row);

struct Report {
    std::string title;
    std::filesystem::path jobs_folder;  // folder of the batch, which contains the jobs' folders
    std::filesystem::path folder;       // output folder of the report
    std::vector<std::string> require;
    std::vector<ReportRow> rows;

    /// Relative URL from the report to a file in a job's folder.
    [[nodiscard]] std::string linkTo(const ReportRow& row, const std::string& file) const;
};

/// Combines jobs with their results (same order) and evaluates the requirements, which must be
/// valid.
[[nodiscard]] std::vector<ReportRow> evaluateResults(const std::vector<Job>& jobs,
                                                     std::vector<JobResult> results,
                                                     const std::vector<std::string>& require);

/// Checks, before any job runs, that the requirements name metrics that these jobs report. Error:
/// Usage.
[[nodiscard]] Status checkRequirements(const std::vector<std::string>& require,
                                       const std::vector<Job>& jobs);

/// A metric shown in reports for each job that has it.
struct ShownMetric {
    const char* name;
    const char* title;
    const char* unit;  // "%" for a rate, 0..1
};
[[nodiscard]] const std::vector<ShownMetric>& shownMetrics();
/// The formatted value; empty if the job lacks it.
[[nodiscard]] std::string shownValue(const ReportRow& row, const ShownMetric& metric);

[[nodiscard]] nlohmann::ordered_json reportJson(const Report& report);
[[nodiscard]] std::string reportJunit(const Report& report);
[[nodiscard]] std::string reportHtml(const Report& report);
/// A summary for the terminal, with one line for each job that is not good.
[[nodiscard]] std::string reportText(const Report& report);

/// Writes summary.json, junit.xml and index.html. Error: CannotWrite.
[[nodiscard]] Status writeReport(const Report& report);

}  // namespace dollytrack::batch
