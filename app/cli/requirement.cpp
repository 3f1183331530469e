#include "app/cli/requirement.h"

#include "engine/core/field_list.h"
#include "engine/core/log.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <charconv>

namespace dollytrack::cli {

bool Requirement::holds(double measured) const {
    if (comparison == ">=") return measured >= value;
    if (comparison == "<=") return measured <= value;
    if (comparison == ">") return measured > value;
    if (comparison == "<") return measured < value;
    return measured == value;
}

Result<Requirement> parseRequirement(std::string_view text) {
    const auto broken = [&] {
        return fail(
            ErrorCode::Usage,
            fmt::format("'{}' is no condition; write it like well_captured_rate>=0.8.", text),
            "--require");
    };
    const std::size_t at = text.find_first_of("<>=");
    if (at == std::string_view::npos || at == 0) return broken();
    std::size_t end = at + 1;
    while (end < text.size() && text[end] == '=') ++end;
    Requirement requirement;
    requirement.metric = text.substr(0, at);
    requirement.comparison = text.substr(at, end - at);
    if (requirement.comparison == "==") requirement.comparison = "=";
    if (requirement.comparison.size() > 2) return broken();
    const char* last = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data() + end, last, requirement.value);
    if (error != std::errc() || stop != last) return broken();
    return requirement;
}

Status checkNames(const std::vector<Requirement>& requirements, const nlohmann::json& metrics) {
    for (const Requirement& requirement : requirements) {
        const auto found = metrics.find(requirement.metric);
        if (found != metrics.end() && found->is_number()) continue;
        std::vector<std::string> names;
        for (const auto& [name, value] : metrics.items()) {
            if (value.is_number()) names.push_back(name);  // rates and counts alike
        }
        const std::string close = closestName(requirement.metric, names);
        return fail(ErrorCode::Usage,
                    fmt::format("There is no metric '{}'{}", requirement.metric,
                                close.empty() ? "." : "; did you mean '" + close + "'?"),
                    "--require");
    }
    return {};
}

bool areMet(const std::vector<Requirement>& requirements, const nlohmann::json& metrics) {
    bool all = true;
    for (const Requirement& requirement : requirements) {
        const double measured = metrics.at(requirement.metric).get<double>();
        if (requirement.holds(measured)) continue;
        all = false;
        log::warn("require",
                  fmt::format("not met: {} is {:.4g}, required {} {:.4g}", requirement.metric,
                              measured, requirement.comparison, requirement.value));
    }
    return all;
}

}  // namespace dollytrack::cli
