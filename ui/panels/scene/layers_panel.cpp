#include "ui/panels/scene/layers_panel.h"

#include "ui/theme.h"
#include "ui/viewport/legend_view.h"
#include "ui/widgets/fields/number_input.h"
#include "ui/widgets/form.h"
#include "ui/widgets/item_map.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace dollytrack::ui {
namespace {

constexpr const char* kNoPlan = "There is no plan yet.";

/// Widgets that record changes by the user.
class Switches {
  public:
    explicit Switches(LayersActions& actions) : actions_(actions) {}

    bool check(const char* label, const char* name, bool& on, const char* tip = "",
               const std::string& why_not = {}) {
        ImGui::BeginDisabled(!why_not.empty());
        if (ImGui::Checkbox(label, &on)) note(true);
        ImGui::EndDisabled();
        nameItem(std::string("layers.") + name, why_not.empty());
        tooltip(why_not.empty() ? tip : why_not);
        return on && why_not.empty();
    }

    /// A combo box for an enumeration; `names` are in the order of its values.
    template <class Enum, std::size_t N>
    void choose(const char* label, const char* name, Enum& value,
                const std::array<const char*, N>& names) {
        int index = static_cast<int>(value);
        if (choose(label, name, index, {names.begin(), names.end()})) {
            value = static_cast<Enum>(index);
        }
    }

    /// A combo box for names; returns true if an entry was chosen.
    bool choose(const char* label, const char* name, int& value,
                const std::vector<std::string>& names) {
        formLabel(label);
        const std::string id = std::string("layers.") + name;
        bool chosen = false;
        if (ImGui::BeginCombo(("##" + id).c_str(), names[value].c_str())) {
            nameItem(id);
            for (std::size_t i = 0; i < names.size(); ++i) {
                if (ImGui::Selectable(names[i].c_str(), i == static_cast<std::size_t>(value))) {
                    value = static_cast<int>(i);
                    chosen = true;
                    note(true);
                }
                nameItem(id + "." + names[i]);
            }
            ImGui::EndCombo();
        } else {
            nameItem(id);
        }
        return chosen;
    }

    void slide(const char* label, const char* name, double& value, double low, double high,
               const char* unit = "") {
        formLabel(label);
        NumberLimits limits;
        limits.range = {low, high};
        limits.format = "%.2f";
        limits.unit = unit;
        const FieldEdit edit = numberInput(value, limits, std::string("layers.") + name);
        if (edit.changed || edit.finished) note(edit.finished);
    }

    void note(bool finished) {
        actions_.changed = true;
        actions_.finished = actions_.finished || finished;
    }

