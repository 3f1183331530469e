#pragma once

#include "engine/core/result.h"
#include "render/dataset/contents/format.h"

#include <span>
#include <string>
#include <vector>

namespace dollytrack::render {

/// The whole table. dataset.json is always written and not part of it.
[[nodiscard]] std::span<const Format> formats();

/// Selects by name: all for "all", the standard ones if `names` is empty. Returns Usage, suggesting
/// the closest name, for an unknown one.
[[nodiscard]] Result<FormatSet> chooseFormats(const std::vector<std::string>& names);

/// Checks that the formats' required modalities are selected. Returns Usage for the first missing
/// one.
[[nodiscard]] Status checkNeeds(const FormatSet& formats, const ModalitySet& modalities);

}  // namespace dollytrack::render
