#pragma once

#include <optional>
#include <vector>

namespace dollytrack::ui {

/// What the row may read this frame.
struct TrackBarView {
    double time_s = 0.0;   // of the tracks
    double last_s = 0.0;   // when their last key is
    bool is_there = true;  // objects stand where their tracks have them at that time
    bool playing = false;
    std::vector<double> keys_s;  // of what is selected, by rising time
};

/// What the user asked for.
struct TrackBarActions {
    std::optional<double> go_to_s;
    bool finished = false;  // a drag is over
    bool toggle_play = false;
};

/// A row for the time of the objects' tracks: play, a slider with the selected object's keys on it,
/// and the time as a number, which may be later than the slider goes.
TrackBarActions drawTrackBar(const TrackBarView& view);

/// Where the slider ends: somewhat after the last key, so that there is room for another.
[[nodiscard]] double trackBarEnd(double last_s);

}  // namespace dollytrack::ui
