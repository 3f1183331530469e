#include "app/outcomes/outcome_report.h"

#include "app/cli/compare/comparison.h"
#include "engine/core/clean_text.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace dollytrack::outcomes {
namespace {

using Json = nlohmann::ordered_json;

/// The row of the entry, or of its planner's scenes together ("all"); null if neither exists.
const Json* rowOfEntry(const Json& rows, const Entry& entry) {
    for (const std::string& scene : {entry.scene, std::string("all")}) {
        for (const Json& row : rows) {
            if (row.value("planner", Json()) == entry.planner &&
                row.value("scene", Json()) == scene && row.value("seed", Json()) == entry.seed) {
                return &row;
            }
        }
    }
    return nullptr;
}

tl::unexpected<Error> malformed(const std::string& what) {
    return fail(ErrorCode::BadInput, what, "result.json");
}

/// All value names in the rows, with their units and directions.
std::vector<Metric> metricsIn(const Json& json) {
    std::vector<Metric> metrics;
    const Json about = json.value("metrics", Json::object());
    const auto text = [&](const std::string& name, const char* key) {
        const bool has = about.is_object() && about.contains(name) && about[name].is_object() &&
                         about[name].contains(key) && about[name][key].is_string();
        return has ? cleanText(about[name][key].get<std::string>()) : std::string();
    };
    for (const Json& row : json["rows"]) {
        for (const auto& [name, value] : row["values"].items()) {
            const bool known =
                std::ranges::any_of(metrics, [&](const Metric& one) { return one.name == name; });
            if (!known) metrics.push_back({name, text(name, "unit"), text(name, "better")});
        }
    }
    return metrics;
}

Status checkRows(const Json& json) {
    if (!json.is_object() || !json.contains("rows") || !json["rows"].is_array()) {
        return malformed("The judge's result has no list 'rows'.");
    }
    for (std::size_t i = 0; i < json["rows"].size(); ++i) {
        const Json& row = json["rows"][i];
        if (!row.is_object() || !row.contains("values") || !row["values"].is_object()) {
            return malformed(fmt::format("Row {} of the judge's result has no 'values'.", i + 1));
        }
        for (const auto& [name, value] : row["values"].items()) {
            if (value.is_null() || (value.is_number() && std::isfinite(value.get<double>()))) {
                continue;
            }
            return malformed(
                fmt::format("'{}' in row {} of the judge's result is neither a number nor null.",
                            cleanText(name), i + 1));
        }
    }
    return {};
}

/// Relative comparison, to ignore differences from the order of summation.
bool nearlyEqual(const std::optional<double>& a, const std::optional<double>& b) {
    if (!a || !b) return a.has_value() == b.has_value();
    return std::abs(*a - *b) <= 1e-9 * std::max({1.0, std::abs(*a), std::abs(*b)});
}

const Row* rowOf(const std::vector<Row>& rows, const std::string& planner) {
    const auto found = std::ranges::find(rows, planner, &Row::planner);
    return found == rows.end() ? nullptr : &*found;
}

/// Whether `value` is at least as bad as `other`; a missing value is worst.
bool noBetter(const Metric& metric, const std::optional<double>& value,
              const std::optional<double>& other) {
    if (!value || !other) return !value;
    return metric.better == "higher" ? *value <= *other : *value >= *other;
}

/// Indices of the metrics that at least one planner has.
std::vector<std::size_t> measuredMetrics(const JudgeOutcome& outcome,
                                         const std::vector<Row>& rows) {
    std::vector<std::size_t> measured;
    for (std::size_t m = 0; m < outcome.metrics.size(); ++m) {
        const bool any =
            std::ranges::any_of(rows, [&](const Row& row) { return row.values[m].has_value(); });
        if (any) measured.push_back(m);
    }
    return measured;
}

/// Metrics in which this planner is better than another one.
std::vector<std::string> notWorstIn(const JudgeOutcome& outcome, const std::vector<Row>& rows,
                                    const Row& stare, int& asked) {
    std::vector<std::string> names;
    for (const std::size_t m : measuredMetrics(outcome, rows)) {
        const Metric& metric = outcome.metrics[m];
        if (metric.better.empty()) continue;
        ++asked;
        const bool worst = std::ranges::all_of(
            rows, [&](const Row& row) { return noBetter(metric, stare.values[m], row.values[m]); });
        if (!worst) names.push_back(metric.name);
    }
    return names;
}

std::string titleOf(const JudgeOutcome& outcome) {
    return outcome.judge + ": " + (outcome.versions.empty() ? outcome.state : outcome.versions);
}

std::string aligned(const std::vector<std::vector<std::string>>& rows) {
    std::string text;
    for (const auto& row : rows) {
        for (std::size_t i = 0; i < row.size(); ++i) {
            std::size_t width = 0;
            for (const auto& other : rows) width = std::max(width, other[i].size());
            text += i == 0 ? fmt::format("  {:<{}}", row[i], width)
                           : fmt::format("  {:>{}}", row[i], width);
        }
        text += "\n";
    }
    return text;
}

Json valuesJson(const JudgeOutcome& outcome, const Row& row) {
    Json values = Json::object();
    for (std::size_t i = 0; i < outcome.metrics.size(); ++i) {
        Json value;
        if (row.values[i]) value = *row.values[i];
        values[outcome.metrics[i].name] = std::move(value);
    }
    return values;
}

Json judgeJson(const JudgeOutcome& outcome) {
    Json json = {{"judge", outcome.judge},    {"text", outcome.text},
                 {"state", outcome.state},    {"versions", outcome.versions},
                 {"metrics", Json::object()}, {"rows", Json::array()},
                 {"mean", Json::array()},     {"notes", outcome.notes}};
    for (const Metric& metric : outcome.metrics) {
        json["metrics"][metric.name] = {{"unit", metric.unit}, {"better", metric.better}};
    }
    for (const Row& row : outcome.rows) {
        json["rows"].push_back({{"planner", row.planner},
                                {"scene", row.scene},
                                {"seed", row.seed},
                                {"values", valuesJson(outcome, row)}});
    }
    for (const Row& row : meanRows(outcome)) {
        json["mean"].push_back({{"planner", row.planner}, {"values", valuesJson(outcome, row)}});
    }
    return json;
}

}  // namespace

