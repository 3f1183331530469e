#include "app/editor/project/live_planner.h"

#include "engine/document/apply_scene_edits.h"
#include "engine/geometry/ray_caster.h"
#include "planning/free_space/free_space.h"
#include "planning/pipeline/pipeline.h"

#include <algorithm>
#include <chrono>
#include <exception>

namespace dollytrack::editor {

namespace {

// Grace of an outdated run. A longer one would delay the plan for the final value of a drag.
constexpr BackgroundWorker::GracePeriod kPlanGracePeriod{std::chrono::milliseconds(900), 0.6};

}  // namespace

/// Used by the worker's thread only.
struct LivePlanner::WorkerState {
    /// The scene made by the edits of a request, and what was computed from it.
    struct EditedScene {
        std::shared_ptr<const Scene> imported;
        SceneEdits edits;
        SizeRules size_rules;
        std::shared_ptr<const Scene> scene;  // null: incomplete
        std::shared_ptr<const ObjectTrace> objects;
        std::vector<std::string> warnings;
        std::optional<planning::Pipeline> pipeline;

        /// Whether it has the objects that the request defines.
        [[nodiscard]] bool isOf(const PlanRequest& request) const {
            return scene && imported == request.imported &&
                   edits.definitions == request.state->edits.scene.definitions;
        }
    };
    EditedScene now;
    // The scene from before objects were last split or merged, so that undo needs no new map.
    EditedScene before;
    std::uint64_t geometry = 0;
    std::uint64_t objects_since = 0;

    /// Returns whether this is the first scene made from an imported file.
    Result<bool> prepareScene(const PlanRequest& request, const planning::PlanParams& params);
    void changeObjects(const PlanRequest& request);
};

/// Takes the previous scene if it has the requested objects; otherwise makes room for a new one.
void LivePlanner::WorkerState::changeObjects(const PlanRequest& request) {
    if (before.isOf(request)) {
        std::swap(now, before);
        objects_since = ++geometry;
        return;
    }
    // Two maps of a very large scene would need too much memory.
    constexpr std::size_t kMostTriangles = 4'000'000;
    const bool is_large = now.scene && now.scene->triangles.size() > kMostTriangles;
    if (before.imported != request.imported || is_large) before = {};
    if (now.scene && now.imported == request.imported && !is_large) before = std::move(now);
    now = {};
}

Result<bool> LivePlanner::WorkerState::prepareScene(const PlanRequest& request,
                                                    const planning::PlanParams& params) {
    const SceneEdits& edits = request.state->edits.scene;
    const bool same_file = now.scene && now.imported == request.imported;
    if (!now.isOf(request)) changeObjects(request);
    const SizeRules rules{params.targets.small_volume_m3, params.targets.size_ratio};
    const bool same_rules = now.size_rules.small_volume_m3 == rules.small_volume_m3 &&
                            now.size_rules.size_ratio == rules.size_ratio;
    const bool goes_on = now.scene != nullptr;
    if (goes_on && same_rules && now.edits == edits) return false;
    const bool same_geometry = goes_on && sameGeometry(now.edits, edits);
    Result<Scene> edited = applySceneEdits(*request.imported, edits, rules);
    if (!edited) return tl::unexpected(std::move(edited.error()));
    if (!goes_on) {
        now.objects =
            std::make_shared<const ObjectTrace>(traceObjects(*request.imported, edits.definitions));
    }
    now.imported = request.imported;
    now.edits = edits;
    now.size_rules = rules;
    const auto& all = edited->report.warnings;
    const std::size_t imported_ones = std::min(now.imported->report.warnings.size(), all.size());
    now.warnings.assign(all.begin() + static_cast<std::ptrdiff_t>(imported_ones), all.end());
    now.scene = std::make_shared<const Scene>(std::move(*edited));
    if (!same_geometry) ++geometry;
    if (!goes_on) objects_since = geometry;
    if (now.pipeline) {
        now.pipeline->setScene(now.scene, same_geometry);
    } else {
        now.pipeline.emplace(now.scene);
    }
    return !same_file;
}

LivePlanner::LivePlanner(std::function<void()> wake, BackgroundWorker::Clock clock)
    : outcomes_(std::make_shared<LatestValue<PlanOutcome>>()),
      worker_state_(std::make_shared<WorkerState>()),
      wake_(std::move(wake)),
      worker_(wake_, kPlanGracePeriod, std::move(clock)) {}

LivePlanner::~LivePlanner() = default;

void LivePlanner::start(PlanRequest request) {
    worker_.start([this, request = std::move(request), worker_state = worker_state_,
                   latest = outcomes_, wake = wake_](const JobContext& job) {
        const auto begin = std::chrono::steady_clock::now();
        PlanOutcome outcome;
        outcome.serial = request.serial;
        outcome.state = request.state;
        const auto publish = [&] {
            outcome.milliseconds =
                std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin)
                    .count();
            latest->put(outcome);
            wake();
        };
        const auto refuse = [&](Error error) {
            outcome.error = std::move(error);
            publish();
        };
        try {
            if (Status status =
                    setFromJson(planning::listFields(outcome.params), request.state->parameters);
                !status) {
                return refuse(std::move(status.error()));
            }
            const Result<bool> first = worker_state->prepareScene(request, outcome.params);
            if (!first) return refuse(first.error());
            outcome.scene = worker_state->now.scene;
            outcome.objects = worker_state->now.objects;
            outcome.geometry = worker_state->geometry;
            outcome.objects_since = worker_state->objects_since;
            outcome.warnings = worker_state->now.warnings;
            outcome.edits =
                findObjects(request.state->edits.plan, *worker_state->now.scene, outcome.warnings);
            // A new scene is shown before its plan.
            if (*first) publish();
            const auto collect = [&](std::shared_ptr<const Plan> plan, bool measured) {
                outcome.rays = worker_state->now.pipeline->rays();
                outcome.free_space = worker_state->now.pipeline->freeSpace();
                outcome.region = worker_state->now.pipeline->region();
                outcome.plan = std::move(plan);
                outcome.measured = measured;
                publish();
            };
            auto plan = worker_state->now.pipeline->run(outcome.params, outcome.edits, job,
                                                        [&](std::shared_ptr<const Plan> moving) {
                                                            collect(std::move(moving), false);
                                                            worker_.cancelOutdated();
                                                        });
            if (plan) return collect(std::move(*plan), true);
            if (plan.error().code == ErrorCode::Cancelled) return;  // a newer request is waiting
            outcome.error = std::move(plan.error());
            collect(nullptr, false);
        } catch (const std::exception& error) {
            worker_state->now.scene.reset();  // incomplete data is rebuilt next time
            outcome.plan = nullptr;
            outcome.measured = false;
            if (outcome.scene) {
                outcome.rays = worker_state->now.pipeline->rays();
                outcome.free_space = worker_state->now.pipeline->freeSpace();
            }
            refuse({ErrorCode::Failed,
                    std::string("Planning failed: ") + error.what() +
                        "; try a larger octree resolution.",
                    {}});
        }
    });
}

}  // namespace dollytrack::editor
