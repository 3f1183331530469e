#pragma once

#include "app/cli/export/dataset_export.h"
#include "app/cli/plan/planned_scene.h"
#include "app/cli/scene_arguments.h"
#include "app/python/bindings/work_thread.h"
#include "planning/pipeline/pipeline.h"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack::python {

/// An opened scene or project; immutable for Python.
class OpenScene {
  public:
    explicit OpenScene(cli::OpenedScene opened) : opened_(std::move(opened)) {}

    static std::shared_ptr<OpenScene> open(const cli::SceneArguments& arguments,
                                           const pybind11::object& progress);

    [[nodiscard]] const Scene& scene() const { return *opened_.scene; }
    [[nodiscard]] const std::shared_ptr<const Scene>& shared() const { return opened_.scene; }
    [[nodiscard]] const cli::OpenedScene& opened() const { return opened_; }
    [[nodiscard]] std::string reportJson() const;
    [[nodiscard]] pybind11::list objects() const;

    /// Evaluates any trajectory in this scene; returns metrics as JSON. `poses`: N x 4 x 4,
    /// world_from_camera.
    [[nodiscard]] std::string judge(const pybind11::array& poses, const pybind11::array& times_s,
                                    const pybind11::array& paths,
                                    const cli::SceneArguments& arguments,
                                    const pybind11::object& progress) const;

    /// Runs `work` with the cached pipeline of this scene, which reuses earlier results; or with a
    /// new pipeline if the scene differs or another thread is using the cached one.
    Status withPipeline(const std::shared_ptr<const Scene>& scene,
                        const std::function<Status(planning::Pipeline&)>& work);

  private:
    const cli::OpenedScene opened_;
    std::mutex mutex_;  // guards pipeline_
    std::optional<planning::Pipeline> pipeline_;
};

/// A trajectory planned in a scene, or stored in a project.
class ScenePlan {
  public:
    ScenePlan(std::shared_ptr<OpenScene> scene, cli::OpenedScene opened, cli::PlannedScene planned)
        : scene_(std::move(scene)), opened_(std::move(opened)), planned_(std::move(planned)) {}

    static std::shared_ptr<ScenePlan> make(std::shared_ptr<OpenScene> scene,
                                           const cli::SceneArguments& arguments,
                                           const pybind11::object& progress);
    /// The project's stored plan; null if there is none.
    static std::shared_ptr<ScenePlan> stored(std::shared_ptr<OpenScene> scene,
                                             const pybind11::object& progress);

    [[nodiscard]] const cli::PlannedScene& planned() const { return planned_; }
    [[nodiscard]] std::string metricsJson() const;
    [[nodiscard]] std::string parametersJson() const;
    [[nodiscard]] pybind11::array poses() const;
    [[nodiscard]] pybind11::dict frames() const;
    [[nodiscard]] pybind11::tuple intrinsics() const;

    /// The ledger rows of these objects with remedies, as JSON.
    [[nodiscard]] std::string explain(const std::vector<int>& ids,
                                      const pybind11::object& progress) const;
    /// Coverage by budget as CSV; also written to the files.
    [[nodiscard]] std::string coverage(const std::vector<std::string>& files,
                                       const pybind11::object& progress) const;
    void save(const std::string& file) const;
    /// Returns what `export --json` prints.
    [[nodiscard]] std::string exportTo(const cli::ExportOrder& order,
                                       const std::vector<std::string>& assignments,
                                       const pybind11::object& progress) const;

    /// The same plan with changed parameters that do not affect planning. Error: Usage for other
    /// parameters.
    [[nodiscard]] Result<std::pair<cli::OpenedScene, cli::PlannedScene>> with(
        const std::vector<std::string>& assignments, const render::DatasetSettings& settings) const;

  private:
    [[nodiscard]] Status checkOwn() const;

    std::shared_ptr<OpenScene> scene_;
    cli::OpenedScene opened_;
    cli::PlannedScene planned_;
};

/// Iterator over the rendered frames of a plan. Rendering runs on a thread of its own, which owns
/// the OpenGL context.
class PlanFrames {
  public:
    PlanFrames(const std::shared_ptr<ScenePlan>& plan, cli::ExportOrder order,
               const std::vector<std::string>& assignments, const pybind11::object& progress);
    ~PlanFrames();

    [[nodiscard]] int count() const { return count_; }
    /// Draws the next frame and returns (index, time, pose, {name: image}). Returns None after the
    /// last frame and after close().
    [[nodiscard]] pybind11::object next();
    /// Destroys the OpenGL context. If another thread is rendering, its frame is cancelled and that
    /// thread destroys the context.
    void close();

  private:
    std::vector<std::string> modalities_;
    std::shared_ptr<ScenePlan> plan_;
    cli::PlannedScene planned_;
    std::unique_ptr<const RayCaster> rays_;
    std::optional<render::FrameSeries> series_;
    int count_ = 0;
    bool busy_ = false;  // guarded by the GIL
    CancelFlag cancel_flag_ = std::make_shared<std::atomic<bool>>(false);
    std::unique_ptr<WorkThread> thread_;
};

}  // namespace dollytrack::python
