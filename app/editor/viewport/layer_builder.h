#pragma once

#include "engine/camera/camera_params.h"
#include "engine/document/edits.h"
#include "engine/jobs/background_worker.h"
#include "engine/plan/plan.h"
#include "ui/layers.h"
#include "ui/overlays/legend.h"
#include "ui/overlays/picking.h"
#include "ui/selection.h"

#include <memory>
#include <optional>
#include <vector>

namespace dollytrack::editor {

/// The free-space layer's options with its slice put in: for drawing and for picking.
[[nodiscard]] ui::FreeSpaceOverlayOptions cellOptions(const ui::LayerSettings& settings);

/// What the layers are made of.
struct LayersRequest {
    std::shared_ptr<const Scene> scene;
    std::shared_ptr<const Plan> plan;
    std::shared_ptr<const planning::FreeSpace> free_space;
    CameraParams camera;
    ui::LayerSettings settings;
    ui::Selection selection;
    std::vector<NoGoBox> no_go;
    std::vector<Region> regions;
    bool stepping = false;  // the algorithm's steps, instead of the whole roadmap
    double cone_half_angle_deg = 40.0;
    bool in_cone = false;  // the viewer is, of the candidates shown
    std::size_t step = 0;  // of the algorithm
    int frame = -1;        // where the camera is now

    bool operator==(const LayersRequest&) const;
};

/// Whether somebody at this place looks from inside the cone of the candidates that are shown.
[[nodiscard]] bool looksFromCone(const LayersRequest& request, const Eigen::Vector3d& eye);

/// Everything drawn over the scene, bottom first.
struct Layers {
    std::vector<std::shared_ptr<const ui::PlanLayer>> layers;
    std::shared_ptr<const Plan> plan;  // they show
    int candidates_of = -1;            // the observation point whose candidates are shown

    /// The tagged element under a pixel, the best of all layers.
    [[nodiscard]] std::optional<ui::PickedElement> pick(const render::View& view,
                                                        const Eigen::Vector2d& pixel,
                                                        double scene_depth_m,
                                                        double pixel_scale) const;
};

/// Makes the layers in the background, each only when what it shows has changed.
class LayerBuilder {
  public:
    explicit LayerBuilder(std::function<void()> wake);
    ~LayerBuilder();

    /// Cheap when nothing differs from the request before.
    void request(const LayersRequest& request);
    /// The newest layers; whether they are new since the last call.
    bool poll();
    [[nodiscard]] const Layers& layers() const { return layers_; }
    [[nodiscard]] int candidateSearch() const { return layers_.candidates_of; }
    [[nodiscard]] bool busy() const { return worker_.state().busy; }

  private:
    struct Desk;
    std::optional<LayersRequest> last_;
    Layers layers_;
    std::shared_ptr<Outbox<Layers>> made_ = std::make_shared<Outbox<Layers>>();
    std::shared_ptr<Desk> desk_;
    BackgroundWorker worker_;
};

}  // namespace dollytrack::editor
