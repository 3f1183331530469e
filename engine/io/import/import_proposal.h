#pragma once

#include "engine/math/up_axis.h"
#include "engine/scene/scene.h"

#include <optional>
#include <string>

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

/// Judges by gravity, known sizes of furniture and the room's height whether the scene was read
/// with the right unit and upward axis. What a person has given is not doubted. Set
/// `classes_by_shape` if walls and floors may have been classified by their shape: that presumes an
/// upward axis, so these classes are then not used as evidence for it.
[[nodiscard]] ImportProposal proposeImport(const Scene& scene, bool classes_by_shape = false);

/// Replaces the proposal by another upward axis. Its doubts about the unit are dropped: heights
/// that were measured along the wrong axis say nothing about the unit.
void proposeUp(UpAxis likelier, const Scene& scene, ImportProposal& proposal);

/// "1 unit = 4.1 m, z up": what is proposed, for people.
[[nodiscard]] std::string settingsText(const ImportProposal& proposal);

/// One sentence a doubt, each with the options of the command line that follow from it.
[[nodiscard]] std::vector<std::string> describe(const ImportProposal& proposal);

}  // namespace dollytrack
