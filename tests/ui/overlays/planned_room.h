#pragma once

#include "planning/free_space/free_space.h"
#include "planning/pipeline/pipeline.h"
#include "tests/support/scene_builder.h"

#include <memory>
#include <stdexcept>

namespace dollytrack::ui::fixture {

/// A scene with its plan and map.
struct PlannedRoom {
    std::shared_ptr<const Scene> scene;
    std::shared_ptr<const Plan> plan;
    std::shared_ptr<const planning::FreeSpace> free_space;
    std::shared_ptr<const RayCaster> rays;
    planning::PlanParams params;
};

inline PlannedRoom planRoom(const Scene& scene, const planning::PlanParams& params = {}) {
    PlannedRoom room;
    room.scene = std::make_shared<const Scene>(scene);
    room.params = params;
    planning::Pipeline pipeline(room.scene);
    auto plan = pipeline.run(params, JobContext{});
    if (!plan) throw std::runtime_error(describe(plan.error()));
    room.plan = *plan;
    room.free_space = pipeline.freeSpace();
    room.rays = pipeline.rays();
    return room;
}

}  // namespace dollytrack::ui::fixture
