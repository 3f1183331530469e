#pragma once

#include "ui/panels/export/export_panel.h"

namespace dollytrack::ui {

/// The queue: each job with its state, progress and what can be done with it.
void drawExportJobs(const ExportView& view, ExportActions& actions);

}  // namespace dollytrack::ui
