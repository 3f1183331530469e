#include "engine/document/history_json.h"

#include "engine/document/edits_json.h"
#include "engine/document/json_reader.h"
#include "engine/io/files/bounded_json.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <string>
#include <utility>

namespace dollytrack {
namespace {

/// All of a state except its given motion.
nlohmann::json stateJson(const ProjectState& state) {
    Edits edits = state.edits;
    edits.plan.motion = {};
    return {
        {"parameters", state.parameters}, {"edits", editsJson(edits)}, {"import", state.import}};
}

tl::unexpected<Error> badStep(std::size_t step, const std::string& why) {
    return fail(ErrorCode::BadInput, "The undo history cannot be read: " + why + ".",
                "history.steps[" + std::to_string(step) + "]");
}

}  // namespace

nlohmann::json historyJson(const CommandStack::History& history, std::size_t most) {
    const std::size_t count = history.steps.size();
    const std::size_t newest = count > most ? count - most : 0;
    const std::size_t first = std::min(history.position, newest);
    nlohmann::json steps = nlohmann::json::array();
    nlohmann::json before = nlohmann::json::object();
    SharedMotion motion;
    for (std::size_t i = first; i < count; ++i) {
        nlohmann::json now = stateJson(*history.steps[i].state);
        nlohmann::json& step = steps.emplace_back(nlohmann::json{
            {"name", history.steps[i].name}, {"changes", nlohmann::json::diff(before, now)}});
        before = std::move(now);
        // Motions are long: they are stored in full, at the steps that change them.
        const SharedMotion& next = history.steps[i].state->edits.plan.motion;
        if (next == motion) continue;
        step["motion"] = next ? motionJson(*next) : nlohmann::json();
        motion = next;
    }
    return {{"position", history.position - first}, {"steps", std::move(steps)}};
}

Result<CommandStack::History> historyFromJson(const nlohmann::json& json) {
    CommandStack::History history;
    nlohmann::json state = nlohmann::json::object();
    SharedMotion motion;
    try {
        for (const nlohmann::json& step : json.at("steps")) {
            state = state.patch(step.at("changes"));
            ProjectState read;
            read.parameters = state.at("parameters");
            read.import = state.value("import", nlohmann::json());
            const bool has_import = read.import.is_object() || read.import.is_null();
            if (!read.parameters.is_object() || !has_import) {
                return badStep(history.steps.size(),
                               "its parameters or import settings are not a JSON object");
            }
            Result<Edits> edits = editsFromJson(state.at("edits"));
            if (!edits) return badStep(history.steps.size(), describe(edits.error()));
            read.edits = std::move(*edits);
            if (const auto given = step.find("motion"); given != step.end()) {
                Status status;
                motion = given->is_null() ? SharedMotion()
                                          : readMotion(JsonReader(*given, "motion", status));
                if (!status) return badStep(history.steps.size(), describe(status.error()));
            }
            read.edits.plan.motion = motion;
            history.steps.push_back({step.at("name").get<std::string>(),
                                     std::make_shared<const ProjectState>(std::move(read))});
        }
        history.position = json.at("position").get<std::size_t>();
    } catch (const nlohmann::json::exception& error) {
        return badStep(history.steps.size(), plainReason(error));
    }
    if (history.position >= history.steps.size()) {
        return badStep(history.position, "there is no such step");
    }
    return history;
}

}  // namespace dollytrack
