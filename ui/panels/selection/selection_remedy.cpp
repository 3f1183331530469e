#include "ui/panels/selection/selection_remedy.h"

#include "ui/theme.h"
#include "ui/widgets/form.h"
#include "ui/widgets/item_map.h"

#include <imgui.h>

namespace dollytrack::ui {

RemedyActions drawRemedy(const RemedySearch& search) {
    RemedyActions actions;
    using State = RemedySearch::State;
    switch (search.state) {
        case State::NotAsked:
            actions.find = button("Find a remedy", "selection.find_remedy",
                                  {.tip = "Plan with one change after another, and show the "
                                          "smallest change that captures it"});
            break;
        case State::Searching:
            ImGui::ProgressBar(static_cast<float>(search.fraction),
                               {-scaled(90), ImGui::GetFrameHeight()}, "trying changes");
            ImGui::SameLine();
            actions.cancel = button("Cancel", "selection.cancel_remedy");
            break;
        case State::Found:
            paragraph("Remedy: " + search.row.remedy->text + ".", palette().good);
            nameItem("selection.remedy");
            if (search.can_be_applied) {
                actions.apply =
                    button("Apply", "selection.apply_remedy",
                           {.tip = "Apply the remedy as one undo step", .primary = true});
            } else if (search.row.remedy->move_object != 0) {
                actions.select_object =
                    button("Select it to move it", "selection.select_remedy",
                           {.tip = "You choose where to: press G to move it", .primary = true});
            }
            break;
        case State::Nothing:
            paragraph("None of the tested changes captures it.", palette().text_dim);
            nameItem("selection.no_remedy");
            break;
        case State::Failed:
            paragraph(search.error, palette().bad);
            break;
    }
    return actions;
}

}  // namespace dollytrack::ui
