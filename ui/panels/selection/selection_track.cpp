#include "engine/document/object_track.h"
#include "engine/plan/object_key.h"
#include "ui/panels/edits/edit_parts.h"
#include "ui/panels/selection/selection_details.h"
#include "ui/theme.h"
#include "ui/widgets/form.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <numbers>

namespace dollytrack::ui {
namespace {

using nlohmann::json;

json trackOperation(const json& object, const std::vector<TrackKey>& track) {
    json keys = json::array();
    for (const TrackKey& key : track) {
        keys.push_back({{"time_s", key.time_s},
                        {"offset", pointJson(key.move.offset_m)},
                        {"turn_deg", key.move.turn_rad * 180.0 / std::numbers::pi}});
    }
    return {{"op", "object_track"}, {"object", object}, {"keys", std::move(keys)}};
}

}  // namespace

json addKeyOperation(const Edits& edits, const Scene& scene, int id, double time_s) {
    const ObjectChange* change = findChange(edits, scene, id);
    const ObjectChange none;
    const ObjectChange& now = change != nullptr ? *change : none;
    return trackOperation(objectKey(scene, id),
                          withKey(now.track, {time_s, now.move.value_or(ObjectMove{})}));
}

json removeKeyOperation(const Edits& edits, const Scene& scene, int id, double time_s) {
    const ObjectChange* change = findChange(edits, scene, id);
    if (change == nullptr) return {};
    std::vector<TrackKey> track = change->track;
    if (std::erase_if(track, [&](const TrackKey& key) { return key.time_s == time_s; }) == 0) {
        return {};
    }
    return trackOperation(objectKey(scene, id), track);
}

void drawTrack(const SelectionView& view, int id, SelectionActions& actions) {
    const ObjectChange* change =
        view.edits == nullptr ? nullptr : findChange(*view.edits, *view.scene, id);
    const std::vector<TrackKey> none;
    const std::vector<TrackKey>& track = change != nullptr ? change->track : none;
    heading("Moving");
    if (track.empty()) {
        ImGui::TextDisabled("No keys: the object does not move.");
    } else {
        if (!beginForm("track")) return;
        for (std::size_t i = 0; i < track.size(); ++i) {
            formLine(i == 0 ? "Keys" : "");
            const TrackKey& key = track[i];
            if (link(fmt::format("{:g} s", key.time_s), fmt::format("selection.key.{}", i),
                     "Go to this time")) {
                actions.edit.operation = {{"op", "at_time"}, {"time_s", key.time_s}};
                actions.went_to_s = key.time_s;
            }
            ImGui::SameLine();
            ImGui::TextColored(palette().text_dim, "%s",
                               fmt::format("{}; {:.0f}\u00b0", placeText(key.move.offset_m),
                                           key.move.turn_rad * 180.0 / std::numbers::pi)
                                   .c_str());
        }
        endForm();
    }
    const bool at_key =
        std::ranges::find(track, view.track_time_s, &TrackKey::time_s) != track.end();
    const std::string add =
        fmt::format("{} key at {:g} s", at_key ? "Set" : "Add", view.track_time_s);
    if (button(add.c_str(), "selection.add_key",
               {.why_not = view.edits == nullptr ? "No project is open." : "",
                .tip = "Add a key with its pose at this time (I)"})) {
        actions.edit.operation = addKeyOperation(*view.edits, *view.scene, id, view.track_time_s);
    }
    flowTo("Remove key");
    if (button("Remove key", "selection.remove_key",
               {.why_not = at_key ? "" : "It has no key at this time.",
                .tip = "Remove the key at this time (Alt+I)"})) {
        actions.edit.operation =
            removeKeyOperation(*view.edits, *view.scene, id, view.track_time_s);
    }
    flowTo("Remove track");
    if (button("Remove track", "selection.remove_track",
               {.why_not = track.empty() ? "It has no keys." : "",
                .tip = "Remove all keys; the object stays where it is"})) {
        actions.edit.operation = trackOperation(objectKey(*view.scene, id), {});
    }
}

}  // namespace dollytrack::ui
