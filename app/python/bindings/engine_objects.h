#pragma once

#include "app/cli/export/dataset_export.h"
#include "app/cli/plan/planned_scene.h"
#include "app/cli/scene_arguments.h"
#include "app/python/bindings/waiting.h"
#include "planning/pipeline/pipeline.h"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack::python {

/// A scene or project that was opened. What Python sees of it never changes.
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

    /// Metrics of a trajectory of any origin, as JSON. `poses`: N x 4 x 4, world_from_camera.
    [[nodiscard]] std::string judge(const pybind11::array& poses, const pybind11::array& times_s,
                                    const pybind11::array& paths,
                                    const cli::SceneArguments& arguments,
                                    const pybind11::object& progress) const;

    /// Work with the pipeline of this scene, which keeps what later plans can use again; with a new
    /// one where the scene is another one, or where another thread has it.
    Status withPipeline(const std::shared_ptr<const Scene>& scene,
                        const std::function<Status(planning::Pipeline&)>& work);

  private:
    const cli::OpenedScene opened_;
    std::mutex mutex_;  // of the pipeline
    std::optional<planning::Pipeline> pipeline_;
};

/// A trajectory planned in a scene, or the one that a project keeps.
class ScenePlan {
  public:
    ScenePlan(std::shared_ptr<OpenScene> scene, cli::OpenedScene opened, cli::PlannedScene planned)
        : scene_(std::move(scene)), opened_(std::move(opened)), planned_(std::move(planned)) {}

    static std::shared_ptr<ScenePlan> make(std::shared_ptr<OpenScene> scene,
                                           const cli::SceneArguments& arguments,
                                           const pybind11::object& progress);
    /// The plan that the project keeps; null where there is none.
    static std::shared_ptr<ScenePlan> stored(std::shared_ptr<OpenScene> scene,
                                             const pybind11::object& progress);

    [[nodiscard]] const cli::PlannedScene& planned() const { return planned_; }
    [[nodiscard]] std::string metricsJson() const;
    [[nodiscard]] std::string parametersJson() const;
    [[nodiscard]] pybind11::array poses() const;
    [[nodiscard]] pybind11::dict frames() const;
    [[nodiscard]] pybind11::tuple intrinsics() const;

    /// The ledger's rows of these objects, with what would help, as JSON.
    [[nodiscard]] std::string explain(const std::vector<int>& ids,
                                      const pybind11::object& progress) const;
    /// What budgets capture, as CSV; written to the files as well.
    [[nodiscard]] std::string coverage(const std::vector<std::string>& files,
                                       const pybind11::object& progress) const;
    void save(const std::string& file) const;
    /// Returns what `export --json` prints.
    [[nodiscard]] std::string exportTo(const cli::ExportOrder& order,
                                       const std::vector<std::string>& assignments,
                                       const pybind11::object& progress) const;

    /// The same plan with parameters that no plan depends on. Error: Usage for others.
    [[nodiscard]] Result<std::pair<cli::OpenedScene, cli::PlannedScene>> with(
        const std::vector<std::string>& assignments, const render::DatasetSettings& settings) const;

  private:
    [[nodiscard]] Status checkOwn() const;

    std::shared_ptr<OpenScene> scene_;
    cli::OpenedScene opened_;
    cli::PlannedScene planned_;
};

/// The frames of a plan, drawn one after the other on a thread that has the OpenGL context.
class PlanFrames {
  public:
    PlanFrames(const std::shared_ptr<ScenePlan>& plan, cli::ExportOrder order,
               const std::vector<std::string>& assignments, const pybind11::object& progress);
    ~PlanFrames();

    [[nodiscard]] int count() const { return count_; }
    /// Draws the next frame and returns (index, time, pose, {name: image}). Returns None after the
    /// last frame and after close().
    [[nodiscard]] pybind11::object next();
    /// Destroys the OpenGL context; while another thread draws, cancels that frame, after which the
    /// other thread closes.
    void close();

  private:
    std::vector<std::string> modalities_;
    std::shared_ptr<ScenePlan> plan_;
    cli::PlannedScene planned_;
    std::unique_ptr<const RayCaster> rays_;
    std::optional<render::FrameSeries> series_;
    int count_ = 0;
    bool busy_ = false;  // read and written with the GIL
    CancelFlag cancel_flag_ = std::make_shared<std::atomic<bool>>(false);
    std::unique_ptr<WorkThread> thread_;
};

}  // namespace dollytrack::python
