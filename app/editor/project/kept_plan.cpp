#include "app/editor/project/kept_plan.h"

#include "app/project/read_project.h"
#include "engine/core/field_list.h"
#include "engine/plan/plan_json.h"

#include <algorithm>
#include <utility>

namespace dollytrack::editor {
namespace {

/// The scene that a project must have, and how it must be imported.
struct WantedScene {
    std::string sha256;
    nlohmann::json import;
};

nlohmann::json metricsOf(const PlanOutcome& shown, const FrameQuality* quality) {
    nlohmann::json metrics = metricsJson(*shown.scene, *shown.plan);
    if (quality != nullptr) addFrameQuality(metrics, shown.plan->trajectory, *quality);
    return metrics;
}

Result<KeptPlan> readPlan(const std::filesystem::path& path, const WantedScene& wanted) {
    const std::string name = path.filename().string();
    Result<ProjectContent> content = readProject(path);
    if (!content) return tl::unexpected(std::move(content.error()));
    if (!isProjectFile(path) || content->result.is_null()) {
        return fail(ErrorCode::BadInput,
                    "It has no plan; open it here and save it, or write it with 'dollytrack plan'.",
                    name);
    }
    if (content->planned_sha256 != wanted.sha256 || content->import != wanted.import) {
        return fail(ErrorCode::BadInput,
                    "Its plan is for another scene, or for other import settings; choose a project "
                    "of the open scene.",
                    name);
    }
    auto trajectory =
        trajectoryFromJson(content->result.value("trajectory", nlohmann::json::object()));
    if (!trajectory) return tl::unexpected(std::move(trajectory.error()));
    KeptPlan plan;
    plan.name = name;
    plan.state = std::make_shared<const ProjectState>(ProjectState{
        toJson(planning::listFields(content->params)), content->import, content->edits});
    plan.trajectory = std::make_shared<const Trajectory>(std::move(*trajectory));
    plan.metrics = content->result.value("metrics", nlohmann::json::object());
    return plan;
}

}  // namespace

KeptPlan currentPlan(const Workspace& workspace, const FrameQuality* quality) {
    const PlanOutcome& shown = workspace.shown();
    const CommandStack& history = workspace.history();
    KeptPlan plan;
    plan.name = history.position() > 0     ? history.names()[history.position()]
                : workspace.path().empty() ? workspace.sceneFile().filename().string()
                                           : workspace.path().filename().string();
    plan.state = history.state();
    plan.trajectory = std::shared_ptr<const Trajectory>(shown.plan, &shown.plan->trajectory);
    plan.metrics = metricsOf(shown, quality);
    return plan;
}

void PlanComparison::keep(KeptPlan plan) {
    reader_.cancel();
    kept_ = std::move(plan);
    forgetSwaps();
    metrics_of_.reset();
}

void PlanComparison::read(const std::filesystem::path& project, const Workspace& workspace) {
    const WantedScene wanted{workspace.importedScene().source_sha256, workspace.importSettings()};
    reader_.start(project,
                  [wanted](const std::filesystem::path& path) { return readPlan(path, wanted); });
}

void PlanComparison::swap(Workspace& workspace, const FrameQuality* quality) {
    reader_.cancel();
    KeptPlan current = currentPlan(workspace, quality);
    if (swapped_ && *swapped_->state == *current.state) current.name = swapped_->name;
    workspace.setState(*kept_->state, "Swap with " + kept_->name);
    swaps_.push_back(workspace.history().state());
    swapped_ = std::exchange(kept_, std::move(current));
    metrics_of_.reset();
}

void PlanComparison::followUndo(const CommandStack::State& state) {
    const CommandStack::State before = std::exchange(followed_, state);
    const auto madeBySwap = [&](const CommandStack::State& one) {
        return std::ranges::find(swaps_, one) != swaps_.end();
    };
    if (before == state || !swapped_ || !(madeBySwap(before) || madeBySwap(state)) ||
        !(*state == *kept_->state)) {
        return;
    }
    std::swap(kept_, swapped_);
    metrics_of_.reset();
}

void PlanComparison::forgetSwaps() {
    swapped_.reset();
    swaps_.clear();
}

void PlanComparison::drop() {
    reader_.cancel();
    kept_.reset();
    forgetSwaps();
    metrics_.clear();
    metrics_of_.reset();
}

std::optional<Error> PlanComparison::poll() {
    std::optional<Result<KeptPlan>> plan = reader_.take();
    if (!plan) return std::nullopt;
    if (!*plan) return plan->error();
    kept_ = std::move(**plan);
    forgetSwaps();
    metrics_of_.reset();
    return std::nullopt;
}

const std::vector<planning::ComparedMetric>& PlanComparison::metrics(
    const PlanOutcome& shown, const std::shared_ptr<const FrameQuality>& quality) {
    if (metrics_of_ == shown.plan && metrics_quality_ == quality) return metrics_;
    metrics_of_.reset();
    metrics_quality_ = quality;
    metrics_.clear();
    if (kept_ && shown.plan && shown.measured) {
        metrics_of_ = shown.plan;
        metrics_ = planning::comparePlans({metricsOf(shown, quality.get()), shown.plan->trajectory},
                                          {kept_->metrics, *kept_->trajectory});
    }
    return metrics_;
}

}  // namespace dollytrack::editor
