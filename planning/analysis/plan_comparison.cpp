#include "planning/analysis/plan_comparison.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <string>
#include <string_view>

namespace dollytrack::planning {
namespace {

using enum Better;

/// The compared metrics. Unit and direction of those that all planners have are defined there.
const std::vector<MetricInfo>& comparedInfos() {
    static const std::vector<MetricInfo> infos = [] {
        std::vector<MetricInfo> list = {
            {"capture_rate", "captured", "", Neither},
            {"well_captured_rate", "well captured", "", Neither},
            {"small_capture_rate", "small captured", "", Neither},
            {"area_share_box", "box in image", "", Neither},
            {"object_pixels", "object pixels", "", Neither},
            {"must_see_rate", "must-see", "%", Higher},
            {"surface_seen_rate", "surface seen", "%", Higher},
            {"surface_covered_rate", "surface covered", "%", Higher},
            {"repair.after.mean_score", "image score", "", Higher},
            {"repeat_rate", "repeats", "", Neither},
            {"trackable_rate", "trackable", "", Neither},
            {"overlap_min_rate", "least overlap", "%", Higher},
            {"frame_collision_rate", "colliding frames", "", Neither},
            {"corner_collision_rate", "colliding corners", "", Neither},
            {"min_clearance_m", "clearance", "", Neither},
            {"frames", "frames", "", Neither},
            {"key_frames", "key frames", "", Neither},
            {"duration_s", "duration", "s", Neither},
            {"path_length_m", "path", "", Neither},
            {"speed_median_mps", "median speed", "", Neither},
            {"speed_max_mps", "max speed", "", Neither},
            {"turn_median_dps", "median turn", "", Neither},
            {"turn_max_dps", "max turn", "", Neither},
            {"jerk_max_mps3", "max jerk", "", Neither},
        };
        for (MetricInfo& info : list) {
            const auto known =
                std::ranges::find(plannerMetricInfos(), info.name, &MetricInfo::name);
            if (known == plannerMetricInfos().end()) continue;
            info.unit = known->unit;
            info.better = known->better;
        }
        return list;
    }();
    return infos;
}

/// The number at "repair.after.mean_score".
std::optional<double> numberAt(const nlohmann::json& metrics, std::string_view name) {
    const nlohmann::json* at = &metrics;
    while (true) {
        const std::size_t dot = name.find('.');
        if (!at->is_object()) return std::nullopt;
        const auto found = at->find(std::string(name.substr(0, dot)));
        if (found == at->end()) return std::nullopt;
        at = &*found;
        if (dot == std::string_view::npos) break;
        name.remove_prefix(dot + 1);
    }
    return at->is_number() ? std::optional(at->get<double>()) : std::nullopt;
}

std::optional<double> valueOf(const ComparablePlan& plan, std::string_view name) {
    if (name == "duration_s") return durationOf(plan.trajectory);
    // Without must-see regions the rate is 1, which says nothing.
    if (name == "must_see_rate" && !plan.metrics.contains("must_see")) return std::nullopt;
    return numberAt(plan.metrics, name);
}

}  // namespace

std::string ComparedMetric::title() const {
    return info.unit.empty() ? std::string(info.title)
                             : fmt::format("{} ({})", info.title, info.unit);
}

bool ComparedMetric::differs() const {
    return metricNumber(info, a) != metricNumber(info, b);
}

int ComparedMetric::betterA() const {
    if (!a || !b || !differs() || info.better == Better::Neither) return 0;
    return (*a > *b) == (info.better == Better::Higher) ? 1 : -1;
}

std::string ComparedMetric::differenceText() const {
    if (!a || !b || !differs()) return {};
    // Of the values as shown, so that the three numbers of a row agree.
    const std::string text = metricNumber(info, a);
    const std::size_t dot = text.find('.');
    const int digits = dot == std::string::npos ? 0 : static_cast<int>(text.size() - dot - 1);
    return fmt::format("{:+.{}f}", std::stod(text) - std::stod(metricNumber(info, b)), digits);
}

std::vector<ComparedMetric> comparePlans(const ComparablePlan& a, const ComparablePlan& b) {
    std::vector<ComparedMetric> compared;
    for (const MetricInfo& info : comparedInfos()) {
        ComparedMetric one{info, valueOf(a, info.name), valueOf(b, info.name)};
        if (one.a || one.b) compared.push_back(std::move(one));
    }
    return compared;
}

}  // namespace dollytrack::planning
