#pragma once

#include "app/editor/project/workspace.h"
#include "app/project/project_reader.h"
#include "engine/plan/frame_quality.h"
#include "planning/analysis/plan_comparison.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack::editor {

/// A plan beside the current one.
struct KeptPlan {
    std::string name;
    CommandStack::State state;  // parameters and edits from which it was planned
    std::shared_ptr<const Trajectory> trajectory;
    nlohmann::json metrics;  // see metricsJson()
};

/// The current plan; `quality` may be null. Requires Workspace::planIsCurrent().
[[nodiscard]] KeptPlan currentPlan(const Workspace& workspace, const FrameQuality* quality);

/// Compares the current plan (A) with one that is kept (B): an earlier one of this project, or that
/// of another project of the same scene.
class PlanComparison {
  public:
    explicit PlanComparison(std::function<void()> wake) : reader_(std::move(wake)) {}

    void keep(KeptPlan plan);
    /// Reads another project in the background, whose plan is then kept. Refused (see poll()) if it
    /// has no plan, or another scene or other import settings.
    void read(const std::filesystem::path& project, const Workspace& workspace);
    /// Makes the kept plan's parameters and edits those of the project, and keeps the current plan.
    /// Requires a kept plan and Workspace::planIsCurrent().
    void swap(Workspace& workspace, const FrameQuality* quality);
    void drop();
    /// To be called every frame: undoing or redoing a swap also exchanges the kept plan.
    void followUndo(const CommandStack::State& state);
    /// Takes the plan that read() has read. Returns the error, once, if it could not be read.
    [[nodiscard]] std::optional<Error> poll();

    [[nodiscard]] const KeptPlan* kept() const { return kept_ ? &*kept_ : nullptr; }
    /// The project that read() is reading; empty: none.
    [[nodiscard]] const std::filesystem::path& reading() const { return reader_.reading(); }
    void cancelReading() { reader_.cancel(); }
    /// The metrics of both plans; empty while the shown plan is not measured.
    [[nodiscard]] const std::vector<planning::ComparedMetric>& metrics(
        const PlanOutcome& shown, const std::shared_ptr<const FrameQuality>& quality);

  private:
    void forgetSwaps();

    std::optional<KeptPlan> kept_;
    std::optional<KeptPlan> swapped_;         // the plan that was B before the last swap
    std::vector<CommandStack::State> swaps_;  // the states that swaps made
    CommandStack::State followed_;            // by followUndo()
    std::vector<planning::ComparedMetric> metrics_;
    std::shared_ptr<const Plan> metrics_of_;  // null: to be computed
    std::shared_ptr<const FrameQuality> metrics_quality_;
    ProjectReader<KeptPlan> reader_;
};

}  // namespace dollytrack::editor
