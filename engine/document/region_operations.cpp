#include "engine/document/named_entries.h"
#include "engine/document/operation_table.h"

namespace dollytrack {
namespace {

void readInterest(Region& region, const OperationReader& fields) {
    if (fields.has("weight"))
        region.weight = fields.field("weight").number(kSmallestWeight, kLargestWeight);
    if (!fields.has("must_see")) return;
    const JsonReader must_see = fields.field("must_see");
    if (!must_see.json().is_boolean()) must_see.refuse("This must be true or false.");
    if (must_see.good()) region.must_see = must_see.json().get<bool>();
}

}  // namespace

std::string addRegion(ProjectState& state, const OperationContext&, const OperationReader& fields) {
    std::vector<Region>& regions = state.edits.plan.regions;
    Region region;
    region.name = freeName(regions, fields, "region");
    region.box = fields.box({});
    readInterest(region, fields);
    std::string done = "Add " + region.name;
    regions.push_back(std::move(region));
    return done;
}

std::string changeRegion(ProjectState& state, const OperationContext&,
                         const OperationReader& fields) {
    std::vector<Region>& regions = state.edits.plan.regions;
    const auto found = findNamed(regions, fields.field("name"), "region");
    if (!fields.good()) return {};
    std::string done = "Change " + found->name;
    if (fields.has("center") || fields.has("size") || fields.has("yaw_deg")) {
        found->box = fields.box(found->box);
    }
    readInterest(*found, fields);
    if (fields.has("to")) {
        const JsonReader to = fields.field("to");
        const std::string name = to.text();
        if (to.good() && name.empty()) to.refuse("A name must not be empty.");
        if (name != found->name && isTaken(regions, name)) {
            to.refuse(fmt::format("Another region is called '{}' already.", name));
        }
        done = fmt::format("Rename {} to {}", found->name, name);
        found->name = name;
    }
    return done;
}

std::string removeRegion(ProjectState& state, const OperationContext&,
                         const OperationReader& fields) {
    std::vector<Region>& regions = state.edits.plan.regions;
    const auto found = findNamed(regions, fields.field("name"), "region");
    if (!fields.good()) return {};
    std::string done = "Remove " + found->name;
    regions.erase(found);
    return done;
}

}  // namespace dollytrack
