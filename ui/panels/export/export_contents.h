#pragma once

#include "ui/panels/export/export_panel.h"

/// The part of the export form that selects modalities and formats.
namespace dollytrack::ui {

/// The buttons of the presets and the search field.
void drawContentsBar(const ExportView& view, ExportDraft& draft);

/// Check boxes by group; only those that match the search field.
void drawModalities(const ExportView& view, ExportDraft& draft);
/// The same, with the settings of single formats below.
void drawFormats(const ExportView& view, ExportDraft& draft);

}  // namespace dollytrack::ui
