#include "planning/plan_params.h"


#include <nlohmann/json.hpp>

namespace dollytrack::planning {

FieldList listFields(PlanParams& params) {
    FieldCollector collector;
    visitPlanParams(
        params, [&](std::string_view section) { collector.beginSection(section); }, collector);
    FieldList fields = collector.take();
    letSensorPresetSetOthers(fields, params.sensor);
    letLightPresetSetOthers(fields, params.light);
    return fields;
}

PlanParams onlyOfThePlan(PlanParams params) {
    params.imu = {};
    params.stereo = {};
    params.picture = {};
    params.sensor = {};
    params.light = {};
    return params;
}

bool makeSamePlan(const PlanParams& a, const PlanParams& b) {
    return onlyOfThePlan(a) == onlyOfThePlan(b);
}

Status setParameter(nlohmann::json& sections, const std::string& name,
                    const nlohmann::json& value) {
    PlanParams params;
    const FieldList fields = listFields(params);
    return setFromJson(fields, sections)
        .and_then([&] {
            return setFromJson(fields, {{"parameters", {{name, value}}}});
        })
        .map([&] { sections = toJson(fields); });
}

}  // namespace dollytrack::planning
