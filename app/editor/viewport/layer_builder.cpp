#include "app/editor/viewport/layer_builder.h"

#include "render/draw/storey_cutaway.h"
#include "render/overlays/trajectory_overlay.h"
#include "ui/overlays/camera_keys_overlay.h"
#include "ui/overlays/edge_shape.h"
#include "ui/overlays/grid_overlay.h"
#include "ui/overlays/palette.h"
#include "ui/overlays/steps_overlay.h"

#include <any>
#include <array>
#include <span>
#include <tuple>

namespace dollytrack::editor {
namespace {

using ui::PlanLayer;
using ui::Selection;

void addBoxEdges(render::Overlay& overlay, const OrientedBox& box, const Eigen::Vector4f& rgba,
                 double width_px) {
    const auto corner = [&](int x, int y, int z) {
        const Eigen::Vector3d in_box(x * box.half_size.x(), y * box.half_size.y(),
                                     z * box.half_size.z());
        return box.toWorld(in_box);
    };
    for (const int u : {-1, 1}) {
        for (const int v : {-1, 1}) {
            overlay.lines.push_back({corner(-1, u, v), corner(1, u, v), rgba, width_px});
            overlay.lines.push_back({corner(u, -1, v), corner(u, 1, v), rgba, width_px});
            overlay.lines.push_back({corner(u, v, -1), corner(u, v, 1), rgba, width_px});
        }
    }
}

/// A translucent box with opaque edges, in the selection's colour if selected.
void addFilledBox(render::Overlay& overlay, const OrientedBox& box, const Eigen::Vector4f& fill,
                  bool selected, double width_px) {
    overlay.boxes.push_back({box.center, box.half_size, fill, box.yaw});
    Eigen::Vector4f edges = selected ? ui::kSelectedColor : fill;
    if (!selected) edges.w() = 1.0F;
    addBoxEdges(overlay, box, edges, width_px);
}

/// The selection: boxes of objects with front arrows, or the cell.
PlanLayer selectionLayer(const LayersRequest& request) {
    PlanLayer layer;
    for (const int id : request.selection.objects) {
        if (id < 1 || static_cast<std::size_t>(id) > request.scene->objects.size()) continue;
        if (std::ranges::find(request.moved, id) != request.moved.end()) continue;
        if (std::ranges::find(request.left_out, id) != request.left_out.end()) continue;
        const Object& object = request.scene->object(id);
        addBoxEdges(layer.overlay, object.box, ui::kSelectedColor, 2.5);
        const double reach = object.box.half_size.head<2>().norm() + 0.15;
        layer.overlay.lines.push_back(
            {object.box.center, object.box.center + reach * object.front, ui::kSelectedColor, 2.0});
        render::OverlayMark tip;
        tip.at = object.box.center + reach * object.front;
        tip.shape = render::OverlayMark::Shape::Arrow;
        tip.direction = object.front;
        tip.rgba = ui::kSelectedColor;
        tip.size_px = 12.0;
        layer.overlay.marks.push_back(tip);
    }
    if (request.selection.kind == Selection::Kind::Voxel && request.free_space) {
        OrientedBox cell;
        cell.center = request.selection.place;
        cell.half_size.setConstant(0.5 * request.free_space->cellSizeAt(request.selection.place));
        addBoxEdges(layer.overlay, cell, ui::kSelectedColor, 2.5);
    }
    return layer;
}

PlanLayer noGoLayer(const std::vector<NoGoBox>& boxes, const Selection& selection) {
    PlanLayer layer;
    const Eigen::Vector4f red(0.92F, 0.26F, 0.20F, 0.30F);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        const bool selected =
            selection.kind == Selection::Kind::NoGoBox && selection.index == static_cast<int>(i);
        addFilledBox(layer.overlay, boxes[i].box, red, selected, selected ? 3.0 : 1.5);
    }
    layer.legend.title = "No-go boxes";
    layer.legend.entries.push_back({boxes.size() == 1 ? boxes.front().name : "no-go boxes",
                                    ui::LegendEntry::Shape::Block, red,
                                    static_cast<int>(boxes.size())});
    return layer;
}

/// Must-see regions have thick edges.
PlanLayer regionsLayer(const std::vector<Region>& regions, const Selection& selection) {
    PlanLayer layer;
    const Eigen::Vector4f green(0.30F, 0.75F, 0.45F, 0.15F);
    for (std::size_t i = 0; i < regions.size(); ++i) {
        const bool selected =
            selection.kind == Selection::Kind::Region && selection.index == static_cast<int>(i);
        addFilledBox(layer.overlay, regions[i].box, green, selected,
                     regions[i].must_see ? 2.5 : 1.0);
    }
    layer.legend.title = "Regions";
    layer.legend.entries.push_back({regions.size() == 1 ? regions.front().name : "regions",
                                    ui::LegendEntry::Shape::Block, green,
                                    static_cast<int>(regions.size())});
    return layer;
}

/// The camera of the current frame.
PlanLayer cameraLayer(const LayersRequest& request) {
    PlanLayer layer;
    const auto& frames = request.plan->trajectory.frames;
    if (request.frame < 0 || static_cast<std::size_t>(request.frame) >= frames.size()) return layer;
    const Pose& pose = frames[request.frame].pose;
    render::addFrustum(layer.overlay, pose, request.camera, 0.45, {1, 1, 1, 1}, 2.5);
    layer.overlay.marks.push_back(
        {pose.position, render::OverlayMark::Shape::Dot, {1, 1, 1, 1}, 11.0});
    return layer;
}

/// Index of the observation point that covers an object; -1: none.
int observationPointOf(const Plan& plan, int object) {
    for (std::size_t i = 0; i < plan.observation_points.size(); ++i) {
        const std::vector<int>& objects = plan.observation_points[i].objects;
        if (std::ranges::find(objects, object) != objects.end()) return static_cast<int>(i);
    }
    return -1;
}

ui::PointsOverlayOptions pointsOptions(const LayersRequest& request) {
    ui::PointsOverlayOptions options = request.settings.point_options;
    options.objects = request.local;
    const Selection& selection = request.selection;
    if (selection.kind == Selection::Kind::ObservationPoint) {
        options.selected_observation_point = selection.index;
    }
    if (selection.kind == Selection::Kind::PositionPoint) {
        options.selected_position_point = selection.index;
    }
    return options;
}

ui::CandidatesOverlayOptions candidatesOptions(const LayersRequest& request) {
    ui::CandidatesOverlayOptions options;
    options.cone = request.settings.cone;
    options.shown = request.settings.candidate_kinds;
    options.cone_half_angle_deg = request.cone_half_angle_deg;
    options.cone_filled = !request.in_cone;
    const Selection& selection = request.selection;
    options.observation_point = -1;
    options.selected_candidate = -1;
    switch (selection.kind) {
        case Selection::Kind::Object:
            options.observation_point =
                observationPointOf(*request.plan, selection.objects.front());
            break;
        case Selection::Kind::ObservationPoint:
            options.observation_point = selection.index;
            break;
        case Selection::Kind::Candidate:
            options.observation_point = selection.search;
            options.selected_candidate = selection.index;
            break;
        default:
            break;
    }
    return options;
}

ui::RoadmapOverlayOptions roadmapOptions(const LayersRequest& request) {
    ui::RoadmapOverlayOptions options = request.settings.roadmap_options;
    if (request.selection.kind == Selection::Kind::Edge) {
        options.selected_edge = request.selection.index;
    }
    if (request.selection.kind == Selection::Kind::RefusedEdge) {
        options.selected_refused = request.selection.index;
    }
    return options;
}

}  // namespace

