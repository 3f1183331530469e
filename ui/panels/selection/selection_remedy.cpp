#include "ui/panels/selection/selection_remedy.h"

#include "ui/theme.h"
#include "ui/widgets/forms/form.h"
#include "ui/widgets/item_map.h"

#include <imgui.h>

namespace dollytrack::ui {

RemedyActions drawRemedy(const RemedySearch& search) {
    RemedyActions actions;
    using State = RemedySearch::State;
    switch (search.state) {
        case State::NotAsked:
            actions.find = button("Find what would help", "selection.find_remedy",
                                  {.tip = "Plans again with one change after the other, and shows "
                                          "the mildest that gets it captured"});
            break;
        case State::Searching:
            ImGui::ProgressBar(static_cast<float>(search.fraction),
                               {-scaled(90), ImGui::GetFrameHeight()}, "trying changes");
            ImGui::SameLine();
            actions.cancel = button("Cancel", "selection.cancel_remedy");
            break;
        case State::Found:
            paragraph("What helps: " + search.row.remedy->text + ".", palette().good);
            nameItem("selection.remedy");
            if (search.can_be_applied) {
                actions.apply = button("Do that", "selection.apply_remedy",
                                       {.tip = "One step of undo", .primary = true});
            }
            break;
        case State::Nothing:
            paragraph("None of the changes tried gets it captured.", palette().text_dim);
            nameItem("selection.no_remedy");
            break;
        case State::Failed:
            paragraph(search.error, palette().bad);
            break;
    }
    return actions;
}

}  // namespace dollytrack::ui
