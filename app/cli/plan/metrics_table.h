#pragma once

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>

namespace dollytrack::cli {

/// The metrics of a plan for a person: rates in %, and what was not captured, with the reasons.
std::string metricsTable(const nlohmann::json& metrics);

/// The share of a scan's rooms that was scanned, in words; empty for a modelled scene.
std::string scannedText(std::optional<double> share);
/// The same, from the metrics of a plan.
std::string scannedText(const nlohmann::json& metrics);

/// JSON for stdout. Never throws: bytes that are no UTF-8 are replaced.
std::string jsonText(const nlohmann::json& json);

}  // namespace dollytrack::cli