ui::FreeSpaceOverlayOptions cellOptions(const ui::LayerSettings& settings) {
    ui::FreeSpaceOverlayOptions options = settings.cells;
    options.slice = settings.sliced ? std::optional(settings.slice) : std::nullopt;
    return options;
}

bool LayersRequest::operator==(const LayersRequest& other) const {
    return scene == other.scene && plan == other.plan && quality == other.quality &&
           pictures == other.pictures && kept_plan == other.kept_plan &&
           kept_name == other.kept_name && free_space == other.free_space &&
           camera == other.camera && settings == other.settings && stepping == other.stepping &&
           cone_half_angle_deg == other.cone_half_angle_deg && selection == other.selection &&
           in_cone == other.in_cone && moved == other.moved && left_out == other.left_out &&
           local == other.local && no_go == other.no_go && regions == other.regions &&
           motion == other.motion && keys_planned == other.keys_planned && step == other.step &&
           frame == other.frame;
}

bool looksFromCone(const LayersRequest& request, const Eigen::Vector3d& eye) {
    return request.plan && request.settings.candidates && request.settings.cone &&
           ui::isInCone(*request.plan, candidatesOptions(request), eye);
}

/// Used by the worker's thread only: each layer with its input.
struct LayerBuilder::WorkerState {
    struct Made {
        std::any of;
        std::shared_ptr<const PlanLayer> layer;
    };
    std::array<Made, 15> made;

