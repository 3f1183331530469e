#pragma once

#include "engine/camera/camera_params.h"
#include "engine/document/edits.h"
#include "engine/jobs/background_worker.h"
#include "engine/plan/plan.h"
#include "ui/overlays/layers.h"
#include "ui/overlays/legend.h"
#include "ui/overlays/picking.h"
#include "ui/selection.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack::editor {

/// The options of the free-space layer including its slice, for drawing and picking.
[[nodiscard]] ui::FreeSpaceOverlayOptions cellOptions(const ui::LayerSettings& settings);

/// Input of the overlay layers.
struct LayersRequest {
    std::shared_ptr<const Scene> scene;
    std::shared_ptr<const Plan> plan;
    std::shared_ptr<const FrameQuality> quality;  // of the plan; null: not measured
    ui::PictureClasses pictures;                  // of its frames; null: not known
    std::shared_ptr<const Trajectory> kept_plan;  // for comparison; null: none
    std::string kept_name;
    std::shared_ptr<const planning::FreeSpace> free_space;
    CameraParams camera;
    ui::LayerSettings settings;
    ui::Selection selection;
    // Ids of objects that were moved since the scene was built; their boxes are not drawn.
    std::vector<int> moved;
    // Ids of selected objects that the viewport leaves out; their boxes are not drawn either.
    std::vector<int> left_out;
    std::vector<int> local;  // object ids: only their points are shown; empty: all points
    std::vector<NoGoBox> no_go;
    std::vector<Region> regions;
    SharedMotion motion;        // the given camera motion, for its keys
    bool keys_planned = false;  // the plan is of this motion
    bool stepping = false;      // show the algorithm's steps instead of the roadmap
    double cone_half_angle_deg = 40.0;
    bool in_cone = false;  // the camera is inside the cone of the displayed candidates
    std::size_t step = 0;  // number of steps shown
    int frame = -1;        // current frame; -1: its camera is not drawn

    bool operator==(const LayersRequest&) const;
};

/// Whether an eye at this position (m, world) is inside the cone of the displayed candidates.
[[nodiscard]] bool looksFromCone(const LayersRequest& request, const Eigen::Vector3d& eye);

/// All overlay layers, bottom first.
struct Layers {
    std::vector<std::shared_ptr<const ui::PlanLayer>> layers;
    std::shared_ptr<const Plan> plan;  // the plan that the layers show
    int candidates_of = -1;            // observation point of the displayed candidates; -1: none

    /// The tagged elements under a pixel over all layers, the best first.
    [[nodiscard]] std::vector<ui::PickedElement> pick(const render::View& view,
                                                      const Eigen::Vector2d& pixel,
                                                      double scene_depth_m,
                                                      double pixel_scale) const;
};

/// Builds the layers in the background; each is rebuilt only if its input has changed.
class LayerBuilder {
  public:
    explicit LayerBuilder(std::function<void()> wake);
    ~LayerBuilder();

    /// Requests layers; does nothing if the request equals the previous one.
    void request(const LayersRequest& request);
    /// Takes the newest layers; returns whether they are new.
    bool poll();
    [[nodiscard]] const Layers& layers() const { return layers_; }
    [[nodiscard]] int candidateSearch() const { return layers_.candidates_of; }
    [[nodiscard]] bool busy() const { return worker_.state().busy; }

  private:
    struct WorkerState;
    std::optional<LayersRequest> last_;
    Layers layers_;
    std::shared_ptr<LatestValue<Layers>> made_ = std::make_shared<LatestValue<Layers>>();
    std::shared_ptr<WorkerState> worker_state_;
    BackgroundWorker worker_;
};

}  // namespace dollytrack::editor
