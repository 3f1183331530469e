#include "planning/baselines/judge.h"
#include "planning/baselines/median.h"

#include <numeric>

namespace dollytrack::planning {
namespace {

template <class Combine>
JudgedRow byColumn(const std::vector<JudgedRow>& rows, Combine&& combine) {
    JudgedRow result(judgedMetrics().size());
    for (std::size_t column = 0; column < result.size(); ++column) {
        std::vector<double> values;
        for (const JudgedRow& row : rows) {
            if (row[column]) values.push_back(*row[column]);
        }
        if (!values.empty()) result[column] = combine(values);
    }
    return result;
}

}  // namespace

const std::vector<MetricInfo>& judgedMetrics() {
    static const std::vector<MetricInfo> metrics = [] {
        std::vector<MetricInfo> list;
        const Judgement none;
        visitJudgement(none, [&](const MetricInfo& info, const auto&) { list.push_back(info); });
        return list;
    }();
    return metrics;
}

JudgedRow toRow(const Judgement& judgement) {
    JudgedRow row;
    visitJudgement(judgement, [&](const MetricInfo&, const auto& value) {
        if constexpr (requires { value.has_value(); }) {
            row.push_back(value);
        } else {
            row.emplace_back(static_cast<double>(value));
        }
    });
    return row;
}

JudgedRow medianOf(const std::vector<JudgedRow>& rows) {
    return byColumn(rows, [](const std::vector<double>& values) { return median(values); });
}

JudgedRow meanOf(const std::vector<JudgedRow>& rows) {
    return byColumn(rows, [](const std::vector<double>& values) {
        return std::accumulate(values.begin(), values.end(), 0.0) /
               static_cast<double>(values.size());
    });
}

}  // namespace dollytrack::planning
