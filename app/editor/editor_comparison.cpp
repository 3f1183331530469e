#include "app/editor/editor.h"

#include "engine/core/log.h"
#include "ui/overlays/quality_overlay.h"
#include "ui/widgets/item_map.h"

#include <imgui.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace dollytrack::editor {

std::string Editor::whyPlanNotCurrent() const {
    if (!workspace_.isOpen()) return "No scene is open.";
    return workspace_.planIsCurrent() && plan() != nullptr ? "" : "The plan is not ready yet.";
}

void Editor::addComparisonCommands() {
    const auto needs_plan = [this] { return whyPlanNotCurrent(); };
    const auto needs_kept = [this]() -> std::string {
        return comparison_.kept() != nullptr ? "" : "Keep a plan first.";
    };
    const auto show = [this] { docks_.open(panelName(Panel::Metrics)); };
    commands_.add({"plan.keep",
                   "Edit",
                   "Keep this plan to compare with it",
                   {},
                   [this, show] {
                       follow(ui::ComparisonActions{.keep = true});
                       show();
                   },
                   needs_plan});
    commands_.add(
        {"plan.open_kept",
         "Edit",
         "Compare with another project\u2026",
         {},
         [this, show] {
             follow(ui::ComparisonActions{.open = true});
             show();
         },
         [this]() -> std::string { return workspace_.isOpen() ? "" : "No scene is open."; }});
    commands_.add({"plan.swap",
                   "Edit",
                   "Swap with the kept plan",
                   {},
                   [this] { follow(ui::ComparisonActions{.swap = true}); },
                   [needs_plan, needs_kept] {
                       const std::string why = needs_kept();
                       return why.empty() ? needs_plan() : why;
                   }});
    commands_.add({"plan.drop",
                   "Edit",
                   "Drop the kept plan",
                   {},
                   [this] { follow(ui::ComparisonActions{.drop = true}); },
                   needs_kept});
}

ui::ComparisonView Editor::comparisonView() {
    ui::ComparisonView view;
    view.why_not_keep = view.why_not_swap = whyPlanNotCurrent();
    if (!workspace_.isOpen()) view.why_not_open = "No scene is open.";
    view.reading = comparison_.reading().filename().string();
    const KeptPlan* kept = comparison_.kept();
    if (kept == nullptr) return view;
    view.has_kept = true;
    view.kept_name = kept->name;
    const PlanOutcome& shown = workspace_.shown();
    view.metrics = comparison_.metrics(shown, quality_.of(shown.plan));
    return view;
}

void Editor::follow(const ui::ComparisonActions& actions) {
    const std::shared_ptr<const FrameQuality> quality = quality_.of(workspace_.shown().plan);
    if (actions.keep) comparison_.keep(currentPlan(workspace_, quality.get()));
    if (actions.open) askForFile("kept plan");
    if (actions.swap) comparison_.swap(workspace_, quality.get());
    if (actions.drop) comparison_.drop();
    if (actions.cancel_reading) comparison_.cancelReading();
}

void Editor::followComparison() {
    const PlanOutcome& shown = workspace_.shown();
    // A measurement that ended before follow() has given its result there, unless it has failed.
    const bool was_measuring = quality_.state().busy;
    quality_.follow(shown, layer_settings_.quality);
    const bool measures = was_measuring || quality_.state().busy || !shown.measured;
    plan_timeline_.followQuality(quality_.of(shown.plan), layer_settings_.quality && measures);
    probePictures();
    if (workspace_.isOpen()) comparison_.followUndo(workspace_.history().state());
    if (const std::optional<Error> error = comparison_.poll()) {
        log::error("comparison", describe(*error));
        questions_.tell({true, "Cannot compare with this project", describe(*error), {}});
    }
}

