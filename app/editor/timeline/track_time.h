#pragma once

#include "engine/document/edits.h"

#include <optional>

namespace dollytrack::editor {

/// The current time of the object tracks, set by hand or by playback.
class TrackTime {
  public:
    [[nodiscard]] double now() const { return now_s_; }
    [[nodiscard]] bool playing() const { return playing_; }
    /// Whether all objects are at their tracks' poses for this time.
    [[nodiscard]] bool isThere() const { return is_there_; }

    /// Resets for another project.
    void reset() { *this = {}; }
    /// Derives the time from the objects' poses, which undo may have changed.
    void follow(const SceneEdits& edits);
    /// Sets a chosen time and stops playing.
    void goTo(double time_s);
    /// Starts or stops playing; at or after the last key, starts from the beginning.
    void toggle(double last_s);
    void stop() { playing_ = false; }

    /// Advances while playing, and stops at the last key. Returns the due time if `ready`, that is,
    /// if the plan for the previous time is done.
    std::optional<double> advance(double seconds, double last_s, bool ready);

  private:
    double now_s_ = 0.0;
    bool is_there_ = true;
    bool playing_ = false;
    double due_s_ = 0.0;  // due time during playback
};

}  // namespace dollytrack::editor
