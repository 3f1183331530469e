#include "engine/document/change_descriptions.h"
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

/// Describes all changes of a region, for the history.
std::string whatWasDone(const Region& before, const Region& after) {
    std::vector<std::string> done;
    if (!(before.box == after.box)) {
        done.push_back(fmt::format("{} {}", changeOf(before.box, after.box), before.name));
    }
    if (before.weight != after.weight) {
        done.push_back(fmt::format("Set the weight of {} to {:g}", before.name, after.weight));
    }
    if (before.must_see != after.must_see) {
        done.push_back(after.must_see
                           ? fmt::format("Require all of {} to be seen", before.name)
                           : fmt::format("No longer require all of {} to be seen", before.name));
    }
    if (before.name != after.name) {
        done.push_back(fmt::format("Rename {} to {}", before.name, after.name));
    }
    return done.empty() ? "Change " + after.name : fmt::format("{}", fmt::join(done, ", "));
}

}  // namespace

std::string addRegion(ProjectState& state, const OperationContext&, const OperationReader& fields) {
    std::vector<Region>& regions = state.edits.plan.regions;
    Region region;
    region.name = freeName(regions, fields, "region", "regions");
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
    const Region before = *found;
    if (fields.has("center") || fields.has("size") || fields.has("yaw_deg")) {
        found->box = fields.box(found->box);
    }
    readInterest(*found, fields);
    if (fields.has("to")) {
        const JsonReader to = fields.field("to");
        const std::string name = to.text();
        if (to.good() && name.empty()) to.refuse("A name must not be empty.");
        if (name != found->name && isTaken(regions, name)) {
            to.refuse(
                fmt::format("Another region is already called '{}'; choose another name.", name));
        }
        found->name = name;
    }
    return whatWasDone(before, *found);
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
