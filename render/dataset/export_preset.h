#pragma once

#include "engine/core/result.h"
#include "render/dataset/dataset_job.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dollytrack::render {

/// A named selection of the modalities and formats that one use of a dataset needs. It changes
/// neither the trajectory nor the appearance of images, which are set by parameters.
struct ExportPreset {
    const char* name;                     // on the command line
    const char* title;                    // on buttons
    const char* text;                     // description for users
    std::vector<std::string> modalities;  // as in DatasetSettings: empty: the standard ones
    std::vector<std::string> formats;
};

/// All presets; the first one is the standard selection.
[[nodiscard]] std::span<const ExportPreset> exportPresets();

/// Sets the lists of the settings that are empty to those of a preset; an empty name changes
/// nothing. Returns Usage for an unknown name.
[[nodiscard]] Status applyPreset(std::string_view name, DatasetSettings& settings);

}  // namespace dollytrack::render