void Editor::probePictures() {
    constexpr int kWidth_px = 160;
    const PlanOutcome& shown = workspace_.shown();
    const bool wanted = layer_settings_.quality && layer_settings_.quality_options.unusable &&
                        shown.plan && !shown.plan->trajectory.frames.empty() && shown.measured &&
                        scene_sync_.isSent() && !workspace_.lighting();
    // The classes of a plan in its light are kept, unless the search ends early.
    if (shown.plan != probed_plan_ || workspace_.lighter().light() != probed_light_ ||
        (!wanted && !frame_classes_)) {
        drawing_.requestProbes(nullptr);
        probes_.reset();
        frame_classes_.reset();
        probed_plan_.reset();
        probed_light_.reset();
    }
    if (!wanted || frame_classes_) return;
    if (!probes_) {
        probed_plan_ = shown.plan;
        probed_light_ = workspace_.lighter().light();
        CameraParams camera = shown.params.camera;
        camera.height_px = std::max(1, kWidth_px * camera.height_px / camera.width_px);
        camera.width_px = kWidth_px;
        ui::RenderThread::Views views;
        for (const TrajectoryFrame& frame : shown.plan->trajectory.frames) {
            views.push_back(render::makeView(camera, frame.pose));
        }
        probes_ = std::make_shared<const ui::RenderThread::Views>(std::move(views));
        drawing_.requestProbes(probes_);
    }
    if (drawing_.probing() && drawing_.probesDone() < probes_->size()) return;
    std::vector<render::PictureQuality> classes = drawing_.probes();
    if (classes.size() < probes_->size()) classes.clear();  // they cannot be drawn
    frame_classes_ =
        std::make_shared<const std::vector<render::PictureQuality>>(std::move(classes));
    drawing_.requestProbes(nullptr);
    probes_.reset();
}

double Editor::probedShare() const {
    if (!probes_) return 1.0;
    return static_cast<double>(drawing_.probesDone()) / static_cast<double>(probes_->size());
}

void Editor::addComparison(LayersRequest& request) const {
    request.quality = quality_.of(request.plan);
    if (request.plan == probed_plan_) request.pictures = frame_classes_;
    if (const KeptPlan* kept = comparison_.kept()) {
        request.kept_plan = kept->trajectory;
        request.kept_name = kept->name;
    }
}

void Editor::drawFrameTip() {
    const PlanOutcome& shown = workspace_.shown();
    const std::shared_ptr<const FrameQuality> quality = quality_.of(shown.plan);
    const bool free = pane_.hovered && !preview_hovered_ && !panels_.legend.hovered &&
                      !gizmo_.dragging() && !ImGui::IsAnyMouseDown() && !through_camera_;
    if (!layer_settings_.quality || !quality || !free) return;
    const bool is_current =
        layers_.layers().plan == shown.plan && shown.hasObjectsOf(drawing_.view().geometry);
    if (!is_current) return;
    const std::vector<ui::PickedElement> picked = pick(pane_.cursor).elements;
    const auto pointed = std::ranges::find_if(
        picked, [](const ui::PickedElement& one) { return one.visible && one.on; });
    if (pointed == picked.end() || pointed->tag.kind != ui::Picked::Frame) return;
    const int frame = pointed->tag.index;
    if (frame >= frameCount()) return;
    ImGui::BeginTooltip();
    ImGui::Text("Frame %d, %.1f s", frame, plan()->trajectory.frames[frame].time_s);
    ImGui::TextUnformatted(ui::qualityText(*plan(), *quality, frame_classes_, frame).c_str());
    const ImVec2 low = ImGui::GetWindowPos();
    const ImVec2 size = ImGui::GetWindowSize();
    ui::nameArea("viewport.frame_tip", low.x, low.y, low.x + size.x, low.y + size.y);
    ImGui::EndTooltip();
}

nlohmann::json Editor::comparisonJson() const {
    nlohmann::json json = {{"reading", !comparison_.reading().empty()}, {"kept", nullptr}};
    if (const KeptPlan* kept = comparison_.kept()) {
        json["kept"] = {{"name", kept->name}, {"frames", kept->trajectory->frames.size()}};
    }
    const PlanOutcome& shown = workspace_.shown();
    const std::shared_ptr<const FrameQuality> quality = quality_.of(shown.plan);
    json["quality"] = nullptr;
    if (quality) {
        addFrameQuality(json["quality"], shown.plan->trajectory, *quality);
        json["quality"]["overlap"] = quality->overlap;
        json["quality"]["pictures"] = nullptr;
        if (frame_classes_ && !frame_classes_->empty()) {
            for (const render::PictureQuality one : *frame_classes_) {
                json["quality"]["pictures"].push_back(static_cast<int>(one));
            }
        }
        json["quality"]["image_corners"] = quality->image_corners;
    }
    return json;
}

}  // namespace dollytrack::editor
