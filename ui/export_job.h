#pragma once

#include "engine/core/result.h"

#include <filesystem>
#include <string>
#include <vector>

namespace dollytrack::ui {

/// The settings of one dataset export.
struct ExportRequest {
    std::string name;  // project name, for display
    std::filesystem::path folder;
    std::string range = "::";             // "a:b:s": frames a up to b (not included), every s-th
    std::vector<std::string> modalities;  // empty: the default set
    std::vector<std::string> formats;     // empty: the default set
    std::string flow_distances;           // frame distances of optical flow, "1,5"; empty: 1
    std::filesystem::path rig;            // a camera rig file for additional cameras; empty: none
    bool still = false;                   // objects with a track stay at their planned poses
    bool overwrite = false;
    int frames = 0;  // expected number of frames, for display; 0: unknown
};

enum class ExportState { Waiting, Running, Stopping, Done, Cancelled, Failed };

/// An export request in the queue, with its state and progress.
struct ExportJob {
    int id = 0;
    ExportRequest request;
    ExportState state = ExportState::Waiting;
    bool resumes = false;  // continues an interrupted export
    std::string stage;     // "rendering"
    double fraction = 0.0;
    int frames_done = 0;
    int frames = 0;                       // 0: not known yet
    double frames_per_s = 0.0;            // 0: not known yet
    double seconds_left = 0.0;            // 0: not known yet
    Error error;                          // set if state is Failed
    std::vector<std::string> last_words;  // the export program's last output lines, oldest first
    std::filesystem::path contact_sheet;  // empty until it exists
    bool reported_end = false;            // the export program reported completion

    [[nodiscard]] bool active() const {
        return state == ExportState::Running || state == ExportState::Stopping;
    }
};

}  // namespace dollytrack::ui