std::vector<Row> emptyRows(const std::vector<Entry>& entries) {
    std::vector<Row> rows;
    for (const Entry& entry : entries) rows.push_back({entry.planner, entry.scene, entry.seed, {}});
    return rows;
}

Status readResult(const Json& json, const std::vector<Entry>& entries, JudgeOutcome& result) {
    if (Status status = checkRows(json); !status) return status;
    JudgeOutcome outcome = result;  // `result` stays unchanged on errors
    outcome.metrics = metricsIn(json);
    outcome.rows.clear();
    for (const Entry& entry : entries) {
        Row row{entry.planner, entry.scene, entry.seed, {}};
        row.values.resize(outcome.metrics.size());
        const Json* found = rowOfEntry(json["rows"], entry);
        if (found == nullptr && !entry.dataset.empty()) {
            return malformed(fmt::format("The judge's result has no row of {} in {}, seed {}.",
                                         entry.planner, entry.scene, entry.seed));
        }
        for (std::size_t i = 0; found != nullptr && i < row.values.size(); ++i) {
            const auto value = (*found)["values"].find(outcome.metrics[i].name);
            if (value != (*found)["values"].end() && value->is_number()) {
                row.values[i] = value->get<double>();
            }
        }
        outcome.rows.push_back(std::move(row));
    }
    if (json.contains("versions") && json["versions"].is_string()) {
        outcome.versions = cleanText(json["versions"].get<std::string>());
    }
    for (const Json& note : json.value("notes", Json::array())) {
        if (note.is_string()) outcome.notes.push_back(cleanText(note.get<std::string>()));
    }
    result = std::move(outcome);
    return {};
}

std::vector<Row> meanRows(const JudgeOutcome& outcome) {
    std::vector<Row> means;
    for (const Row& row : outcome.rows) {
        if (rowOf(means, row.planner) != nullptr) continue;
        Row mean{row.planner, "", 0, {}};
        for (std::size_t i = 0; i < outcome.metrics.size(); ++i) {
            double sum = 0.0;
            int count = 0;
            for (const Row& one : outcome.rows) {
                if (one.planner != row.planner || !one.values[i]) continue;
                sum += *one.values[i];
                ++count;
            }
            mean.values.push_back(count > 0 ? std::optional(sum / count) : std::nullopt);
        }
        means.push_back(std::move(mean));
    }
    return means;
}

