#include "planning/plan_params.h"

namespace dollytrack::planning {

FieldList listFields(PlanParams& params) {
    FieldCollector collector;
    visitPlanParams(
        params, [&](std::string_view section) { collector.beginSection(section); }, collector);
    return collector.take();
}

}  // namespace dollytrack::planning
