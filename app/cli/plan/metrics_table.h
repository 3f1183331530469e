#pragma once

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>

namespace dollytrack::cli {

/// The metrics of a plan as text: rates in %, and the uncaptured objects with their reasons.
std::string metricsTable(const nlohmann::json& metrics);

/// The scanned share of a scan's rooms as text; empty for a modelled scene.
std::string scannedText(std::optional<double> share);
/// The same, from a plan's metrics.
std::string scannedText(const nlohmann::json& metrics);

/// JSON text for stdout. Never throws: invalid UTF-8 is replaced.
std::string jsonText(const nlohmann::json& json);

}  // namespace dollytrack::cli
