#include "app/editor/editor.h"
#include "ui/widgets/item_map.h"

#include <nlohmann/json.hpp>

namespace dollytrack::editor {

nlohmann::json Editor::stateJson() {
    const PlanOutcome& shown = workspace_.shown();
    nlohmann::json items = nlohmann::json::object();
    for (const ui::NamedItem& item : ui::item_map::items()) {
        items[item.name] = {item.left, item.top, item.right, item.bottom, item.enabled};
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
         {{"loading", workspace_.loading().busy},
          {"planning", workspace_.planning().busy},
          {"saving", workspace_.saving()},
          {"lighting", workspace_.lighting()},
          {"drawing", drawing_.busy()}}},
        {"plan_is_current", workspace_.isOpen() && workspace_.planIsCurrent()},
        {"plan_error", workspace_.planError()},
        {"latency_ms", workspace_.lastLatency_ms()},
        {"selected", selected_},
        {"gl_errors", window_.glErrors()},
        {"frames", window_.frames()},
        {"longest_frame_ms", window_.longestFrame_ms()},
        {"picture_ms", drawing_.view().milliseconds},
        {"picture_serial", drawing_.view().serial},
        {"items", std::move(items)},
    };
    if (shown.plan) {
        state["plan"] = {{"frames", shown.plan->trajectory.frames.size()},
                         {"key_frames", shown.plan->key_frames.size()},
                         {"captured", shown.plan->capture_metrics.captured},
                         {"well_captured", shown.plan->capture_metrics.well_captured},
                         {"objects", shown.plan->capture_metrics.objects}};
    }
    window_.resetLongestFrame();
    return state;
}

}  // namespace dollytrack::editor
