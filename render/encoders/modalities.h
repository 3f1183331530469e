#pragma once

#include "engine/core/result.h"
#include "render/dataset/contents/modality.h"

#include <span>
#include <string>
#include <vector>

namespace dollytrack::render {

/// The whole table, in the order in which files are written.
[[nodiscard]] std::span<const Modality> modalities();

/// Selects by name: all for "all", the standard ones if `names` is empty. Returns Usage, suggesting
/// the closest name, for an unknown one.
[[nodiscard]] Result<ModalitySet> chooseModalities(const std::vector<std::string>& names);

/// The same with regard to a rig: kRigModality is included exactly if there is a rig. Returns Usage
/// also if it is named without a rig.
[[nodiscard]] Result<ModalitySet> chooseModalities(const std::vector<std::string>& names,
                                                   bool has_rig);

}  // namespace dollytrack::render
