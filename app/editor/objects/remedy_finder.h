#pragma once

#include "app/editor/project/live_planner.h"
#include "engine/jobs/background_worker.h"
#include "ui/panels/selection/selection_remedy.h"

#include <nlohmann/json.hpp>

#include <memory>
#include <optional>
#include <string>

namespace dollytrack::editor {

/// Looks in the background for what would get an object of a plan captured. An answer belongs to
/// its object and its plan: with another of either it is forgotten.
class RemedyFinder {
  public:
    explicit RemedyFinder(std::function<void()> wake);

    void find(const PlanOutcome& shown, int object_id);
    void cancel();
    /// Lets go of plan and scene as well.
    void forget();
    /// Where the search for this object in this plan is.
    [[nodiscard]] ui::RemedySearch state(const PlanOutcome& shown, int object_id);
    /// What applies the answer (engine/document/remedy_operations.h).
    [[nodiscard]] nlohmann::json operations() const;
    /// What that is called as a step of the history.
    [[nodiscard]] std::string name() const;

  private:
    struct Answer {
        std::uint64_t question = 0;
        Result<LedgerRow> row;
    };

    std::shared_ptr<const Plan> plan_;  // asked about
    std::shared_ptr<const Scene> scene_;
    int object_id_ = 0;
    std::uint64_t question_ = 0;
    bool searching_ = false;
    std::optional<Answer> answer_;
    std::shared_ptr<Outbox<Answer>> answers_ = std::make_shared<Outbox<Answer>>();
    BackgroundWorker worker_;
};

}  // namespace dollytrack::editor
