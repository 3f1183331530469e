#pragma once

#include "ui/panels/export/export_panel.h"

#include <string>
#include <vector>

/// Queries about the settings of an export: validity, size and wording for the panel. Nothing here
/// draws.
namespace dollytrack::ui {

/// Whether the last frame comes before the first, as it may while only one of them has been edited.
/// Neither is adjusted to fit the other, so that a typed value is never changed.
[[nodiscard]] bool isReversed(const ExportDraft& draft);

/// Whether the choice is selected. `turned` lists the names whose check box differs from the
/// default.
[[nodiscard]] bool isWanted(const ExportChoice& choice, const std::vector<std::string>& turned);
/// Whether the choice is selected and can be written.
[[nodiscard]] bool isWritten(const ExportChoice& choice, const std::vector<std::string>& turned);
/// Whether the filter's text is part of the choice's name, description or group.
[[nodiscard]] bool matchesFilter(const ExportChoice& choice, const std::string& filter);

/// Selects the modalities and formats of a preset.
void choosePreset(const ExportView& view, const ExportPresetChoice& preset, ExportDraft& draft);
/// The preset that was chosen last; null: the view has none.
[[nodiscard]] const ExportPresetChoice* chosenPreset(const ExportView& view,
                                                     const ExportDraft& draft);
/// The modalities and formats in which the selection differs from the preset that was chosen last,
/// as "+ depth_exr, - coco"; empty if there are none.
[[nodiscard]] std::string changesOfPreset(const ExportView& view, const ExportDraft& draft);

/// The selected modalities that cannot be written, as "albedo, normals"; empty if there are none.
[[nodiscard]] std::string leftOut(const ExportView& view, const ExportDraft& draft);

[[nodiscard]] bool wantsFlow(const ExportView& view, const ExportDraft& draft);
[[nodiscard]] bool wantsSensors(const ExportView& view, const ExportDraft& draft);
[[nodiscard]] bool wantsPictures(const ExportView& view, const ExportDraft& draft);

/// A note on the part of the range that lies outside the trajectory; empty if there is none.
[[nodiscard]] std::string rangeNote(const ExportView& view, const ExportDraft& draft);
/// "apartment: 120 frames of 640 × 480 px, at most about 350 MB"
[[nodiscard]] std::string summaryOf(const ExportView& view, const ExportDraft& draft);
/// Why the settings cannot be exported; empty if they can.
[[nodiscard]] std::string whyNot(const ExportView& view, const ExportDraft& draft);

}  // namespace dollytrack::ui
