#pragma once

#include "engine/core/result.h"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace dollytrack::cli {

/// A condition on a metric, such as "well_captured_rate>=0.8".
struct Requirement {
    std::string metric;
    std::string comparison;  // ">=", "<=", ">", "<" or "="
    double value = 0.0;

    [[nodiscard]] bool holds(double measured) const;
};

/// Error: Usage when it is not of that form.
Result<Requirement> parseRequirement(std::string_view text);

/// Error: Usage when one of them is not.
Result<std::vector<Requirement>> parseRequirements(const std::vector<std::string>& texts);

/// Error: Usage when a requirement names no number of the metrics; says the closest name.
Status checkNames(const std::vector<Requirement>& requirements, const nlohmann::json& metrics);

/// Whether all hold for metrics that have their names; a warning says which does not.
bool areMet(const std::vector<Requirement>& requirements, const nlohmann::json& metrics);

}  // namespace dollytrack::cli
