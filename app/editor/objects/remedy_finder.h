#pragma once

#include "app/editor/project/live_planner.h"
#include "engine/jobs/background_worker.h"
#include "ui/panels/selection/selection_remedy.h"

#include <nlohmann/json.hpp>

#include <memory>
#include <optional>
#include <string>

namespace dollytrack::editor {

/// Searches in the background for a remedy: a change after which an object is captured. The answer
/// is dropped when the object or the plan changes.
class RemedyFinder {
  public:
    explicit RemedyFinder(std::function<void()> wake);

    void find(const PlanOutcome& shown, int object_id);
    void cancel();
    /// Drops the search with its plan and scene.
    void forget();
    /// The state of the search for this object in this plan.
    [[nodiscard]] ui::RemedySearch state(const PlanOutcome& shown, int object_id);
    /// The operations that apply the remedy (engine/plan/remedy_operations.h); empty if there
    /// is none.
    [[nodiscard]] nlohmann::json operations() const;
    /// Name of the remedy as a step of the history.
    [[nodiscard]] std::string name() const;

  private:
    struct Answer {
        std::uint64_t question = 0;
        Result<LedgerRow> row;
    };

    std::shared_ptr<const Plan> plan_;  // plan of the search
    std::shared_ptr<const Scene> scene_;
    int object_id_ = 0;
    std::uint64_t question_ = 0;
    bool searching_ = false;
    std::optional<Answer> answer_;
    std::shared_ptr<LatestValue<Answer>> answers_ = std::make_shared<LatestValue<Answer>>();
    BackgroundWorker worker_;
};

}  // namespace dollytrack::editor
