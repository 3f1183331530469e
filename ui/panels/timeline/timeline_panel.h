#pragma once

#include "engine/plan/frame_quality.h"
#include "engine/plan/frame_series.h"
#include "planning/motions/colliding_frames.h"

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack::ui {

/// A key frame: a frame at a position point.
struct TimelineKey {
    int frame = 0;
    std::string text;  // the captured objects, for display
};

/// A key of the given camera motion, which can be dragged to another time.
struct TimelineCameraKey {
    double time_s = 0.0;     // as set
    double reached_s = 0.0;  // of the frame that passes it
    std::string note;        // what could not be kept, for display; empty: all is kept
};

/// A range of frames in one room, or on one path within a room.
struct TimelineBand {
    int begin = 0;
    int end = 0;  // one past its last frame
    std::string name;
};

/// Input of the panel for one window frame. Null pointers stand for data that does not exist yet.
struct TimelineView {
    int frame_count = 0;
    double frame_interval_s = 0.1;
    const std::vector<double>* times_s = nullptr;  // time of each frame; null: equal intervals
    int frame = 0;                                 // current frame
    bool playing = false;
    const std::vector<TimelineKey>* keys = nullptr;               // sorted by frame
    const std::vector<TimelineCameraKey>* camera_keys = nullptr;  // null or empty: there are none
    int selected_key = -1;                                        // index of a camera key
    const std::vector<TimelineBand>* bands = nullptr;
    const std::vector<planning::CollidingFrames>* collisions = nullptr;  // null or empty: none
    const FrameSeries* series = nullptr;    // null or of a different length: being measured
    const FrameSeries* earlier = nullptr;   // the previous plan's, drawn until then; or null
    const FrameQuality* quality = nullptr;  // of the same frames as `series`; null: not measured
    const FrameQuality* earlier_quality = nullptr;  // that of an earlier plan, drawn until then
    bool measures_quality = false;                  // `quality` is being measured, or will be
    // The plan that is kept for comparison: its length as text, "312 frames, 31.2 s", and in
    // seconds; empty: none is kept.
    std::string kept_text = {};
    double kept_s = 0.0;
    int target_count = 0;
    std::function<std::string(int)> object_name = {};  // name of an object id
    // Limits drawn as dashed lines across the strips; 0: none.
    double camera_radius_m = 0.0;
    double max_speed_mps = 0.0;
    double max_turn_dps = 0.0;
};

enum class TimelineStrip { Clearance, Speed, Turn, Score, InView, Captured, ImageCorners, Overlap };
constexpr std::size_t kTimelineStrips = 8;

/// State kept between window frames. The editor plays at `speed` and restarts at the end if `loop`
/// is set.
struct TimelineState {
    double speed = 1.0;  // multiple of real time
    bool loop = false;
    std::array<bool, kTimelineStrips> strips = {true, true, false, false, true, true, true, true};
    // Visible range of the axis, in frames; `shown` 0: all frames.
    double first = 0.0;
    double shown = 0.0;
    int count = 0;       // frame count for which the range was chosen
    int last_frame = 0;  // current frame in the previous window frame
    // The camera key that is pressed or dragged. Its edit is requested when it is let go.
    int pressed_key = -1;                // -1: none
    double grip_px = 0.0;                // from its middle to the mouse when it was pressed
    std::optional<double> dragged_to_s;  // set while it is dragged
    bool drag_cancelled = false;         // the button is still pressed
};

/// A camera key, by its index, that was dragged to another time.
struct RetimedKey {
    int key = 0;
    double time_s = 0.0;
};

struct TimelineActions {
    std::optional<int> go_to;  // frame index within the trajectory
    bool toggle_play = false;
    std::optional<int> select_key;  // index of a camera key
    std::optional<int> fly_to_key;  // the viewport should look along this camera key
    std::optional<RetimedKey> retime;
};

/// Draws the playback controls, the scrubber with key frames and rooms, and a strip for each
/// measured value.
TimelineActions drawTimelinePanel(const TimelineView& view, TimelineState& state);

/// The next (`direction` 1) or previous (-1) key frame; nullopt if there is none.
[[nodiscard]] std::optional<int> neighbourKey(const std::vector<TimelineKey>& keys, int frame,
                                              int direction);

}  // namespace dollytrack::ui
