#pragma once

#include "engine/core/result.h"

#include <filesystem>
#include <string>
#include <vector>

namespace dollytrack::ui {

/// A dataset somebody wants.
struct ExportRequest {
    std::string name;  // of the project, for people
    std::filesystem::path folder;
    std::string range = "::";             // "a:b:s": frames a up to b (not included), every s-th
    std::vector<std::string> modalities;  // empty: the standard ones
    std::vector<std::string> formats;     // empty: the standard ones
    std::string flow_distances;           // "1,5": optical flow to the frames so far away; empty: 1
    std::filesystem::path rig;            // a file of cameras that ride along; empty: none
    bool still = false;                   // things that have a track stay where the plan has them
    bool overwrite = false;
};

enum class ExportState { Waiting, Running, Stopping, Done, Cancelled, Failed };

/// A request in the queue and how far it is.
struct ExportJob {
    int id = 0;
    ExportRequest request;
    ExportState state = ExportState::Waiting;
    bool resumes = false;  // goes on where an earlier attempt ended
    std::string stage;     // "rendering"
    double fraction = 0.0;
    int frames_done = 0;
    int frames = 0;                       // 0: not known yet
    double frames_per_s = 0.0;            // 0: not known yet
    double seconds_left = 0.0;            // 0: not known yet
    Error error;                          // of a failed one
    std::vector<std::string> last_words;  // what the program said last, oldest first
    std::filesystem::path contact_sheet;  // empty until it is there
    bool reported_end = false;            // the program said that it was done

    [[nodiscard]] bool active() const {
        return state == ExportState::Running || state == ExportState::Stopping;
    }
};

}  // namespace dollytrack::ui
