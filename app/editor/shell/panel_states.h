#pragma once

#include "ui/panels/edits/move_form.h"
#include "ui/panels/export/export_panel.h"
#include "ui/panels/plan/history_panel.h"
#include "ui/panels/plan/log_panel.h"
#include "ui/panels/scene/image_viewer.h"
#include "ui/panels/scene/objects_panel.h"
#include "ui/panels/scene/preview_panel.h"
#include "ui/panels/scene/start_panel.h"
#include "ui/panels/selection/selection_panel.h"
#include "ui/panels/timeline/steps_panel.h"
#include "ui/panels/timeline/timeline_panel.h"
#include "ui/viewport/legend_view.h"
#include "ui/viewport/viewport_pane.h"
#include "ui/widgets/commands/command_palette.h"
#include "ui/widgets/commands/help_overlay.h"

namespace dollytrack::editor {

/// The panels' state between window frames.
struct PanelStates {
    ui::ViewportState viewport;
    ui::StartState start;
    ui::ObjectsPanelState objects;
    ui::MoveDraft move;
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
