#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace dollytrack::cli {

/// The metrics that --require can name of an export, from what `export --json` prints: those of the
/// plan, "counted." and those counted from the pixels, "exported_frames" and the shares of unusable
/// pictures. Of datasets one a room nothing is counted over all.
nlohmann::json exportMetrics(const nlohmann::json& printed);

/// All of these, with values of no meaning: to check names before any work. The planner must be
/// known.
nlohmann::json exportMetricsOf(const std::string& planner);

}  // namespace dollytrack::cli
