#pragma once

#include "engine/plan/frame_series.h"

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack::ui {

/// A frame that stands on a position point.
struct TimelineKey {
    int frame = 0;
    std::string text;  // what it captures, for people
};

/// A stretch of frames: a room, or a path within one.
struct TimelineBand {
    int begin = 0;
    int end = 0;  // one past its last frame
    std::string name;
};

/// What the panel may read this frame. Pointers may be null where there is nothing yet.
struct TimelineView {
    int frame_count = 0;
    double frame_interval_s = 0.1;
    const std::vector<double>* times_s = nullptr;  // of the frames; null: at even intervals
    int frame = 0;                                 // shown now
    bool playing = false;
    const std::vector<TimelineKey>* keys = nullptr;  // by rising frame
    const std::vector<TimelineBand>* bands = nullptr;
    const FrameSeries* series = nullptr;   // null, or of another length: being measured
    const FrameSeries* earlier = nullptr;  // of the plan before, shown until then; null: none
    int target_count = 0;
    std::function<std::string(int)> object_name = {};  // of an id
    // Lines across the strips; 0: none.
    double camera_radius_m = 0.0;
    double max_speed_mps = 0.0;
    double max_turn_dps = 0.0;
};

enum class TimelineStrip { Clearance, Speed, Turn, Score, InView, Captured };
constexpr std::size_t kTimelineStrips = 6;

/// What the panel remembers; the shell plays at `speed` and begins again where `loop` is set.
struct TimelineState {
    double speed = 1.0;  // times the frame rate
    bool loop = false;
    std::array<bool, kTimelineStrips> strips = {true, true, false, false, true, true};
    // What is shown of the frames: all of them when `shown` is 0.
    double first = 0.0;
    double shown = 0.0;
    int count = 0;       // of frames, when that was chosen
    int last_frame = 0;  // shown in the last frame of the window
};

struct TimelineActions {
    std::optional<int> go_to;  // frame; within the trajectory
    bool toggle_play = false;
};

/// Transport, scrubber with key frames and rooms, and a strip for each thing measured a frame.
TimelineActions drawTimelinePanel(const TimelineView& view, TimelineState& state);

/// The key frame after (`direction` 1) or before (-1) `frame`, if there is one.
[[nodiscard]] std::optional<int> neighbourKey(const std::vector<TimelineKey>& keys, int frame,
                                              int direction);

}  // namespace dollytrack::ui
