#pragma once

#include "planning/pipeline/pipeline.h"

#include <map>
#include <memory>
#include <vector>

namespace dollytrack::planning {

/// A plan's inputs with a change.
struct PlanChange {
    PlanParams params;
    PlanEdits edits;
    int without_object = 0;  // id of an object removed from the scene; 0: none
    bool operator==(const PlanChange&) const = default;
};

/// Plans again with changes, to test their effect. Caches results, since a change that helps one
/// object is often tried for the next.
class PlanTrials {
  public:
    explicit PlanTrials(std::shared_ptr<const Scene> scene) : scene_(std::move(scene)) {}

    /// Plans with a change, or returns the cached result. Null if planning fails or the job is
    /// cancelled.
    std::shared_ptr<const Plan> run(const PlanChange& change, const JobContext& job);

    /// The pipeline for the whole scene, or for the scene without an object, in the state of its
    /// last run.
    Pipeline& pipeline(int without_object = 0);

    /// The scene, or a copy without the triangles of an object; ids stay.
    std::shared_ptr<const Scene> scene(int without_object = 0);

  private:
    std::shared_ptr<const Scene> scene_;
    std::map<int, std::shared_ptr<const Scene>> without_;
    std::map<int, Pipeline> pipelines_;  // by removed object
    std::vector<std::pair<PlanChange, std::shared_ptr<const Plan>>> known_;
};

}  // namespace dollytrack::planning
