#pragma once

#include "ui/panels/export_panel.h"
#include "ui/panels/history_panel.h"
#include "ui/panels/image_viewer.h"
#include "ui/panels/log_panel.h"
#include "ui/panels/objects_panel.h"
#include "ui/panels/preview_panel.h"
#include "ui/panels/selection_panel.h"
#include "ui/panels/steps_panel.h"
#include "ui/panels/timeline_panel.h"
#include "ui/viewport/viewport_pane.h"
#include "ui/widgets/command_palette.h"
#include "ui/widgets/help_overlay.h"
#include "ui/widgets/legend_view.h"

namespace dollytrack::editor {

/// What the panels remember from one frame of the window to the next.
struct PanelStates {
    ui::ViewportState viewport;
    ui::ObjectsPanelState objects;
    ui::HistoryState history;
    ui::SelectionState selection;
    ui::TimelineState timeline;
    ui::StepsState steps;
    ui::LogPanelState log;
    ui::PreviewState preview;
    ui::LegendBoxState legend;
    ui::ExportDraft export_draft;
    ui::ImageViewerState sheet;
    ui::HelpState help;
    ui::CommandPaletteState palette;
};

}  // namespace dollytrack::editor
