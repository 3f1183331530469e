#pragma once

#include "planning/pipeline/pipeline.h"

#include <map>
#include <memory>
#include <vector>

namespace dollytrack::planning {

/// A plan's inputs with something changed.
struct PlanChange {
    PlanParams params;
    PlanEdits edits;
    int without_object = 0;  // id of an object that is taken out of the scene; 0: none
    bool operator==(const PlanChange&) const = default;
};

/// Plans again with changes, to see what they do. Remembers outcomes, since what helps one object
/// is often tried for the next.
class PlanTrials {
  public:
    explicit PlanTrials(std::shared_ptr<const Scene> scene) : scene_(std::move(scene)) {}

    /// Null when it cannot be planned at all, or the job was cancelled.
    std::shared_ptr<const Plan> run(const PlanChange& change, const JobContext& job);

    /// The planning of the whole scene or of the scene without an object, as of its last run.
    Pipeline& pipeline(int without_object = 0);

    /// The scene, or a copy without the triangles of an object; ids stay.
    std::shared_ptr<const Scene> scene(int without_object = 0);

  private:
    std::shared_ptr<const Scene> scene_;
    std::map<int, std::shared_ptr<const Scene>> without_;
    std::map<int, Pipeline> pipelines_;  // by the object that is taken out
    std::vector<std::pair<PlanChange, std::shared_ptr<const Plan>>> known_;
};

}  // namespace dollytrack::planning
