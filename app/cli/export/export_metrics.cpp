#include "app/cli/export/export_metrics.h"

#include "app/cli/plan/baseline_plan.h"
#include "engine/plan/plan_json.h"
#include "render/formats/tables/dataset_card.h"

#include <nlohmann/json.hpp>

namespace dollytrack::cli {
namespace {

constexpr const char* kCounted = "counted.";

}  // namespace

nlohmann::json exportMetrics(const nlohmann::json& printed) {
    const bool one_a_room = printed.contains("rooms");
    const nlohmann::json all = one_a_room ? printed.at("rooms") : nlohmann::json::array({printed});
    nlohmann::json metrics = nlohmann::json::object();
    int frames = 0;
    for (const nlohmann::json& one : all) frames += one.at("frames").get<int>();
    if (!all.empty() && all.front().at("planned").is_object()) metrics = all.front()["planned"];
    const nlohmann::json none = captureMetricsJson({});
    for (const auto& [name, value] : none.items()) {
        // Rates of one room over the targets of all rooms would be misleading.
        metrics[kCounted + name] =
            one_a_room ? nlohmann::json() : printed.at("counted").value(name, nlohmann::json());
    }
    metrics["exported_frames"] = frames;
    for (const char* rate : render::kPictureRates) metrics[rate] = printed.at("pictures").at(rate);
    return metrics;
}

nlohmann::json exportMetricsOf(const std::string& planner) {
    const nlohmann::json pictures = render::pictureTallyJson({});
    return exportMetrics({{"frames", 0},
                          {"planned", metricsOf(planner)},
                          {"counted", captureMetricsJson({})},
                          {"pictures", pictures}});
}

}  // namespace dollytrack::cli