  private:
    LayersActions& actions_;
};

/// Indented rows that belong to the switch above.
template <class Rows>
void details(const char* id, const Rows& rows) {
    ImGui::Indent();
    if (beginForm(id)) {
        rows();
        endForm();
    }
    ImGui::Unindent();
}

/// Several switches per line, as many as fit.
void flowToSwitch(const char* label) {
    flowTo((std::string("[x] ") + label).c_str());
}

void drawSlice(const LayersView& view, LayerSettings& settings, Switches& switches) {
    constexpr std::array kAxes = {"x", "y", "z, level"};
    const int axis = settings.slice.axis;
    const double low = view.room.isEmpty() ? 0.0 : view.room.min()[axis];
    const double high = view.room.isEmpty() ? 3.0 : view.room.max()[axis];
    settings.slice.position_m = std::clamp(settings.slice.position_m, low, high);
    switches.slide(axis == 2 ? "Slice height" : "Slice at", "slice.position",
                   settings.slice.position_m, low, high, " m");
    switches.slide("Thickness", "slice.thickness", settings.slice.thickness_m, view.cell_m,
                   std::max(high - low, view.cell_m), " m");
    switches.choose("Slice across", "slice.axis", settings.slice.axis, kAxes);
}

void drawLevels(const LayersView& view, LayerSettings& settings, Switches& switches) {
    const int top = std::max(view.levels - 1, 0);
    int range[2] = {std::min(settings.cells.min_level, top),
                    std::min(settings.cells.max_level, top)};
    formLabel("Cell sizes", "Smallest and largest level of the octree to draw");
    const auto edge = [&](int level) { return view.cell_m * std::exp2(level); };
    const std::string low = fmt::format("{:.2f} m", edge(range[0]));
    const std::string high = fmt::format("{:.2f} m", edge(range[1]));
    if (ImGui::DragIntRange2("##levels", &range[0], &range[1], 0.05F, 0, top, low.c_str(),
                             high.c_str(), ImGuiSliderFlags_AlwaysClamp)) {
        settings.cells.min_level = range[0];
        // The largest level includes all larger cells.
        settings.cells.max_level = range[1] == top ? 16 : range[1];
        switches.note(true);
    }
    nameItem("layers.levels");
}

void drawFreeSpace(const LayersView& view, LayerSettings& settings, Switches& switches) {
    const std::string why_not = view.has_map ? "" : "The map is not built yet.";
    if (!switches.check("Free space", "free_space", settings.free_space, "The octree of free space",
                        why_not)) {
        return;
    }
    ImGui::Indent();
    switches.check("free", "cells.free", settings.cells.free);
    flowToSwitch("occupied");
    switches.check("occupied", "cells.occupied", settings.cells.occupied);
    flowToSwitch("unknown");
    switches.check(
        "unknown", "cells.unknown", settings.cells.unknown,
        "Space inside walls and furniture, and outside the building",
        settings.sliced ? "" : "The map has too many cells to be shown without a slice.");
    flowToSwitch("slice");
    switches.check("slice", "sliced", settings.sliced, "Show only a slab of the map");
    ImGui::Unindent();
    details("free_space", [&] {
        if (settings.sliced) drawSlice(view, settings, switches);
        constexpr std::array kColors = {"state", "clearance", "component (room)", "level"};
        switches.choose("Colour", "cells.color", settings.cells.color, kColors);
        drawLevels(view, settings, switches);
        double opacity = settings.cells.opacity;
        switches.slide("Opacity", "cells.opacity", opacity, 0.05, 1.0);
        settings.cells.opacity = static_cast<float>(opacity);
    });
}

void drawPoints(LayerSettings& settings, Switches& switches, const std::string& why_not) {
    if (!switches.check("Points", "points", settings.points,
                        "Observation points and camera positions", why_not)) {
        return;
    }
    ImGui::Indent();
    PointsOverlayOptions& options = settings.point_options;
    switches.check("observation points", "points.observation", options.observation_points);
    flowToSwitch("position points");
    switches.check("position points", "points.position", options.position_points);
    flowToSwitch("view pyramids");
    switches.check("view pyramids", "points.frustums", options.frustums);
    ImGui::Unindent();
}

void drawRoadmap(const LayersView& view, LayerSettings& settings, Switches& switches,
                 const std::string& why_not) {
    const std::string why =
        view.stepping ? "The steps of the algorithm are shown instead." : why_not;
    if (!switches.check("Roadmap", "roadmap", settings.roadmap, "The moves between position points",
                        why)) {
        return;
    }
    ImGui::Indent();
    RoadmapOverlayOptions& options = settings.roadmap_options;
    switches.check("accepted", "roadmap.accepted", options.accepted);
    flowToSwitch("colliding");
    switches.check("colliding", "roadmap.refused", options.refused,
                   "Moves in which the camera would collide");
    flowToSwitch("links");
    switches.check("links", "roadmap.links", options.links, "Moves found by RRT*");
    flowToSwitch("samples");
    switches.check("samples", "roadmap.samples", options.samples, "Samples of RRT*");
    flowToSwitch("dropped");
    switches.check("dropped", "roadmap.dropped", options.dropped, "Edges that close a cycle");
    flowToSwitch("path");
    switches.check("path", "roadmap.path", options.path);
    ImGui::Unindent();
    details("roadmap", [&] {
        constexpr std::array kColors = {"part before linking", "component (room)"};
        switches.choose("Colour", "roadmap.color", options.color, kColors);
    });
}

void drawTrajectory(LayerSettings& settings, Switches& switches, const std::string& why_not) {
    if (!switches.check("Trajectory", "trajectory", settings.trajectory, "The camera's path",
                        why_not)) {
        return;
    }
    ImGui::Indent();
    switches.check("direction arrows", "trajectory.arrows",
                   settings.trajectory_options.direction_arrows);
    ImGui::Unindent();
    details("trajectory", [&] {
        constexpr std::array kColors = {"time",  "clearance",      "speed",        "turn rate",
                                        "score", "newly captured", "image corners"};
        switches.choose("Colour", "trajectory.color", settings.trajectory_options.color, kColors);
    });
}

void drawSurface(const LayersView& view, LayerSettings& settings, Switches& switches,
                 const std::string& why_not) {
    std::string why = why_not;
    if (why.empty() && !view.has_surface) {
        why = view.measured ? "Set objective to surface or both." : "The plan is being measured.";
    }
    if (!switches.check("Surface", "surface", settings.surface,
                        "What the frames show of all surface", why)) {
        return;
    }
    ImGui::Indent();
    SurfaceOverlayOptions& options = settings.surface_options;
    switches.check("unseen", "surface.unseen", options.unseen, "No frame shows it");
    flowToSwitch("seen");
    switches.check("seen", "surface.seen", options.seen,
                   "From fewer directions or from farther away than asked for");
    flowToSwitch("covered");
    switches.check("covered", "surface.covered", options.covered,
                   "From the directions and at the resolution asked for");
    ImGui::Unindent();
}

/// Weak frames are measured on request, since that takes seconds.
void drawQuality(const LayersView& view, LayerSettings& settings, Switches& switches,
                 const std::string& why_not) {
    const bool has_options_before = view.has_surface && settings.surface;
    if (!has_options_before) flowToSwitch("Weak frames");
    if (!switches.check("Weak frames", "quality", settings.quality,
                        "What SLAM and reconstruction programs miss: frames with few image "
                        "corners, wide gaps, dark or flat images, and surface that no frame shows",
                        why_not)) {
        return;
    }
    ImGui::Indent();
    QualityOverlayOptions& options = settings.quality_options;
    switches.check("few corners", "quality.untrackable", options.untrackable,
                   "Fewer estimated image corners than SLAM programs need to track a frame");
    flowToSwitch("wide gaps");
    switches.check("wide gaps", "quality.wide_gaps", options.wide_gaps,
                   "Frames that show too little of what the frame before shows");
    flowToSwitch("dark or flat");
    switches.check("dark or flat", "quality.unusable", options.unusable,
                   "Images that are dark, white or flat, as 'dollytrack export' names them");
    flowToSwitch("unseen surface");
    switches.check("unseen surface", "quality.unseen_surface", options.unseen_surface,
                   "Surface within sight of the camera's positions that no frame shows");
    if (view.measuring_quality || view.judging_images) {
        ImGui::ProgressBar(static_cast<float>(view.quality_fraction),
                           {scaled(130), ImGui::GetFrameHeight()},
                           view.measuring_quality ? "measuring" : "drawing images");
        ImGui::SameLine();
        if (button("Stop", "layers.quality.stop")) {
            (view.measuring_quality ? settings.quality : options.unusable) = false;
            switches.note(true);
        }
    }
    ImGui::Unindent();
}

/// A switch for each verdict that occurs; none if no target is selected.
void drawCandidates(const LayersView& view, LayerSettings& settings, Switches& switches) {
    ImGui::Indent();
    switches.check("cone", "cone", settings.cone, "The search cone");
    for (std::size_t i = 0; i < kVerdicts; ++i) {
        if (!view.candidates_there[i]) continue;
        const std::string words(inWords(static_cast<Verdict>(i)));
        flowToSwitch(words.c_str());
        switches.check(words.c_str(), ("candidates." + words).c_str(), settings.candidate_kinds[i]);
    }
    ImGui::Unindent();
}

/// Chooses the storey that the ceiling cut shows.
void drawStoreys(const LayersView& view, LayerSettings& settings, Switches& switches) {
    std::vector<std::string> names = {"topmost"};
    for (int storey = 1; storey <= view.storeys; ++storey) names.push_back(std::to_string(storey));
    // The stored storey may not exist in this scene.
    int shown = settings.storey <= view.storeys ? settings.storey : 0;
    details("storeys", [&] {
        if (switches.choose("Storey", "storey", shown, names)) settings.storey = shown;
    });
}

void drawClipBox(const LayersView& view, ClipSettings& clip, Switches& switches) {
    constexpr double kFarther_m = 5.0;  // than the scene
    for (int axis = 0; axis < 3; ++axis) {
        const char letter = "xyz"[axis];
        double& low = clip.box.min()[axis];
        double& high = clip.box.max()[axis];
        switches.slide(fmt::format("{} from", letter).c_str(),
                       fmt::format("clip.{}.low", letter).c_str(), low,
                       view.room.min()[axis] - kFarther_m, high, " m");
        switches.slide(fmt::format("{} to", letter).c_str(),
                       fmt::format("clip.{}.high", letter).c_str(), high, low,
                       view.room.max()[axis] + kFarther_m, " m");
    }
}

/// Switches for hiding above a height and for the clipping box; they do not change the plan.
void drawClip(const LayersView& view, ClipSettings& clip, Switches& switches) {
    const std::string why_not = view.room.isEmpty() ? "No scene is open." : "";
    clip.begin(view.room);
    if (switches.check("Hide above", "hide_above", clip.hides_above,
                       "Show nothing above a height; the plan does not change", why_not)) {
        details("hide_above", [&] {
            switches.slide("Height", "hide_above.height", clip.height_m, view.room.min().z(),
                           view.room.max().z(), " m");
        });
    }
    if (switches.check("Clipping box (Alt+B)", "clip_box", clip.has_box,
                       "Show only what lies in a box; the plan does not change", why_not)) {
        details("clip_box", [&] { drawClipBox(view, clip, switches); });
    }
}

}  // namespace

