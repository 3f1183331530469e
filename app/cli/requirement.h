#pragma once

#include "engine/core/result.h"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace dollytrack::cli {

/// A condition on a metric, such as "well_captured_rate>=0.8"; exactly equal for "=".
struct Requirement {
    std::string metric;
    std::string comparison;  // ">=", "<=", ">", "<" or "="
    double value = 0.0;

    [[nodiscard]] bool holds(double measured) const;
};

/// Parses a condition; "==" is accepted for "=". Error: Usage if it is malformed.
Result<Requirement> parseRequirement(std::string_view text);

/// Parses several conditions. Error: Usage if one is malformed.
Result<std::vector<Requirement>> parseRequirements(const std::vector<std::string>& texts);

/// Checks that every requirement names a metric. Error: Usage, with the closest name.
Status checkNames(const std::vector<Requirement>& requirements, const nlohmann::json& metrics);

/// Whether all requirements hold; metrics without a value do not meet theirs, and the value of a
/// list is its length. Logs a warning for each that is not met. The names must have been checked.
bool areMet(const std::vector<Requirement>& requirements, const nlohmann::json& metrics);

}  // namespace dollytrack::cli
