#pragma once

#include <optional>
#include <vector>

namespace dollytrack::ui {

/// Input of the row for one window frame.
struct TrackBarView {
    double time_s = 0.0;   // current track time
    double last_s = 0.0;   // time of the last key of any track
    bool is_there = true;  // all objects are at their tracks' poses for that time
    bool playing = false;
    std::vector<double> keys_s;  // key times of the selected object, ascending
};

/// User actions of this frame.
struct TrackBarActions {
    std::optional<double> go_to_s;
    bool finished = false;  // a drag has ended
    bool toggle_play = false;
};

/// Draws the row for the time of the object tracks: play button, a slider with the selected
/// object's keys, and a number field that may exceed the slider's range.
TrackBarActions drawTrackBar(const TrackBarView& view);

/// Upper end of the slider, s: 25 % after the last key, rounded up, at least 5 s.
[[nodiscard]] double trackBarEnd(double last_s);

}  // namespace dollytrack::ui
