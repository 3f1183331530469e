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

bool makeSamePlan(const PlanParams& a, const PlanParams& b) {
    PlanParams c = b;
    c.imu = a.imu;
    c.stereo = a.stereo;
    c.picture = a.picture;
    c.sensor = a.sensor;
    c.light = a.light;
    return a == c;
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
