#include "app/editor/editor.h"
#include "engine/core/log.h"
#include "engine/document/edits_json.h"
#include "engine/document/json_reader.h"
#include "ui/panels/edits/edit_parts.h"
#include "ui/widgets/cut_lines.h"
#include "ui/widgets/item_map.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <numbers>
#include <tuple>

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
    state["stages_computed"] = nlohmann::json::array();
    if (shown.plan) {
        for (const StageTime& stage : shown.plan->stages) {
            if (!stage.reused) state["stages_computed"].push_back(stage.name);
        }
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

void Editor::addProjectTo(nlohmann::json& state) {
    const bool open = workspace_.isOpen();
    state["open"] = open;
    state["project"] = workspace_.path().string();
    state["title"] = workspace_.title();
    state["unsaved"] = workspace_.unsaved();
    state["parameters"] = open ? workspace_.state().parameters : nlohmann::json();
    state["history"] = workspace_.history().names();
    state["history_position"] = workspace_.history().position();
    state["busy"] = {{"loading", workspace_.loading().busy || autosave_.searching()},
                     {"planning", workspace_.planning().busy},
                     {"saving", workspace_.saving()},
                     {"lighting", workspace_.lighting()},
                     {"drawing", drawing_.busy()}};
    state["plan_is_current"] = open && workspace_.planIsCurrent();
    state["plan_error"] = workspace_.planError();
    state["plan_outdated"] = workspace_.shown().outdated;
    state["file_changed"] = workspace_.fileChanged();
    state["import"] = open ? workspace_.importSettings() : nlohmann::json();
    state["latency_ms"] = workspace_.lastLatency_ms();
    state["edits"] = open ? editsJson(workspace_.state().edits) : nlohmann::json();
    state["autosaves"] = autosave_.count();
}

void Editor::addSelectionTo(nlohmann::json& state) const {
    state["selected"] = selected_.objects();
    state["selection_kind"] = static_cast<int>(selected_.now().kind);
    state["selection_index"] = selected_.now().index;
    state["drag_text"] = gizmo_.text();
    state["move"] = planning::moveText(panels_.move.request());
    state["move_path"] = nlohmann::json::array();
    if (const ui::MovePreview* preview = move_preview_.preview()) {
        for (const Eigen::Vector3d& position : preview->path) {
            state["move_path"].push_back(ui::pointJson(position));
        }
    }
    state["local_view"] = selected_.inLocalView();
    state["hidden"] = std::ranges::count(selected_.hidden(), true);
    state["hidden_ids"] = numbersOf(selected_.hidden());
}

void Editor::addTimelineTo(nlohmann::json& state) const {
    state["frame"] = playback_.frame();
    state["playing"] = playback_.playing();
    state["track_time"] = track_time_.now();
    state["tracks_play"] = track_time_.playing();
    state["step"] = step_playback_.taken();
}

void Editor::addViewTo(nlohmann::json& state) {
    const ui::ViewerCamera& camera = panels_.viewport.camera;
    state["through_camera"] = through_camera_;
    state["view_name"] = viewName();
    state["camera"] = {{"pivot", {camera.pivot.x(), camera.pivot.y(), camera.pivot.z()}},
                       {"azimuth", camera.azimuth},
                       {"elevation", camera.elevation},
                       {"distance", camera.distance},
                       {"orthographic", camera.orthographic}};
    state["layers"] = {
        {"free_space", layer_settings_.free_space}, {"points", layer_settings_.points},
        {"roadmap", layer_settings_.roadmap},       {"trajectory", layer_settings_.trajectory},
        {"candidates", layer_settings_.candidates}, {"no_go", layer_settings_.no_go_boxes},
        {"quality", layer_settings_.quality},       {"slice_m", layer_settings_.slice.position_m},
        {"stepping", step_playback_.shown()}};
    state["legends"] = legendsJson(layers_.layers());
    state["box_select"] = panels_.viewport.box_select;
    state["clip"] = clip_.shown() ? boxNumbers(*clip_.shown()) : nlohmann::json();
    state["preview"] = {{"frame", drawing_.preview().frame},
                        {"serial", drawing_.preview().serial},
                        {"open", panels_.preview.open},
                        {"docked", previewIsDocked()},
                        {"modality", static_cast<int>(drawing_.preview().modality)},
                        {"final_light", drawing_.finalLight()}};
    state["picture_ms"] = drawing_.view().milliseconds;
    state["picture_serial"] = drawing_.view().serial;
}

nlohmann::json Editor::viewToStore() const {
    const ui::ViewerCamera& camera = panels_.viewport.camera;
    nlohmann::json view = {{"camera",
                            {{"pivot", {camera.pivot.x(), camera.pivot.y(), camera.pivot.z()}},
                             {"azimuth", camera.azimuth},
                             {"elevation", camera.elevation},
                             {"distance", camera.distance},
                             {"orthographic", camera.orthographic ? 1 : 0}}},
                           {"frame", stored_frame_.value_or(playback_.frame())},
                           {"hidden", numbersOf(selected_.hidden())}};
    const ui::ExportDraft& draft = panels_.export_draft;
    const ui::ExportDraft unchanged;
    const auto chosen = [](const ui::ExportDraft& one) {
        return std::tie(one.folder, one.first, one.last, one.step);
    };
    if (chosen(draft) != chosen(unchanged)) {
        view["export"] = {{"folder", draft.folder},
                          {"first", draft.first},
                          {"last", draft.last},
                          {"step", draft.step}};
    }
    return view;
}

void Editor::restoreView() {
    constexpr int kMostNumbers = 1'000'000;
    constexpr double kFarthest_m = 1e4;
    constexpr double kFull = 2.0 * std::numbers::pi;
    if (!workspace_.isOpen() || workspace_.storedView().is_null()) return;
    Status read;
    const JsonReader view(workspace_.storedView(), "view", read);
    const JsonReader stored = view.at("camera");
    ui::ViewerCamera camera = panels_.viewport.camera;
    camera.pivot = stored.at("pivot").point();
    camera.azimuth = stored.at("azimuth").number(-1e6, 1e6);
    camera.elevation = stored.at("elevation").number(-kFull, kFull);
    camera.distance = stored.at("distance").number(1e-3, kFarthest_m);
    camera.orthographic = stored.at("orthographic").integer(0, 1) != 0;
    const int frame = view.at("frame").integer(0, kMostNumbers);
    std::vector<int> hidden;
    const JsonReader ids = view.at("hidden");
    for (std::size_t i = 0; i < ids.size() && read; ++i) {
        hidden.push_back(ids.at(i).integer(1, kMostNumbers));
    }
    if (read && camera.pivot.norm() > kFarthest_m) view.refuse("The camera is too far away.");
    if (!read) {
        log::warn("project",
                  "the stored view is damaged and is not used: " + describe(read.error()));
        return;
    }
    Status export_read;
    const JsonReader stored_export =
        JsonReader(workspace_.storedView(), "view", export_read).at("export");
    if (!stored_export.absent()) {
        ui::ExportDraft draft = panels_.export_draft;
        draft.folder = stored_export.at("folder").text();
        draft.first = stored_export.at("first").integer(0, kMostNumbers);
        draft.last = stored_export.at("last").integer(-1, kMostNumbers);
        draft.step = stored_export.at("step").integer(1, kMostNumbers);
        if (export_read) panels_.export_draft = draft;
    }
    selected_.hideStored(hidden);
    stored_frame_ = frame;
    panels_.viewport.camera = camera;
    static_cast<void>(scene_sync_.takeFirstView());
}

void Editor::addWindowTo(nlohmann::json& state) {
    state["window"] = {window_.settings().width, window_.settings().height};
    state["dialogs"] = {{"file", files_.isOpen()},
                        {"help", panels_.help.open},
                        {"palette", panels_.palette.open},
                        {"sheet", sheet_.isOpen()}};
    state["theme"] = settings_.theme == ui::ThemeKind::Light ? "light" : "dark";
    state["zoom"] = settings_.zoom;
    state["scale"] = window_.contentScale();
    state["recent"] = settings_.recent;
    state["start"] = startJson();
    state["log_version"] = log_.version();
    state["gl_errors"] = window_.glErrors();
    state["frames"] = window_.frames();
    const auto& longest = window_.longestFrame();
    state["longest_frame_ms"] = longest.total_ms;
    state["longest_frame"] = {{"widgets_ms", longest.widgets_ms},
                              {"draw_ms", longest.draw_ms},
                              {"swap_ms", longest.swap_ms},
                              {"processor_ms", longest.processor_ms}};
    state["items"] = nlohmann::json::object();
    for (const ui::NamedItem& item : ui::item_map::items()) {
        state["items"][item.name] = {item.left, item.top, item.right, item.bottom, item.enabled};
    }
    state["cut_text"] = nlohmann::json::array();
    for (const ui::CutLine& line : ui::cutLines()) {
        state["cut_text"].push_back({line.text, line.left, line.top, line.right, line.bottom});
    }
}

nlohmann::json Editor::stateJson() {
    nlohmann::json state;
    addProjectTo(state);
    addSelectionTo(state);
    addTimelineTo(state);
    addViewTo(state);
    addWindowTo(state);
    state["exports"] = exportsJson();
    state["comparison"] = comparisonJson();
    questions_.addTo(state);
    addSceneAndPlanTo(state);
    window_.resetLongestFrame();
    return state;
}

}  // namespace dollytrack::editor