std::vector<std::string> controlNotes(const JudgeOutcome& outcome, const std::string& planner,
                                      const std::string& again, const std::string& stare) {
    const std::vector<Row> rows = meanRows(outcome);
    const Row* first = rowOf(rows, planner);
    const Row* second = rowOf(rows, again);
    const Row* bad = rowOf(rows, stare);
    if (first == nullptr || second == nullptr || bad == nullptr) return {};
    if (measuredMetrics(outcome, rows).empty()) return {};
    std::vector<std::string> different;
    for (std::size_t m = 0; m < outcome.metrics.size(); ++m) {
        if (!nearlyEqual(first->values[m], second->values[m])) {
            different.push_back(outcome.metrics[m].name);
        }
    }
    int asked = 0;
    const std::vector<std::string> not_worst = notWorstIn(outcome, rows, *bad, asked);
    std::string worst = fmt::format("Control: {} is worst or tied in {} of {} values", stare,
                                    asked - static_cast<int>(not_worst.size()), asked);
    if (!not_worst.empty()) worst += fmt::format("; not in {}", fmt::join(not_worst, ", "));
    return {different.empty() ? fmt::format("Control: {} equals {}.", again, planner)
                              : fmt::format("Control: {} differs from {} in {}.", again, planner,
                                            fmt::join(different, ", ")),
            worst + "."};
}

std::string shown(const Metric& metric, const std::optional<double>& value) {
    if (!value) return "-";
    if (metric.unit == "%") return fmt::format("{:.1f}", 100.0 * *value);
    return fmt::format("{:.4g}", *value);
}

std::string outcomeText(const OutcomeReport& report) {
    std::string text;
    for (const JudgeOutcome& outcome : report.judges) {
        text += titleOf(outcome) + "\n";
        if (!outcome.metrics.empty()) {
            std::vector<std::vector<std::string>> rows(2);
            rows[0].emplace_back();
            rows[1].emplace_back("planner");
            for (const Metric& metric : outcome.metrics) {
                rows[0].push_back(metric.name);
                rows[1].push_back(metric.unit);
            }
            for (const Row& row : meanRows(outcome)) {
                rows.push_back({row.planner});
                for (std::size_t i = 0; i < outcome.metrics.size(); ++i) {
                    rows.back().push_back(shown(outcome.metrics[i], row.values[i]));
                }
            }
            text += aligned(rows);
        }
        for (const std::string& note : outcome.notes) text += "  " + note + "\n";
        text += "\n";
    }
    for (const std::string& note : report.notes) text += note + "\n";
    return text;
}

std::string outcomeCsv(const OutcomeReport& report) {
    std::string text = "scene,planner,seed,frames";
    for (const JudgeOutcome& outcome : report.judges) {
        // A judge without values gets an empty column, so that its absence is visible.
        if (outcome.metrics.empty()) text += fmt::format(",{}", cli::csvField(outcome.judge));
        for (const Metric& metric : outcome.metrics) {
            text += fmt::format(",{}", cli::csvField(outcome.judge + "." + metric.name));
        }
    }
    text += ",notes\n";
    std::string notes;
    for (const JudgeOutcome& outcome : report.judges) {
        for (const std::string& note : outcome.notes) {
            notes += (notes.empty() ? "" : " ") + outcome.judge + ": " + note;
        }
    }
    for (std::size_t i = 0; i < report.entries.size(); ++i) {
        const Entry& entry = report.entries[i];
        text += cli::csvField(entry.scene) + "," + cli::csvField(entry.planner) +
                fmt::format(",{},{}", entry.seed, entry.frames);
        for (const JudgeOutcome& outcome : report.judges) {
            if (outcome.metrics.empty()) text += ",";
            for (const auto& value : outcome.rows[i].values) {
                text += value ? fmt::format(",{:.9g}", *value) : ",";
            }
        }
        text += fmt::format(",{}\n", cli::csvField(notes));
    }
    return text;
}

std::string outcomeJson(const OutcomeReport& report) {
    Json json = {{"entries", Json::array()}, {"judges", Json::array()}, {"notes", report.notes}};
    for (const Entry& entry : report.entries) {
        json["entries"].push_back({{"planner", entry.planner},
                                   {"scene", entry.scene},
                                   {"seed", entry.seed},
                                   {"frames", entry.frames},
                                   {"dataset", entry.dataset.string()}});
    }
    for (const JudgeOutcome& outcome : report.judges) json["judges"].push_back(judgeJson(outcome));
    return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace dollytrack::outcomes
