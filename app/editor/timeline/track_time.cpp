#include "app/editor/timeline/track_time.h"

#include "engine/document/object_track.h"

#include <algorithm>
#include <cmath>

namespace dollytrack::editor {

void TrackTime::follow(const SceneEdits& edits) {
    const std::optional<double> found = timeOfMoves(edits, now_s_);
    is_there_ = found.has_value() || !lastKeyTime(edits);
    if (found) now_s_ = *found;
    if (!lastKeyTime(edits)) playing_ = false;
}

void TrackTime::goTo(double time_s) {
    now_s_ = time_s;
    playing_ = false;
}

void TrackTime::toggle(double last_s) {
    playing_ = !playing_;
    due_s_ = now_s_ < last_s ? now_s_ : 0.0;
}

std::optional<double> TrackTime::advance(double seconds, double last_s, bool ready) {
    if (!playing_) return std::nullopt;
    due_s_ = std::min(due_s_ + seconds, last_s);
    if (!ready) return std::nullopt;
    playing_ = due_s_ < last_s;
    // Rounded to hundredths, as displayed and as useful for keys.
    now_s_ = playing_ ? std::round(100.0 * due_s_) / 100.0 : last_s;
    return now_s_;
}

}  // namespace dollytrack::editor