LayersActions drawLayersPanel(const LayersView& view, LayerSettings& settings, ClipSettings& clip) {
    LayersActions actions;
    Switches switches(actions);
    const std::string why_not = view.has_plan ? "" : kNoPlan;
    ImGui::BeginChild("layers");
    drawTrajectory(settings, switches, why_not);
    drawPoints(settings, switches, why_not);
    drawRoadmap(view, settings, switches, why_not);
    if (switches.check("Candidates", "candidates", settings.candidates,
                       "Candidates of the selected object, by verdict", why_not)) {
        drawCandidates(view, settings, switches);
    }
    drawSurface(view, settings, switches, why_not);
    drawQuality(view, settings, switches, why_not);
    if (view.has_kept_plan) {
        if (!settings.quality) flowToSwitch("Kept plan (B)");
        switches.check("Kept plan (B)", "kept_plan", settings.kept_plan,
                       "The trajectory that is kept for comparison, thin and pale");
    }
    drawFreeSpace(view, settings, switches);
    switches.check("No-go boxes, regions", "no_go_boxes", settings.no_go_boxes);
    flowToSwitch("Grid");
    switches.check("Grid", "grid", settings.grid, "At floor height, below and around the room");
    switches.check("Cut ceilings away", "ceiling_cut", settings.ceiling_cut,
                   "Show rooms from above without ceilings");
    if (settings.ceiling_cut && view.storeys > 1) drawStoreys(view, settings, switches);
    drawClip(view, clip, switches);
    if (!view.legends.empty()) {
        ImGui::Separator();
        drawLegends(view.legends);
    }
    ImGui::EndChild();
    return actions;
}

}  // namespace dollytrack::ui
