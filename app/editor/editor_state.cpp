#include "app/editor/editor.h"
#include "engine/document/edits_json.h"
#include "ui/widgets/cut_letters.h"
#include "ui/widgets/item_map.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace dollytrack::editor {

namespace {

/// Window position of a world position; null if it is behind the camera or outside the image.
nlohmann::json inWindow(const render::View& view, const ui::ViewportActions& pane,
                        const Eigen::Vector3d& place) {
    const Eigen::Vector3d p = view.pose.toCamera(place);
    if (p.z() <= 0.0) return nullptr;
    const Eigen::Vector2d at = view.project(p);
    if (at.x() < 0 || at.y() < 0 || at.x() >= pane.width || at.y() >= pane.height) return nullptr;
    return {at.x() + pane.origin.x(), at.y() + pane.origin.y()};
}

/// The lower and the upper corner.
nlohmann::json boxNumbers(const Eigen::AlignedBox3d& box) {
    const Eigen::Vector3d& low = box.min();
    const Eigen::Vector3d& high = box.max();
    return {{low.x(), low.y(), low.z()}, {high.x(), high.y(), high.z()}};
}

/// The counts of each legend's entries.
nlohmann::json legendsJson(const Layers& layers) {
    nlohmann::json legends = nlohmann::json::object();
    for (const auto& layer : layers.layers) {
        for (const ui::LegendEntry& entry : layer->legend.entries) {
            legends[layer->legend.title][entry.name] = entry.count;
        }
    }
    return legends;
}

std::vector<std::size_t> numbersOf(const std::vector<bool>& flags) {
    std::vector<std::size_t> numbers;
    for (std::size_t i = 0; i < flags.size(); ++i) {
        if (flags[i]) numbers.push_back(i);
    }
    return numbers;
}

}  // namespace

nlohmann::json Editor::exportsJson() const {
    nlohmann::json jobs = nlohmann::json::array();
    if (!exports_) return jobs;
    for (const ui::ExportJob& job : exports_->jobs()) {
        jobs.push_back({{"id", job.id},
                        {"state", static_cast<int>(job.state)},
                        {"folder", job.request.folder.string()},
                        {"overwrite", job.request.overwrite},
                        {"frames_done", job.frames_done},
                        {"frames", job.frames},
                        {"error", job.error.message},
                        {"contact_sheet", job.contact_sheet.string()}});
    }
    return jobs;
}

void Editor::addSceneAndPlanTo(nlohmann::json& state) {
    const PlanOutcome& shown = workspace_.shown();
    if (shown.scene) {
        const render::View view = viewportView(panels_.viewport.camera);
        for (const Object& object : shown.scene->objects) {
            state["objects"].push_back({{"id", object.id},
                                        {"name", object.name},
                                        {"class", object.nyu40},
                                        {"large", object.large},
                                        {"role", static_cast<int>(object.role)},
                                        {"px", inWindow(view, pane_, object.box.center)}});
        }
        if (shown.plan) {
            for (const PositionPoint& point : shown.plan->position_points) {
                state["points"].push_back(
                    {{"px", inWindow(view, pane_, point.pose.position)}, {"pin", point.pin}});
            }
        }
    }
    for (const ui::TimelineCameraKey& key : timelineCameraKeys()) {
        state["camera_keys"].push_back(
            {{"time_s", key.time_s}, {"reached_s", key.reached_s}, {"note", key.note}});
    }
    if (shown.plan) {
        int collisions = 0;
        for (const SmoothPath& path : shown.plan->smooth_paths) collisions += path.collisions;
        state["plan"] = {
            {"excluded", std::ranges::count(shown.scene->objects, Role::Excluded, &Object::role)},
            {"steps", shown.plan->roadmap.steps.steps.size()},
            {"measured", shown.measured},
            {"frames", shown.plan->trajectory.frames.size()},
            {"moves_in_collision", collisions},
            {"path_length_m", shown.plan->trajectory_metrics.path_length_m},
            {"key_frames", shown.plan->key_frames.size()},
            {"captured", shown.plan->capture_metrics.captured},
            {"well_captured", shown.plan->capture_metrics.well_captured},
            {"objects", shown.plan->capture_metrics.objects}};
    }
}

