#pragma once

#include "app/editor/timeline/play_clock.h"

namespace dollytrack::editor {

/// The current frame of the trajectory, set by hand or by playback.
class Playback {
  public:
    [[nodiscard]] int frame() const { return frame_; }
    [[nodiscard]] bool playing() const { return clock_.runs(); }
    [[nodiscard]] int frameCount() const { return count_; }

    /// Sets the length of a new trajectory; the frame stays if it exists.
    void setFrameCount(int count);
    void goTo(int frame);
    /// Starts or stops playing; at the last frame, starts from the beginning.
    void toggle();
    /// Goes to the first frame and stops.
    void reset();
    /// Advances by a possibly fractional number of frames. At the end it stops, or restarts if
    /// `loop` is set.
    void advance(double frames, bool loop);
    /// Frames, at most one, until the next one is due.
    [[nodiscard]] double untilNext() const { return clock_.untilNext(); }

  private:
    int count_ = 0;
    int frame_ = 0;
    PlayClock clock_;
};

}  // namespace dollytrack::editor
