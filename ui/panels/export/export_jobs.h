#pragma once

#include "ui/panels/export/export_panel.h"

namespace dollytrack::ui {

/// Draws the export queue: each job with its state, progress and buttons.
void drawExportJobs(const ExportView& view, ExportActions& actions);

}  // namespace dollytrack::ui