nlohmann::json Editor::stateJson() {
    const PlanOutcome& shown = workspace_.shown();
    nlohmann::json items = nlohmann::json::object();
    for (const ui::NamedItem& item : ui::item_map::items()) {
        items[item.name] = {item.left, item.top, item.right, item.bottom, item.enabled};
    }
    nlohmann::json cut_text = nlohmann::json::array();
    for (const ui::CutLine& line : ui::cutLines()) {
        cut_text.push_back({line.text, line.left, line.top, line.right, line.bottom});
    }
    nlohmann::json state = {
        {"open", workspace_.isOpen()},
        {"project", workspace_.path().string()},
        {"title", workspace_.title()},
        {"unsaved", workspace_.unsaved()},
        {"parameters", workspace_.isOpen() ? workspace_.state().parameters : nlohmann::json()},
        {"history", workspace_.history().names()},
        {"history_position", workspace_.history().position()},
        {"busy",
         {{"loading", workspace_.loading().busy || autosave_.searching()},
          {"planning", workspace_.planning().busy},
          {"saving", workspace_.saving()},
          {"lighting", workspace_.lighting()},
          {"drawing", drawing_.busy()}}},
        {"plan_is_current", workspace_.isOpen() && workspace_.planIsCurrent()},
        {"plan_error", workspace_.planError()},
        {"plan_outdated", shown.outdated},
        {"file_changed", workspace_.fileChanged()},
        {"import", workspace_.isOpen() ? workspace_.importSettings() : nlohmann::json()},
        {"latency_ms", workspace_.lastLatency_ms()},
        {"selected", selected_.objects()},
        {"selection_kind", static_cast<int>(selected_.now().kind)},
        {"selection_index", selected_.now().index},
        {"drag_text", gizmo_.text()},
        {"frame", playback_.frame()},
        {"playing", playback_.playing()},
        {"track_time", track_time_.now()},
        {"tracks_play", track_time_.playing()},
        {"step", step_playback_.taken()},
        {"through_camera", through_camera_},
        {"edits", workspace_.isOpen() ? editsJson(workspace_.state().edits) : nlohmann::json()},
        {"camera",
         {{"pivot",
           {panels_.viewport.camera.pivot.x(), panels_.viewport.camera.pivot.y(),
            panels_.viewport.camera.pivot.z()}},
          {"azimuth", panels_.viewport.camera.azimuth},
          {"elevation", panels_.viewport.camera.elevation},
          {"distance", panels_.viewport.camera.distance},
          {"orthographic", panels_.viewport.camera.orthographic}}},
        {"layers",
         {{"free_space", layer_settings_.free_space},
          {"points", layer_settings_.points},
          {"roadmap", layer_settings_.roadmap},
          {"trajectory", layer_settings_.trajectory},
          {"candidates", layer_settings_.candidates},
          {"no_go", layer_settings_.no_go_boxes},
          {"quality", layer_settings_.quality},
          {"slice_m", layer_settings_.slice.position_m},
          {"stepping", step_playback_.shown()}}},
        {"legends", legendsJson(layers_.layers())},
        {"box_select", panels_.viewport.box_select},
        {"local_view", selected_.inLocalView()},
        {"clip", clip_.shown() ? boxNumbers(*clip_.shown()) : nlohmann::json()},
        {"window", {window_.settings().width, window_.settings().height}},
        {"autosaves", autosave_.count()},
        {"hidden", std::ranges::count(selected_.hidden(), true)},
        {"hidden_ids", numbersOf(selected_.hidden())},
        {"dialogs",
         {{"file", files_.isOpen()},
          {"help", panels_.help.open},
          {"palette", panels_.palette.open},
          {"sheet", sheet_.isOpen()}}},
        {"preview",
         {{"frame", drawing_.preview().frame},
          {"serial", drawing_.preview().serial},
          {"open", panels_.preview.open},
          {"docked", previewIsDocked()},
          {"modality", static_cast<int>(drawing_.preview().modality)},
          {"final_light", drawing_.finalLight()}}},
        {"exports", exportsJson()},
        {"comparison", comparisonJson()},
        {"theme", settings_.theme == ui::ThemeKind::Light ? "light" : "dark"},
        {"zoom", settings_.zoom},
        {"scale", window_.contentScale()},
        {"recent", settings_.recent},
        {"start", startJson()},
        {"log_version", log_.version()},
        {"gl_errors", window_.glErrors()},
        {"frames", window_.frames()},
        {"longest_frame_ms", window_.longestFrame().total_ms},
        {"longest_frame",
         {{"widgets_ms", window_.longestFrame().widgets_ms},
          {"draw_ms", window_.longestFrame().draw_ms},
          {"swap_ms", window_.longestFrame().swap_ms},
          {"processor_ms", window_.longestFrame().processor_ms}}},
        {"picture_ms", drawing_.view().milliseconds},
        {"picture_serial", drawing_.view().serial},
        {"items", std::move(items)},
        {"cut_text", std::move(cut_text)},
    };
    questions_.addTo(state);
    addSceneAndPlanTo(state);
    window_.resetLongestFrame();
    return state;
}

}  // namespace dollytrack::editor
