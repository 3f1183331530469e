#include "app/cli/requirement.h"

#include "engine/core/clean_text.h"
#include "engine/core/log.h"
#include "engine/core/name_hint.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>

namespace dollytrack::cli {
namespace {

/// Whether a metric can be compared: numbers, missing values (null), and lists, which are counted.
bool isMeasured(const nlohmann::json& metric) {
    return metric.is_number() || metric.is_null() || metric.is_array();
}

/// The name without the prefix of an export's metrics: "planned.trackable_rate".
std::string_view withoutPrefix(std::string_view metric) {
    return metric.substr(metric.rfind('.') + 1);
}

/// Whether a metric lies between 0 and 1.
bool isShare(std::string_view metric) {
    return metric.ends_with("_rate") || metric.ends_with("_share") ||
           withoutPrefix(metric).starts_with("area_share_");
}

/// Why a metric was not measured: "there is nothing to measure".
std::string_view reasonOfNoValue(std::string_view metric) {
    const std::string_view name = withoutPrefix(metric);
    if (name == "trackable_rate") {
        return "only trackability=on, motion_preset=slam or --quality measures it";
    }
    if (name.starts_with("surface_"))
        return "only objective=surface, objective=both or --quality measures it";
    return "there is nothing to measure";
}

}  // namespace

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
            fmt::format("'{}' is not a condition; write it like well_captured_rate>=0.8.", text),
            "--require");
    };
    const std::size_t at = std::min(text.find_first_of("<>="), text.size());
    if (at == text.size() || trimmed(text.substr(0, at)).empty()) return broken();
    std::size_t end = at + 1;
    while (end < text.size() && text[end] == '=') ++end;
    Requirement requirement;
    requirement.metric = trimmed(text.substr(0, at));
    requirement.comparison = text.substr(at, end - at);
    if (requirement.comparison == "==") requirement.comparison = "=";
    if (requirement.comparison.size() > 2) return broken();
    std::string_view number = trimmed(text.substr(end));
    const bool in_percent = number.ends_with('%');
    if (in_percent) number = trimmed(number.substr(0, number.size() - 1));
    const char* last = number.data() + number.size();
    const auto [stop, error] = std::from_chars(number.data(), last, requirement.value);
    if (error != std::errc() || stop != last) return broken();
    const bool share = isShare(requirement.metric);
    if (in_percent && !share) {
        return fail(ErrorCode::Usage,
                    fmt::format("'{}': only rates and shares are given in percent; write a "
                                "number without %.",
                                text),
                    "--require");
    }
    if (in_percent) requirement.value /= 100.0;
    if (share && (requirement.value < 0.0 || requirement.value > 1.0)) {
        return fail(ErrorCode::Usage,
                    fmt::format("'{}': {} lies between 0 and 1; write 0.9, for example, or 90%.",
                                text, requirement.metric),
                    "--require");
    }
    return requirement;
}

Result<std::vector<Requirement>> parseRequirements(const std::vector<std::string>& texts) {
    std::vector<Requirement> requirements;
    for (const std::string& text : texts) {
        Result<Requirement> one = parseRequirement(text);
        if (!one) return tl::unexpected(std::move(one.error()));
        requirements.push_back(std::move(*one));
    }
    return requirements;
}

Status checkNames(const std::vector<Requirement>& requirements, const nlohmann::json& metrics) {
    for (const Requirement& requirement : requirements) {
        const auto found = metrics.find(requirement.metric);
        if (found != metrics.end() && isMeasured(*found)) continue;
        std::vector<std::string> names;
        for (const auto& [name, value] : metrics.items()) {
            if (isMeasured(value)) names.push_back(name);
        }
        return fail(ErrorCode::Usage,
                    fmt::format("There is no metric '{}'{}", requirement.metric,
                                nameHint(requirement.metric, names)),
                    "--require");
    }
    return {};
}

bool areMet(const std::vector<Requirement>& requirements, const nlohmann::json& metrics) {
    bool all = true;
    for (const Requirement& requirement : requirements) {
        const nlohmann::json value = metrics.value(requirement.metric, nlohmann::json());
        if (!value.is_number() && !value.is_array()) {
            all = false;
            log::warn("require",
                      fmt::format("not met: {} has no value, because {}", requirement.metric,
                                  reasonOfNoValue(requirement.metric)));
            continue;
        }
        const double measured =
            value.is_array() ? static_cast<double>(value.size()) : value.get<double>();
        if (requirement.holds(measured)) continue;
        all = false;
        log::warn("require",
                  fmt::format("not met: {} is {:.4g}, required {} {:.4g}", requirement.metric,
                              measured, requirement.comparison, requirement.value));
    }
    return all;
}

}  // namespace dollytrack::cli
