#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace dollytrack::cli {

/// The metrics that --require can name for an export, from the output of `export --json`: those of
/// the plan, "counted." plus those counted from the pixels, "exported_frames", and the shares of
/// unusable images. For datasets per room, the counted metrics are null.
nlohmann::json exportMetrics(const nlohmann::json& printed);

/// All these metric names with placeholder values, to check names before the export. The planner
/// must be known.
nlohmann::json exportMetricsOf(const std::string& planner);

}  // namespace dollytrack::cli
