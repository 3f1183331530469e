#include "app/batch/markup.h"
#include "app/batch/report.h"

#include <fmt/format.h>

namespace dollytrack::batch {
namespace {

/// JUnit distinguishes four outcomes: passed, skipped, failure (a requirement is not met) and error
/// (the job could not be run).
std::string endOf(const ReportRow& row) {
    const std::string message = asMarkup(complaintOf(row));
    const std::string verdict = asMarkup(verdictOf(row));
    switch (row.result.state) {
        case JobState::Done:
            return row.unmet.empty()
                       ? ""
                       : fmt::format("<failure type=\"{}\" message=\"{}\"/>", verdict, message);
        case JobState::NotRun:
        case JobState::Interrupted:
            return fmt::format("<skipped message=\"{}\"/>", message);
        default:
            return fmt::format("<error type=\"{}\" message=\"{}\"/>", verdict, message);
    }
}

}  // namespace

std::string reportJunit(const Report& report) {
    int failures = 0;
    int errors = 0;
    int skipped = 0;
    double seconds = 0.0;
    std::string cases;
    for (const ReportRow& row : report.rows) {
        const std::string end = endOf(row);
        failures += end.starts_with("<failure") ? 1 : 0;
        errors += end.starts_with("<error") ? 1 : 0;
        skipped += end.starts_with("<skipped") ? 1 : 0;
        seconds += row.result.seconds;
        cases += fmt::format("  <testcase classname=\"{}\" name=\"{}\" time=\"{:.3f}\">",
                             asMarkup(row.job.scene.filename().string()), asMarkup(row.job.name),
                             row.result.seconds);
        std::string properties;
        for (const auto& [name, value] : row.result.metrics.items()) {
            properties += fmt::format("\n    <property name=\"{}\" value=\"{}\"/>", asMarkup(name),
                                      asMarkup(value.dump()));
        }
        if (!properties.empty()) cases += "\n   <properties>" + properties + "\n   </properties>";
        if (!end.empty()) cases += "\n   " + end;
        cases += "\n  </testcase>\n";
    }
    const std::string counts =
        fmt::format("tests=\"{}\" failures=\"{}\" errors=\"{}\" skipped=\"{}\" time=\"{:.3f}\"",
                    report.rows.size(), failures, errors, skipped, seconds);
    return fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites {}>\n <testsuite name=\"{}\" "
        "{}>\n{} </testsuite>\n</testsuites>\n",
        counts, asMarkup(report.title), counts, cases);
}

}  // namespace dollytrack::batch
