#pragma once

#include "ui/panels/export/export_panel.h"

#include <string>
#include <vector>

/// What the settings of an export come to, for the panel to show; nothing here draws.
namespace dollytrack::ui {

/// The last frame comes before the first, as it does while only one of them is set. Neither is
/// changed to fit the other: one would get another range than one typed.
[[nodiscard]] bool isReversed(const ExportDraft& draft);

/// `turned`: the names whose box is no longer as it was at first.
[[nodiscard]] bool isWanted(const ExportChoice& choice, const std::vector<std::string>& turned);
[[nodiscard]] bool wantsFlow(const ExportView& view, const ExportDraft& draft);
[[nodiscard]] bool wantsSensors(const ExportView& view, const ExportDraft& draft);
[[nodiscard]] bool wantsPictures(const ExportView& view, const ExportDraft& draft);

/// What of the range is not there, or nothing.
[[nodiscard]] std::string rangeNote(const ExportView& view, const ExportDraft& draft);
/// "apartment: 120 frames of 640 × 480 px, at most about 350 MB"
[[nodiscard]] std::string summaryOf(const ExportView& view, const ExportDraft& draft);
/// Why the settings cannot be exported; empty when they can.
[[nodiscard]] std::string whyNot(const ExportView& view, const ExportDraft& draft);

}  // namespace dollytrack::ui
