#pragma once

#include "engine/document/edits.h"
#include "planning/pipeline/pipeline.h"

#include <gtest/gtest.h>

#include <memory>

namespace dollytrack::planning::test_support {

/// The plan of a scene that must have one.
inline std::shared_ptr<const Plan> planOf(const Scene& scene, const PlanParams& params = {},
                                          const PlanEdits& edits = {}) {
    auto plan = Pipeline(std::make_shared<const Scene>(scene)).run(params, edits, JobContext{});
    EXPECT_TRUE(plan.has_value()) << describe(plan.error());
    return *plan;
}

inline std::shared_ptr<const Plan> planOf(const Scene& scene, const PlanEdits& edits,
                                          const PlanParams& params = {}) {
    return planOf(scene, params, edits);
}

}  // namespace dollytrack::planning::test_support
