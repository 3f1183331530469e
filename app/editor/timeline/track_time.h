#pragma once

#include "engine/document/edits.h"

#include <optional>

namespace dollytrack::editor {

/// The time of the objects' tracks that is looked at, by hand or while it plays.
class TrackTime {
  public:
    [[nodiscard]] double now() const { return now_s_; }
    [[nodiscard]] bool playing() const { return playing_; }
    /// Whether the objects stand where their tracks have them now.
    [[nodiscard]] bool isThere() const { return is_there_; }

    /// Another project is open.
    void reset() { *this = {}; }
    /// Takes the time from where the objects stand, which undo may have changed.
    void follow(const SceneEdits& edits);
    /// A time that was chosen; playing stops.
    void goTo(double time_s);
    /// From the beginning where it stands at the last key or later.
    void toggle(double last_s);
    void stop() { playing_ = false; }

    /// Counts on while it plays, and stops at the last key. Gives the time that is due when
    /// `ready`: the plan of the one before is there.
    std::optional<double> advance(double seconds, double last_s, bool ready);

  private:
    double now_s_ = 0.0;
    bool is_there_ = true;
    bool playing_ = false;
    double due_s_ = 0.0;  // while it plays
};

}  // namespace dollytrack::editor
