#pragma once

#include "app/batch/batch_folder.h"
#include "app/batch/job_result.h"
#include "engine/core/result.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace dollytrack::batch {

/// A job and what came of it.
struct ReportRow {
    Job job;
    JobResult result;
    std::vector<std::string> unmet;  // requirements, with what was measured
};

/// Done, and all that is required is met.
[[nodiscard]] bool isGood(const ReportRow& row);
/// "good", "unmet", or the state of a job that is not done.
[[nodiscard]] std::string verdictOf(const ReportRow& row);
/// What is wrong with it, in a sentence; empty when it is good.
[[nodiscard]] std::string complaintOf(const ReportRow& row);

struct Report {
    std::string title;
    std::filesystem::path jobs_folder;  // the folder of the batch
    std::filesystem::path folder;       // where the report goes
    std::vector<std::string> require;
    std::vector<ReportRow> rows;

    /// A link from the report to a file in a job's folder.
    [[nodiscard]] std::string linkTo(const ReportRow& row, const std::string& file) const;
};

/// Puts jobs and results of the same order together. The requirements must be known to be good.
[[nodiscard]] std::vector<ReportRow> judge(const std::vector<Job>& jobs,
                                           std::vector<JobResult> results,
                                           const std::vector<std::string>& require);

/// Whether the requirements name metrics of these jobs, asked before any work. Error: Usage.
[[nodiscard]] Status checkRequirements(const std::vector<std::string>& require,
                                       const std::vector<Job>& jobs);

/// Numbers that a report shows of each job, where the job has them.
struct ShownMetric {
    const char* name;
    const char* title;
    const char* unit;  // "%": a rate, 0..1
};
[[nodiscard]] const std::vector<ShownMetric>& shownMetrics();
/// As people read it; empty where there is none.
[[nodiscard]] std::string shownValue(const ReportRow& row, const ShownMetric& metric);

[[nodiscard]] nlohmann::ordered_json reportJson(const Report& report);
[[nodiscard]] std::string reportJunit(const Report& report);
[[nodiscard]] std::string reportHtml(const Report& report);
/// A few lines for a terminal.
[[nodiscard]] std::string reportText(const Report& report);

/// summary.json, junit.xml and index.html. Error: CannotWrite.
[[nodiscard]] Status writeReport(const Report& report);

}  // namespace dollytrack::batch