    template <class Inputs, class Make>
    void add(Layers& layers, std::size_t place, const Inputs& inputs, Make&& make) {
        Made& slot = made[place];
        const auto* known = std::any_cast<Inputs>(&slot.of);
        if (known == nullptr || !(*known == inputs)) {
            slot = {inputs, std::make_shared<const PlanLayer>(make())};
        }
        layers.layers.push_back(slot.layer);
    }

    void addSurface(Layers& layers, const LayersRequest& request);
    void addQuality(Layers& layers, const LayersRequest& request);
    void addRoom(Layers& layers, const LayersRequest& request);
    void addTrajectories(Layers& layers, const LayersRequest& request);
    void addPoints(Layers& layers, const LayersRequest& request);
    void addKeys(Layers& layers, const LayersRequest& request);
    Layers build(const LayersRequest& request);

    std::string surface_of;  // the scene of the last surface layer, by its hash
};

/// A plan that is still being measured leaves the layer of the plan before, to avoid flicker.
void LayerBuilder::WorkerState::addSurface(Layers& layers, const LayersRequest& request) {
    constexpr std::size_t kSlot = 10;
    const Plan& plan = *request.plan;
    if (plan.surface) {
        const ui::SurfaceOverlayOptions& options = request.settings.surface_options;
        add(layers, kSlot, std::tuple(request.plan, options),
            [&] { return ui::surfaceLayer(*plan.surface, options); });
        surface_of = request.scene->source_sha256;
    } else if (plan.series.size() == 0 && made[kSlot].layer &&
               surface_of == request.scene->source_sha256) {
        layers.layers.push_back(made[kSlot].layer);
    }
}

/// Weak frames and unseen surface, unless the layer Surface already shows the latter.
void LayerBuilder::WorkerState::addQuality(Layers& layers, const LayersRequest& request) {
    const Plan& plan = *request.plan;
    const ui::QualityOverlayOptions& options = request.settings.quality_options;
    const bool drawn =
        plan.surface && request.settings.surface && request.settings.surface_options.unseen;
    if (options.unseen_surface && !drawn) {
        constexpr ui::SurfaceOverlayOptions kUnseen = {.seen = false};
        add(layers, 14, request.quality,
            [&] { return ui::surfaceLayer(request.quality->surface, kUnseen); });
    }
    add(layers, 12, std::tuple(request.plan, request.quality, request.pictures, options),
        [&] { return ui::qualityLayer(plan, *request.quality, request.pictures, options); });
}

/// The floor's grid, free space, no-go boxes and regions.
void LayerBuilder::WorkerState::addRoom(Layers& layers, const LayersRequest& request) {
    const ui::LayerSettings& on = request.settings;
    if (on.grid) {
        add(layers, 9, std::tuple(request.scene, request.plan), [&] {
            const auto rooms = request.plan ? std::span(std::as_const(request.plan->rooms))
                                            : std::span<const Eigen::AlignedBox3d>();
            return ui::gridLayer(request.scene->room_bounds,
                                 render::floorOf(*request.scene, rooms));
        });
    }
    if (on.free_space && request.free_space) {
        const ui::FreeSpaceOverlayOptions options = cellOptions(on);
        add(layers, 0, std::tuple(request.free_space, options),
            [&] { return ui::freeSpaceLayer(*request.free_space, options); });
    }
    if (on.no_go_boxes && !request.no_go.empty()) {
        add(layers, 1, std::tuple(request.no_go, request.selection),
            [&] { return noGoLayer(request.no_go, request.selection); });
    }
    if (on.no_go_boxes && !request.regions.empty()) {
        add(layers, 8, std::tuple(request.regions, request.selection),
            [&] { return regionsLayer(request.regions, request.selection); });
    }
}

