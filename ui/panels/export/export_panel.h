#pragma once

#include "engine/camera/camera_params.h"
#include "engine/core/field_list.h"
#include "ui/export_job.h"

#include <string>
#include <vector>

namespace dollytrack::ui {

/// A modality or a format that a dataset can contain.
struct ExportChoice {
    std::string name;          // name on the command line
    std::string text;          // description for the user
    bool standard = true;      // selected by default
    bool colour = false;       // contains colour images
    std::string group = {};    // heading of its row in the form
    std::string why_not = {};  // why it cannot be written now; empty: it can
};

/// A named selection of modalities and formats.
struct ExportPresetChoice {
    std::string name;   // name on the command line
    std::string title;  // label of its button
    std::string text;   // description for the user
    std::vector<std::string> modalities;
    std::vector<std::string> formats;
};

/// Input of the panel for one window frame.
struct ExportView {
    std::string project;  // name of the open project; empty: none is open
    std::string why_not;  // why the project cannot be exported; empty: it can
    std::string doubt;    // a doubt about its trajectory; empty: none
    int frame_count = 0;  // frames of its trajectory
    int current_frame = 0;
    CameraParams camera;
    FieldList* parameters = nullptr;      // the project's export parameters; null: none
    const FieldList* standard = nullptr;  // the same fields with their default values
    std::string folder_says;              // contents of the folder; empty: none, or unchecked
    bool folder_warns = false;            // `folder_says` is a warning
    std::string why_not_folder;           // why the folder cannot be written; empty: it can
    double bytes_per_frame = 0.0;         // an estimate; 0: unknown
    bool has_tracks = false;              // some objects have a track
    std::vector<ExportChoice> modalities;
    std::vector<ExportChoice> formats;
    std::vector<ExportPresetChoice> presets;  // the first is the default selection
    std::vector<ExportJob> jobs;              // in the queue's order
    bool held = false;                        // no waiting job is started
    std::string reading;        // name of another project that is being read; empty: none
    std::string why_no_folder;  // why folders cannot be opened in a file manager; empty: they can
};

/// The settings of the next export. The frames are every `step`-th from `first` to `last`, both
/// included; `last` -1: up to the end.
struct ExportDraft {
    std::string folder;
    bool current_only = false;
    int first = 0;
    int last = -1;
    int step = 1;
    bool keep_ratio = false;  // keep the ratio of width to height
    double ratio = 0.0;       // width / height before the current edit
    std::string preset;       // name of the preset that was chosen last; empty: the first one
    std::string filter;       // text that the shown modalities and formats contain
    // Names whose check box differs from the default.
    std::vector<std::string> turned_modalities;
    std::vector<std::string> turned_formats;
    std::string flow_distances = "1";  // frame distances, "1,5"
    std::string rig;                   // a camera rig file for additional cameras; empty: none
    bool still = false;
    bool overwrite = false;

    /// Resets the folder, the frame range and `overwrite`, which belong to one project; the
    /// contents to write stay selected.
    void forgetProject() {
        folder.clear();
        current_only = false;
        first = 0;
        last = -1;
        step = 1;
        overwrite = false;
    }
};

/// User actions of this frame; jobs are given by their id, 0: none.
struct ExportActions {
    bool choose_folder = false;
    bool choose_rig = false;
    std::string edited;           // name of the changed parameter; empty: none
    bool finished = false;        // the edit is complete and becomes one undo step
    bool add_current = false;     // add requestOf(view, state) to the queue
    bool add_files = false;       // choose other projects to export with these settings
    bool cancel_reading = false;  // of other projects
    bool toggle_hold = false;
    int cancel = 0;
    int resume = 0;
    int remove = 0;
    int earlier = 0;
    int later = 0;
    int open_folder = 0;
    int show_sheet = 0;
    // Height that the panel lacks to show everything without scrolling, px; below 0: height to
    // spare.
    float missing_height = 0.0F;
};

/// Draws the export settings and the queue.
ExportActions drawExportPanel(const ExportView& view, ExportDraft& state);

/// The export request for the settings, with its range clamped to the trajectory.
[[nodiscard]] ExportRequest requestOf(const ExportView& view, const ExportDraft& state);
/// The frame range for other projects, whose frame counts differ: a set `last` stays, otherwise the
/// range is open-ended; all frames if `current_only`.
[[nodiscard]] std::string rangeForOthers(const ExportDraft& state);
[[nodiscard]] int frameCountOf(const ExportView& view, const ExportDraft& state);

/// "12 of 120 frames, 8.1 a second, 13 s left"; unknown parts are omitted.
[[nodiscard]] std::string progressText(const ExportJob& job);

/// "4 min 10 s"
[[nodiscard]] std::string durationText(double seconds);

}  // namespace dollytrack::ui
