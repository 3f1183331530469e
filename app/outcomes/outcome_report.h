#pragma once

#include "engine/core/result.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack::outcomes {

/// The frames of one planner in one scene.
struct Entry {
    std::string planner;
    std::string scene;
    int seed = 1;
    std::filesystem::path dataset;  // empty when the export failed
    int frames = 0;
};

/// A value that a judge measures.
struct Metric {
    std::string name;
    std::string unit;    // "%": the value is a rate, 0..1
    std::string better;  // "higher", "lower" or empty
};

struct Row {
    std::string planner;
    std::string scene;
    int seed = 1;
    std::vector<std::optional<double>> values;  // in the order of the metrics
};

/// What one judge found, or why it found nothing: then its rows have no values.
struct JudgeOutcome {
    std::string judge;
    std::string text;      // what it measures
    std::string state;     // "done", "missing", "failed", "timed out"
    std::string versions;  // of the programs behind it
    std::vector<Metric> metrics;
    std::vector<Row> rows;  // one an entry, in the order of the entries
    std::vector<std::string> notes;
};

struct OutcomeReport {
    std::vector<Entry> entries;
    std::vector<JudgeOutcome> judges;
    std::vector<std::string> notes;  // of the frames
};

/// The rows of an outcome without any value.
std::vector<Row> emptyRows(const std::vector<Entry>& entries);

/// Takes over a judge's result.json. Error: BadInput for a result that does not keep to the rules,
/// with the place, and `result` as it was: every entry needs a row, each with its values.
Status readResult(const nlohmann::ordered_json& json, const std::vector<Entry>& entries,
                  JudgeOutcome& result);

/// Planner by planner the means over scenes and seeds. A mean is of those that have a value.
std::vector<Row> meanRows(const JudgeOutcome& outcome);

/// Results of the controls in the metrics that any planner has a value of: whether the planner that
/// is measured twice is equal, and in which metrics the camera at the wall is not the worst.
std::vector<std::string> controlNotes(const JudgeOutcome& outcome, const std::string& planner,
                                      const std::string& again, const std::string& stare);

/// A table a judge with the means of the planners, and the notes.
std::string outcomeText(const OutcomeReport& report);
/// A line for each scene, planner and seed, a column for each value, and one for notes.
std::string outcomeCsv(const OutcomeReport& report);
std::string outcomeJson(const OutcomeReport& report);
std::string outcomeHtml(const OutcomeReport& report);

/// A value as tables for people show it.
std::string shown(const Metric& metric, const std::optional<double>& value);

}  // namespace dollytrack::outcomes