/// The plan's steps or roadmap, its trajectory and the kept plan's.
void LayerBuilder::WorkerState::addTrajectories(Layers& layers, const LayersRequest& request) {
    const ui::LayerSettings& on = request.settings;
    const Plan& plan = *request.plan;
    if (request.stepping) {
        add(layers, 2, std::tuple(request.plan, request.step),
            [&] { return ui::stepsLayer(plan, request.step); });
        return;
    }
    if (on.roadmap) {
        const ui::RoadmapOverlayOptions options = roadmapOptions(request);
        add(layers, 3, std::tuple(request.plan, options),
            [&] { return ui::roadmapLayer(plan, options); });
    }
    if (on.trajectory) {
        add(layers, 4, std::tuple(request.plan, on.trajectory_options),
            [&] { return ui::trajectoryLayer(plan, on.trajectory_options); });
    }
    if (request.kept_plan && on.kept_plan) {
        add(layers, 13, std::tuple(request.kept_plan, request.kept_name),
            [&] { return ui::keptPlanLayer(*request.kept_plan, request.kept_name); });
    }
    if (on.surface) addSurface(layers, request);
    if (on.quality && request.quality) addQuality(layers, request);
}

/// The plan's candidates and points, and the current camera.
void LayerBuilder::WorkerState::addPoints(Layers& layers, const LayersRequest& request) {
    const ui::LayerSettings& on = request.settings;
    const Plan& plan = *request.plan;
    const ui::CandidatesOverlayOptions candidates = candidatesOptions(request);
    if (on.candidates && candidates.observation_point >= 0) {
        layers.candidates_of = candidates.observation_point;
        add(layers, 5, std::tuple(request.plan, candidates),
            [&] { return ui::candidatesLayer(plan, candidates); });
    }
    if (on.points) {
        const ui::PointsOverlayOptions options = pointsOptions(request);
        add(layers, 6, std::tuple(request.scene, request.plan, request.camera, options),
            [&] { return ui::pointsLayer(*request.scene, plan, request.camera, options); });
    }
    if (request.frame >= 0) {
        layers.layers.push_back(std::make_shared<const PlanLayer>(cameraLayer(request)));
    }
}

/// The key frames of a given motion.
void LayerBuilder::WorkerState::addKeys(Layers& layers, const LayersRequest& request) {
    if (!request.settings.trajectory || request.stepping || !request.motion ||
        request.motion->keys.empty()) {
        return;
    }
    const int selected =
        request.selection.kind == Selection::Kind::CameraKey ? request.selection.index : -1;
    add(layers, 11,
        std::tuple(request.motion, request.plan, request.keys_planned, request.camera, selected),
        [&] {
            return ui::cameraKeysLayer(
                request.motion->keys,
                request.keys_planned ? request.plan->passed_keys : std::vector<PassedKey>(),
                request.camera, selected);
        });
}

Layers LayerBuilder::WorkerState::build(const LayersRequest& request) {
    Layers layers;
    layers.plan = request.plan;
    if (!request.scene) return layers;
    addRoom(layers, request);
    if (request.plan) {
        addTrajectories(layers, request);
        addPoints(layers, request);
    }
    addKeys(layers, request);
    add(layers, 7,
        std::tuple(request.scene, request.free_space, request.selection, request.moved,
                   request.left_out),
        [&] { return selectionLayer(request); });
    return layers;
}

std::vector<ui::PickedElement> Layers::pick(const render::View& view, const Eigen::Vector2d& pixel,
                                            double scene_depth_m, double pixel_scale) const {
    std::vector<ui::PickedElement> all;
    for (const auto& layer : layers) {
        const auto found =
            ui::pickElements(layer->overlay, view, pixel, scene_depth_m, 6.0, pixel_scale);
        all.insert(all.end(), found.begin(), found.end());
    }
    std::ranges::stable_sort(all, ui::isBetterPick);
    return all;
}

LayerBuilder::LayerBuilder(std::function<void()> wake)
    : worker_state_(std::make_shared<WorkerState>()), worker_(std::move(wake)) {}

LayerBuilder::~LayerBuilder() = default;

void LayerBuilder::request(const LayersRequest& request) {
    if (last_ && *last_ == request) return;
    last_ = request;
    worker_.start([request, worker_state = worker_state_, latest = made_](const JobContext&) {
        latest->put(worker_state->build(request));
    });
}

bool LayerBuilder::poll() {
    std::optional<Layers> made = made_->take();
    if (!made) return false;
    layers_ = std::move(*made);
    return true;
}

}  // namespace dollytrack::editor
