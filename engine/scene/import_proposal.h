#pragma once

#include "engine/math/up_axis.h"

#include <optional>
#include <string>
#include <vector>

namespace dollytrack {

/// A proposed unit and upward axis of a scene file, as values for `--unit` and `--up`.
struct ImportProposal {
    std::optional<double> unit_m;   // metres per unit
    std::optional<UpAxis> up_axis;  // in the file
    std::string unit_doubt;         // why, without a full stop; empty: no doubt
    std::string up_doubt;
    bool up_unconfirmed = false;  // the evidence for the upward axis used is weak

    [[nodiscard]] bool isEmpty() const { return unit_doubt.empty() && up_doubt.empty(); }
    /// Whether it has values to apply. There can be a doubt without a better value.
    [[nodiscard]] bool hasSettings() const { return unit_m || up_axis; }
};

/// The proposed values as text: "1 unit = 4.1 m, z up".
[[nodiscard]] std::string settingsText(const ImportProposal& proposal);

/// One sentence for each doubt, with the command-line options that apply the proposal.
[[nodiscard]] std::vector<std::string> describe(const ImportProposal& proposal);

}  // namespace dollytrack
