#pragma once

#include "engine/math/up_axis.h"

#include <optional>
#include <string>
#include <vector>

namespace dollytrack {

/// How a scene file should likely be read instead: what `--unit` and `--up` would say.
struct ImportProposal {
    std::optional<double> unit_m;   // metres per unit
    std::optional<UpAxis> up_axis;  // in the file
    std::string unit_doubt;         // why, without a full stop; empty: the unit is believed
    std::string up_doubt;

    [[nodiscard]] bool isEmpty() const { return unit_doubt.empty() && up_doubt.empty(); }
    /// Whether there is anything to apply: a doubt may know no better.
    [[nodiscard]] bool hasSettings() const { return unit_m || up_axis; }
};

/// "1 unit = 4.1 m, z up": what is proposed, for people.
[[nodiscard]] std::string settingsText(const ImportProposal& proposal);

/// One sentence a doubt, each with the options of the command line that follow from it.
[[nodiscard]] std::vector<std::string> describe(const ImportProposal& proposal);

}  // namespace dollytrack
