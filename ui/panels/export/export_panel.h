#pragma once

#include "engine/camera/camera_params.h"
#include "engine/core/field_list.h"
#include "ui/export_job.h"

#include <string>
#include <vector>

namespace dollytrack::ui {

/// Something a dataset can hold.
struct ExportChoice {
    std::string name;      // as the command line takes it
    std::string text;      // what it is, for people
    bool standard = true;  // written unless it is turned off
    bool colour = false;   // holds colour pictures
};

/// What the panel may read this frame.
struct ExportView {
    std::string project;  // name of the open one
    std::string why_not;  // why the open project cannot be exported; empty when it can
    int frame_count = 0;  // of its trajectory
    int current_frame = 0;
    CameraParams camera;
    FieldList* parameters = nullptr;      // of the project, to set what is exported; null: none
    const FieldList* standard = nullptr;  // the same, as they are by default
    std::string folder_says;              // what the folder holds; empty: not known, or nothing
    bool folder_warns = false;            // of something that one may not expect
    std::string why_not_folder;           // why nothing can be written there
    double bytes_per_frame = 0.0;         // an estimate; 0: unknown
    bool has_tracks = false;              // some things move with time
    std::vector<ExportChoice> modalities;
    std::vector<ExportChoice> formats;
    std::vector<ExportJob> jobs;  // in the queue's order
    bool held = false;            // nothing new begins
    std::string why_no_folder;    // why folders cannot be opened; empty when they can
};

/// The settings of the next export, as the user has made them so far. All frames are those from
/// `first` to `last`, both included; `last` -1: to the end.
struct ExportDraft {
    std::string folder;
    bool current_only = false;
    int first = 0;
    int last = -1;
    int step = 1;
    bool keep_ratio = false;  // of width to height
    double ratio = 0.0;       // when the last edit of them began
    // Those whose box is no longer as it was at first.
    std::vector<std::string> turned_modalities;
    std::vector<std::string> turned_formats;
    std::string flow_distances = "1";  // in frames, "1,5"
    std::string rig;                   // a file of cameras that ride along; empty: none
    bool still = false;
    bool overwrite = false;

    /// Where to and which frames belong to one project; what to write holds for the next as well.
    void forgetProject() {
        folder.clear();
        current_only = false;
        first = 0;
        last = -1;
        step = 1;
        overwrite = false;
    }
};

/// What the user asked for; jobs by their number, 0: none.
struct ExportActions {
    bool choose_folder = false;
    bool choose_rig = false;
    std::string edited;        // name of the parameter that was changed
    bool finished = false;     // with the mouse let go: one step of undo
    bool add_current = false;  // with requestOf(view, state)
    bool add_files = false;    // other projects, with the same settings
    bool toggle_hold = false;
    int cancel = 0;
    int resume = 0;
    int remove = 0;
    int earlier = 0;
    int later = 0;
    int open_folder = 0;
    int show_sheet = 0;
};

/// What to export, and the queue of what is being exported.
ExportActions drawExportPanel(const ExportView& view, ExportDraft& state);

/// The request that the settings make. Their range fits the trajectory.
[[nodiscard]] ExportRequest requestOf(const ExportView& view, const ExportDraft& state);
/// The range for other projects, which have as many frames as they have: what is said to be cut off
/// here is cut off there, and the rest goes to their end.
[[nodiscard]] std::string rangeForOthers(const ExportDraft& state);
[[nodiscard]] int frameCountOf(const ExportView& view, const ExportDraft& state);

/// "12 of 120 frames, 8.1 a second, 13 s left", as far as it is known.
[[nodiscard]] std::string progressText(const ExportJob& job);

/// "4 min 10 s"
[[nodiscard]] std::string durationText(double seconds);

}  // namespace dollytrack::ui
