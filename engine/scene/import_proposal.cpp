#include "engine/scene/import_proposal.h"

#include <fmt/format.h>

namespace dollytrack {

std::string settingsText(const ImportProposal& proposal) {
    std::string text;
    if (proposal.unit_m) text = fmt::format("1 unit = {:.4g} m", *proposal.unit_m);
    if (proposal.unit_m && proposal.up_axis) text += ", ";
    if (proposal.up_axis) text += proposal.up_axis->text() + " up";
    return text;
}

std::vector<std::string> describe(const ImportProposal& proposal) {
    std::vector<std::string> lines;
    if (!proposal.up_doubt.empty()) {
        lines.push_back(
            fmt::format("{}; try --up {}", proposal.up_doubt, proposal.up_axis->text()));
    }
    if (!proposal.unit_doubt.empty()) {
        lines.push_back(proposal.unit_doubt +
                        (proposal.unit_m ? fmt::format("; try --unit {:.4g}", *proposal.unit_m)
                                         : "; if it is wrong, give metres per unit (--unit)"));
    }
    return lines;
}

}  // namespace dollytrack
