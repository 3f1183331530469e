#pragma once

#include "engine/core/result.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack::outcomes {

/// The exported frames of one planner in one scene.
struct Entry {
    std::string planner;
    std::string scene;
    int seed = 1;
    std::filesystem::path dataset;  // empty if the export failed
    int frames = 0;
};

/// A value measured by a judge.
struct Metric {
    std::string name;
    std::string unit;    // "%": a rate, 0..1
    std::string better;  // "higher", "lower" or empty
};

struct Row {
    std::string planner;
    std::string scene;
    int seed = 1;
    std::vector<std::optional<double>> values;  // in the order of the metrics
};

/// The results of one judge. If it could not run, its rows have no values.
struct JudgeOutcome {
    std::string judge;
    std::string text;      // what it measures
    std::string state;     // "done", "missing", "failed", "timed out"
    std::string versions;  // versions of the evaluation programs
    std::vector<Metric> metrics;
    std::vector<Row> rows;  // one per entry, in the order of the entries
    std::vector<std::string> notes;
};

struct OutcomeReport {
    std::vector<Entry> entries;
    std::vector<JudgeOutcome> judges;
    std::vector<std::string> notes;  // notes on the exported frames
};

/// Rows without values, one per entry.
std::vector<Row> emptyRows(const std::vector<Entry>& entries);

/// Reads a judge's result.json. Error: BadInput, with the location, if it violates the protocol:
/// every entry with a dataset needs a row, and every value must be a number or null. Then `result`
/// is unchanged.
Status readResult(const nlohmann::ordered_json& json, const std::vector<Entry>& entries,
                  JudgeOutcome& result);

/// Means over scenes and seeds, by planner; missing values are ignored.
std::vector<Row> meanRows(const JudgeOutcome& outcome);

/// Notes on the controls: whether the repeated planner has equal values, and in which metrics the
/// camera facing a wall is not the worst. Empty if a control is missing.
std::vector<std::string> controlNotes(const JudgeOutcome& outcome, const std::string& planner,
                                      const std::string& again, const std::string& stare);

/// One text table per judge with the planners' means, and the notes.
std::string outcomeText(const OutcomeReport& report);
/// CSV with one line per scene, planner and seed, one column per value, and one for notes.
std::string outcomeCsv(const OutcomeReport& report);
std::string outcomeJson(const OutcomeReport& report);
std::string outcomeHtml(const OutcomeReport& report);

/// A formatted value for tables; "-" if it is missing.
std::string shown(const Metric& metric, const std::optional<double>& value);

}  // namespace dollytrack::outcomes
