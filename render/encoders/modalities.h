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

/// What an export can make images from besides the planned camera.
struct Available {
    bool rig = false;     // cameras of a rig
    bool layers = false;  // light by layer, of path-traced images
};

/// The same for an export: kRigModality is included exactly if there is a rig, and "all" includes
/// layers of light only if they are available. Returns Usage also for the name of a modality that
/// is not available.
[[nodiscard]] Result<ModalitySet> chooseModalities(const std::vector<std::string>& names,
                                                   Available available);

}  // namespace dollytrack::render
