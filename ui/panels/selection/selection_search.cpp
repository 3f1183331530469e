#include "engine/core/text_lists.h"
#include "engine/plan/object_key.h"
#include "ui/panels/edits/edit_parts.h"
#include "ui/panels/selection/selection_details.h"
#include "ui/theme.h"
#include "ui/widgets/form.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <map>
#include <vector>

namespace dollytrack::ui {
namespace {

/// Candidates with the same verdict and occluder.
struct Outcome {
    Verdict verdict = Verdict::Legal;
    int occluder = 0;
    int count = 0;
    int best = -1;  // index of the candidate with the largest visible fraction
};

std::vector<Outcome> outcomesOf(const ViewpointSearch& search) {
    std::map<std::pair<Verdict, int>, Outcome> by_reason;
    for (int i = 0; i < static_cast<int>(search.candidates.size()); ++i) {
        const Candidate& candidate = search.candidates[i];
        Outcome& outcome = by_reason[{candidate.verdict, candidate.occluder}];
        outcome.verdict = candidate.verdict;
        outcome.occluder = candidate.occluder;
        ++outcome.count;
        const bool better =
            outcome.best < 0 ||
            candidate.visible_fraction > search.candidates[outcome.best].visible_fraction;
        if (better) outcome.best = i;
    }
    std::vector<Outcome> outcomes;
    for (const auto& [reason, outcome] : by_reason) outcomes.push_back(outcome);
    std::ranges::stable_sort(outcomes, std::ranges::greater{}, &Outcome::count);
    return outcomes;
}

/// Index of the candidate with the largest visible fraction, whatever its verdict; -1: none.
int bestCandidate(const ViewpointSearch& search) {
    const auto best = std::ranges::max_element(search.candidates, {}, &Candidate::visible_fraction);
    return best == search.candidates.end() ? -1
                                           : static_cast<int>(best - search.candidates.begin());
}

void drawOutcome(const SelectionView& view, int search, const Outcome& outcome, std::size_t number,
                 SelectionActions& actions) {
    const std::string name = fmt::format("selection.outcome.{}", number);
    ImGui::TextColored(outcome.verdict == Verdict::Legal ? palette().good : palette().text_dim,
                       "%4d", outcome.count);
    ImGui::SameLine(scaled(44));
    if (link(verdictText(outcome.verdict, objectName(*view.scene, outcome.occluder)), name,
             "Select the one that shows most")) {
        actions.select = Selection::ofCandidate(search, outcome.best);
    }
    if (outcome.occluder != 0) {
        ImGui::SameLine();
        if (button(("\u2192##" + name).c_str(), name + ".occluder",
                   {.tip = "Select the obstructing object", .small = true})) {
            actions.select = Selection::ofObject(outcome.occluder);
        }
    }
}

}  // namespace

int observationPointOf(const Plan& plan, int object_id) {
    for (std::size_t i = 0; i < plan.observation_points.size(); ++i) {
        const std::vector<int>& objects = plan.observation_points[i].objects;
        if (std::ranges::find(objects, object_id) != objects.end()) return static_cast<int>(i);
    }
    return -1;
}

void drawSearch(const SelectionView& view, int observation_point, SelectionActions& actions) {
    const std::size_t index = observation_point;
    if (index >= view.plan->searches.size()) return;
    const ViewpointSearch& search = view.plan->searches[index];
    if (search.position_point >= 0) {
        if (link("Its position point", "selection.position_point")) {
            actions.select =
                Selection::ofItem(Selection::Kind::PositionPoint, search.position_point);
        }
    } else {
        ImGui::TextColored(palette().bad, "No position point");
    }
    if (search.candidates.empty()) return;
    ImGui::TextColored(
        palette().text_dim, "%s:",
        counted(search.candidates.size(), "candidate was tested", "candidates were tested")
            .c_str());
    const std::vector<Outcome> outcomes = outcomesOf(search);
    for (std::size_t i = 0; i < outcomes.size(); ++i) {
        drawOutcome(view, observation_point, outcomes[i], i, actions);
    }
    const int best = bestCandidate(search);
    const Candidate& candidate = search.candidates[best];
    if (link(fmt::format("Best of all: {:.0f} % visible", 100.0 * candidate.visible_fraction),
             "selection.best_candidate")) {
        actions.select = Selection::ofCandidate(observation_point, best);
    }
}

void drawCandidate(const SelectionView& view, SelectionActions& actions) {
    const std::size_t search = view.selection->search;
    const ObservationPoint& target = view.plan->observation_points[search];
    const Candidate& candidate = view.plan->searches[search].candidates[view.selection->index];
    heading("Candidate");
    if (link("for " + objectNames(*view.scene, target.objects), "selection.observation_point")) {
        actions.select =
            Selection::ofItem(Selection::Kind::ObservationPoint, view.selection->search);
    }
    const bool legal = candidate.verdict == Verdict::Legal;
    ImGui::TextColored(
        legal ? palette().good : palette().bad, "%s",
        verdictText(candidate.verdict, objectName(*view.scene, candidate.occluder)).c_str());
    if (candidate.occluder != 0) {
        ImGui::SameLine();
        if (button("\u2192##occluder", "selection.occluder",
                   {.tip = "Select the obstructing object", .small = true})) {
            actions.select = Selection::ofObject(candidate.occluder);
        }
    }
    if (beginForm("candidate")) {
        formText("Place", placeText(candidate.position) + " m");
        formText("Distance",
                 fmt::format("{:.2f} m", (candidate.position - target.position).norm()));
        formText("Fill", fmt::format("{:.0f} %", 100.0 * candidate.fill),
                 "Share of the image's width or height, whichever is larger");
        formText("Visible", fmt::format("{:.0f} %", 100.0 * candidate.visible_fraction),
                 "Of the group's least visible object");
        endForm();
    }
    if (button("Look through", "selection.look")) {
        actions.look_through = lookAt(candidate.position, target.position);
    }
    flowTo("Pin here");
    if (button("Pin here", "selection.pin",
               {.why_not = target.objects.empty() ? "It has no objects." : "",
                .tip = "Fix the camera at this pose"})) {
        actions.edit.operation = {{"op", "pin"},
                                  {"objects", objectKeys(*view.scene, target.objects)},
                                  {"position", pointJson(candidate.position)},
                                  {"target", pointJson(target.position)}};
    }
}

}  // namespace dollytrack::ui
