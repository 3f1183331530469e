#include "planning/remedies/plan_trials.h"

#include <algorithm>

namespace dollytrack::planning {
namespace {

Scene takenOut(const Scene& scene, int object_id) {
    Scene rest = scene;
    Object& gone = rest.objects[object_id - 1];
    const auto first = static_cast<std::ptrdiff_t>(gone.first_triangle);
    const auto last = first + static_cast<std::ptrdiff_t>(gone.triangle_count);
    rest.triangles.erase(rest.triangles.begin() + first, rest.triangles.begin() + last);
    rest.triangle_material.erase(rest.triangle_material.begin() + first,
                                 rest.triangle_material.begin() + last);
    for (Object& object : rest.objects) {
        if (object.first_triangle > gone.first_triangle) {
            object.first_triangle -= gone.triangle_count;
        }
    }
    gone.triangle_count = 0;
    gone.role = Role::Excluded;
    return rest;
}

}  // namespace

std::shared_ptr<const Scene> PlanTrials::scene(int without_object) {
    if (without_object == 0) return scene_;
    auto& rest = without_[without_object];
    if (!rest) rest = std::make_shared<const Scene>(takenOut(*scene_, without_object));
    return rest;
}

Pipeline& PlanTrials::pipeline(int without_object) {
    return pipelines_.try_emplace(without_object, scene(without_object)).first->second;
}

std::shared_ptr<const Plan> PlanTrials::run(const PlanChange& change, const JobContext& job) {
    const auto known = std::find_if(known_.begin(), known_.end(),
                                    [&](const auto& entry) { return entry.first == change; });
    if (known != known_.end()) return known->second;
    const auto plan = pipeline(change.without_object).run(change.params, change.edits, job);
    if (job.cancelled()) return nullptr;
    known_.emplace_back(change, plan ? *plan : nullptr);
    return known_.back().second;
}

}  // namespace dollytrack::planning
